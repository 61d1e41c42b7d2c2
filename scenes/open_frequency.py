"""Open water at one frequency: radiation and diffraction, in units of the basin.

With the operator T = A − λM of the liquid, radiation ψⱼ = T⁻¹Fⱼ and diffraction φ_D = −T⁻¹g of an incident φ:

    H = FᵀT⁻¹F = a + i b/ω                    hydrodynamic matrix
    X = λ (∫ρφ φᵢ + Fᵀφ_D)                    excitation, for an incident wave of unit φ
    (K − λ(M_b + H)) a = X                    motion

Amplitudes of what leaves are those of `incident_waves`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.scenes.incident_waves import Incidence
from hydroelastic.scenes.open_model import OpenModel


@dataclass(frozen=True, kw_only=True)
class OpenFrequency:
    """The solution at one λ.

    Attributes:
        model: the problem.
        squared: λ.
        incidence: the travelling waves, first those to the right, then those to the left.
        radiated: ψ of a unit of each body unknown, shape (body unknowns, free unknowns).
        diffracted: φ_D of each incident wave, shape (waves, free unknowns).
        hydrodynamic: H, shape (body unknowns, body unknowns).
    """

    model: OpenModel
    squared: complex
    incidence: Incidence
    radiated: np.ndarray
    diffracted: np.ndarray
    hydrodynamic: np.ndarray

    @property
    def diffraction_force(self) -> np.ndarray:
        """λFᵀφ_D for each incident wave, shape (waves, body unknowns) (collective)."""
        return self.squared * self.model.pencil.products(self.diffracted, self.model.pencil.loads.astype(complex))

    @property
    def froude_krylov_force(self) -> np.ndarray:
        """λ∫ρφ φᵢ for each incident wave, shape (waves, body unknowns)."""
        return self.squared * self.incidence.pressures

    @property
    def _scale(self) -> np.ndarray:
        """i/(2kN) of each wave."""
        return np.array([0.5j / (plane.wave.wavenumber * plane.wave.energy) for plane in self.incidence.planes])

    @property
    def reversed(self) -> np.ndarray:
        """Places of the waves that run the other way."""
        half = len(self.incidence.planes) // 2
        return np.roll(np.arange(2 * half), half)

    def radiated_amplitudes(self) -> np.ndarray:
        """c of the waves that leave with a unit of each body unknown, shape (waves, body unknowns) (collective).

        From the bodies' surfaces, so that c− and the excitation by φ+ agree by themselves.
        """
        fluxes = self.incidence.pressures - self.model.pencil.products(self.incidence.fluxes, self.radiated)
        return self._scale[:, None] * fluxes[self.reversed]

    def observed_amplitudes(self) -> np.ndarray:
        """The same from the field at some distance from the bodies, by `fem.far_field` (collective)."""
        fluxes = self.model.far_field.fluxes(self.radiated, [plane.field for plane in self.incidence.planes])
        return self._scale[:, None] * fluxes[self.reversed]

    def diffracted_amplitudes(self) -> np.ndarray:
        """c of the waves that the bodies at rest send back, shape (waves that leave, incident waves) (collective)."""
        fluxes = -self.incidence.own - self.model.pencil.products(self.incidence.fluxes, self.diffracted)
        return self._scale[:, None] * fluxes[self.reversed]

    def motions(self) -> np.ndarray:
        """Body unknowns a in each incident wave, shape (waves, body unknowns) (collective)."""
        dynamic = self.model.stiffness - self.squared * (self.model.mass + self.hydrodynamic)
        motions: np.ndarray = np.linalg.solve(dynamic, (self.froude_krylov_force + self.diffraction_force).T).T
        return motions

    def outgoing(self) -> np.ndarray:
        """c of all waves that leave in each incident wave, itself included, shape (waves, incident waves)
        (collective)."""
        scattered = self.diffracted_amplitudes() + self.radiated_amplitudes() @ self.motions().T
        return scattered + np.eye(len(self.incidence.planes))

    def powers(self) -> np.ndarray:
        """kN of each wave: its power over ½ω³|c|²."""
        return np.array([plane.wave.wavenumber * plane.wave.energy for plane in self.incidence.planes])

    def energy_residual(self) -> float:
        """Largest difference between damping and the power of the waves that leave, as a part of |H| (collective)."""
        radiated = self.powers() @ np.abs(self.observed_amplitudes()) ** 2
        diagonal = np.diag(self.hydrodynamic)
        return float(np.max(np.abs(diagonal.imag - radiated) / np.abs(diagonal), initial=0.0))

    def haskind_residual(self) -> float:
        """Largest difference between the excitation and that which follows from the far field of the radiated waves,
        X = −2ikNλ c of the wave that leaves against the incident one, as a part of the largest force (collective)."""
        direct = self.froude_krylov_force + self.diffraction_force
        by_far_field = -self.squared / self._scale[:, None] * -1.0 * self.observed_amplitudes()[self.reversed]
        scale = np.abs(direct).max(axis=0)
        differences = np.abs(direct - by_far_field).max(axis=0)
        return float(np.max(differences / np.where(scale > 0.0, scale, 1.0), initial=0.0))
