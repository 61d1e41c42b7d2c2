"""Open water at one frequency: radiation and diffraction, in units of the basin.

With the operator T = A − λM of the liquid, radiation ψⱼ = T⁻¹Fⱼ and diffraction φ_D = −T⁻¹g of an incident φ:

    H = FᵀT⁻¹F = a + i b/ω                    hydrodynamic matrix
    X = λ (∫ρφ φᵢ + Fᵀφ_D)                    excitation, for an incident wave of unit φ

and the response of free bodies, with the scattered waves ψ = φ_D + Σaⱼψⱼ:

    (K − λ(M_b + H)) a = X.

Amplitudes of outgoing waves are those of `incident_waves`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.incident_waves import Circular, Incidence, Plane

# Forces below this part of the largest, in units of the basin, are compared with that part.
_NO_FORCE = 1e-4


@dataclass(frozen=True, kw_only=True)
class OpenFrequency:
    """The solution at one λ."""

    model: OpenModel  # the problem
    squared: complex
    incidence: Incidence  # the travelling waves, first those to the right, then those to the left
    hydrodynamic: np.ndarray  # H, shape (body unknowns, body unknowns)
    diffraction: np.ndarray  # Fᵀφ_D of each incident wave, shape (waves, body unknowns)
    potentials: Callable[[], tuple[np.ndarray, np.ndarray]]  # returns `radiated` and `diffracted`

    @property
    def radiated(self) -> np.ndarray:
        """ψ of a unit of each body unknown, shape (body unknowns, free unknowns)."""
        return self._potentials[0]

    @property
    def diffracted(self) -> np.ndarray:
        """φ_D of each incident wave, shape (waves, free unknowns)."""
        return self._potentials[1]

    @cached_property
    def _potentials(self) -> tuple[np.ndarray, np.ndarray]:
        return self.potentials()

    @property
    def truncation(self) -> np.ndarray:
        """Relative errors of the diagonal of H by truncating the absorbing layer, shape (body unknowns,): of the power
        that is radiated and of |H|, for H has the error A_λ(ψ − ψ_h, ψ − ψ_h)."""
        longest = min(plane.wave.wavenumber for plane in self.incidence.planes)
        waves, beside = self.model.absorbing_layer.reflected(self.model.basin, longest)
        diagonal = np.diag(self.hydrodynamic)
        found: np.ndarray = waves * np.abs(diagonal.imag) / self.model.compared(np.abs(diagonal)) + beside
        return found

    @property
    def diffraction_force(self) -> np.ndarray:
        """λFᵀφ_D for each incident wave, shape (waves, body unknowns)."""
        force: np.ndarray = self.squared * self.diffraction
        return force

    @property
    def froude_krylov_force(self) -> np.ndarray:
        """λ∫ρφ φᵢ for each incident wave, shape (waves, body unknowns)."""
        return self.squared * self.incidence.pressures

    @property
    def fluxes(self) -> np.ndarray:
        """I(φ) = X/λ of the waves radiated by a unit of each body unknown, shape (waves, body unknowns): Haskind's
        relation."""
        fluxes: np.ndarray = self.incidence.pressures + self.diffraction
        return fluxes

    def flux_errors(self, unmeshed: float) -> np.ndarray:
        """Estimate errors of `fluxes`, of the same shape (collective).

        The Galerkin method changes I(φ) by A_λ(φ_D − φ_Dh, ψⱼ − ψⱼh), which is at most the sum of √(E_D Eⱼ) over the
        cells, with the energy errors of both. Where a body reaches deeper than the waves, one of both is smooth in each
        cell: the error is as small as I(φ) itself.
        """
        model, waves = self.model, self.incidence
        missed, count = model.cells_missed(np.vstack([self.radiated, self.diffracted])), len(self.radiated)
        away, tips = model.summed_over_cells(np.sqrt(missed[count:, None] * missed[:count]))
        terms = model.pencil.products(np.abs(waves.fluxes), np.abs(self.radiated)) + np.abs(waves.pressures)
        longest = min(plane.wave.wavenumber for plane in waves.planes)
        reflected = sum(model.absorbing_layer.reflected(model.basin, longest))
        errors: np.ndarray = away + tips + unmeshed * terms + reflected * np.linalg.norm(self.fluxes, axis=0)
        return errors

    @property
    def radiation_damping(self) -> np.ndarray:
        """b/ω, by the power of the radiated waves, shape (body unknowns, body unknowns): Re Σ kN c̄ⱼ cₖ of all outgoing
        waves.

        It is the imaginary part of H; but that is the rest of far larger numbers where bodies hardly make waves.
        """
        amplitudes = self.incidence.amplitudes(self.fluxes)
        damping: np.ndarray = ((amplitudes.conj().T * self.incidence.powers) @ amplitudes).real
        return damping

    def radiation_damping_errors(self, fluxes: np.ndarray) -> np.ndarray:
        """Return errors of `radiation_damping`, of the same shape, by those of `fluxes`."""
        amplitudes, errors = (np.abs(self.incidence.amplitudes(one)) for one in (self.fluxes, fluxes))
        most, powers = amplitudes + errors, self.incidence.powers
        return np.asarray((most.T * powers) @ most - (amplitudes.T * powers) @ amplitudes)

    def observed_amplitudes(self) -> np.ndarray:
        """c of the waves radiated by a unit of each body unknown, shape (waves, body unknowns), from the field at some
        distance from the bodies by `far_field`, not by their surfaces, with which Haskind's relation holds identically
        (collective)."""
        fluxes = self.model.far_field.fluxes(self.radiated, [plane.field for plane in self.incidence.planes])
        return self.incidence.amplitudes(fluxes)

    def energy_residual(self) -> float:
        """Largest difference between Im H and the power of the radiated waves, relative to |H| (collective)."""
        radiated = self.incidence.powers @ np.abs(self.observed_amplitudes()) ** 2
        diagonal = np.diag(self.hydrodynamic)
        return float(np.max(np.abs(diagonal.imag - radiated) / self.model.compared(np.abs(diagonal)), initial=0.0))

    def haskind_residual(self) -> float:
        """Largest difference between the excitation and X = λ I(φ), with I(φ) of the far field of the
        radiated waves, relative to the largest force (collective)."""
        direct = self.froude_krylov_force + self.diffraction_force
        by_far_field = self.squared * self.incidence.fluxes_of(self.observed_amplitudes())
        scale = np.abs(direct).max(axis=0)
        differences = np.abs(direct - by_far_field).max(axis=0)
        # Waves exert no moment on a circle about its centre; such a computed force is rounding.
        floor = max(_NO_FORCE * scale.max(initial=0.0), np.finfo(float).tiny)
        # Nor do they heave a deep spar: its force is compared with that of a body that radiates as much as it moves.
        radiating = np.sqrt(self.incidence.powers.max() * np.abs(np.diag(self.hydrodynamic)))
        floor = np.maximum(floor, _NO_FORCE * abs(self.squared) * radiating)
        return float(np.max(differences / np.maximum(scale, floor), initial=0.0))


@dataclass(frozen=True, kw_only=True)
class BodyEquations:
    """Equations of motion of the bodies at one λ, from which a response to waves follows with any further damping.

    Shapes: m body unknowns, w waves.
    """

    dynamic: np.ndarray  # K − iωB − λ(M_b + H), shape (m, m)
    forces: np.ndarray  # X of each wave, shape (w, m)
    radiated: np.ndarray  # gᵀψ of a unit of each unknown, shape (w, m)
    diffracted: np.ndarray  # gᵀφ_D of each wave, shape (w, w)


@dataclass(frozen=True, kw_only=True)
class OpenResponse:
    """Bodies that move freely in waves, at one λ."""

    model: OpenModel  # the problem
    squared: complex
    incidence: Incidence  # the travelling waves, first those to the right, then those to the left
    incident: list[int]  # indices of the incident waves
    fluxes: np.ndarray  # gᵀψ of the radiated and diffracted waves of each, shape (waves, incident)
    # returns ψ, shape (k, free unknowns), of parts of the diffracted waves of each wave, shape (k, waves), and of
    # motions, shape (k, body unknowns)
    potentials: Callable[[np.ndarray, np.ndarray], np.ndarray]
    motions: np.ndarray  # body unknowns, shape (incident, body unknowns)
    equations: BodyEquations  # from which the motions follow, without drag
    # of the bodies beyond that of these equations, as by drag, shape (incident, body unknowns, body unknowns)
    damping: np.ndarray

    @cached_property
    def scattered(self) -> np.ndarray:
        """ψ of radiated and diffracted waves of each incident wave, shape (incident, free unknowns)."""
        return self.scattered_by(self.motions)

    def scattered_by(self, motions: np.ndarray) -> np.ndarray:
        """Return the same with other motions, shape (incident, body unknowns)."""
        return self.potentials(np.eye(len(self.incidence.planes))[self.incident], motions)

    def radiated_by(self, motions: np.ndarray) -> np.ndarray:
        """Return ψ of waves that motions of shape (k, body unknowns) radiate, shape (k, free unknowns)."""
        return self.potentials(np.zeros((len(motions), len(self.incidence.planes))), motions)

    @cached_property
    def missed(self) -> np.ndarray:
        """Energy error of `scattered` in each own cell, shape (incident, cells)."""
        return self.model.cells_missed(self.scattered)

    @property
    def reflected(self) -> float:
        """Part of the power of outgoing waves that the ends of the absorbing layer reflect at most."""
        return sum(self.model.absorbing_layer.reflected(self.model.basin, float(self.wavenumbers.min())))

    @property
    def scattered_powers(self) -> np.ndarray:
        """Power of the radiated and diffracted waves over ½ω³, shape (incident,)."""
        incidence = self.incidence
        scattered = self.outgoing() - incidence.incoming * np.eye(len(incidence.planes))[:, self.incident]
        powers: np.ndarray = incidence.powers @ np.abs(scattered) ** 2
        return powers

    def outgoing(self, motions: np.ndarray | None = None) -> np.ndarray:
        """Return c of all outgoing waves, the incident one included, shape (outgoing waves, incident)."""
        incidence, scattered = self.incidence, self.fluxes
        if motions is None:
            motions = self.motions
        else:
            scattered = self.equations.diffracted[:, self.incident] + self.equations.radiated @ motions.T
        fluxes = incidence.pressures @ motions.T - incidence.own[:, self.incident] - scattered
        return incidence.amplitudes(fluxes) + incidence.incoming * np.eye(len(incidence.planes))[:, self.incident]

    def ratios(self, motions: np.ndarray | None = None) -> np.ndarray:
        """Return elevations of the outgoing waves per incident elevation, both with their phases at x = 0, shape
        (incident, outgoing waves)."""
        incidence = self.incidence
        # A wave of zero phase at x = 0 has the factor e^{±ikx₀} at the basin's left side.
        phases = np.exp(1j * incidence.phases_at_origin(self.model.basin))
        scaled = incidence.elevations * phases
        found: np.ndarray = (self.outgoing(motions) * scaled[:, None] / scaled[self.incident]).T
        return found

    def partial_waves(self, motions: np.ndarray | None = None) -> np.ndarray:
        """Return aₙ of the elevation εₙ iⁿ [Jₙ(kr) + aₙ Hₙ(kr)] cos nθ about an axis, shape (incident, outgoing
        waves)."""
        scattered: np.ndarray = self.ratios(motions) - self.incidence.incoming * np.eye(len(self.incident))
        return scattered

    def per_elevation(self, towards: int) -> np.ndarray:
        """Return the factors of what is per c of each incident wave for a unit elevation with its phase at x = 0, of
        waves towards +x (1) or −x (−1), shape (incident,); about an axis of the part of this order."""
        incidence, basin = self.incidence, self.model.basin
        phases = np.exp(1j * incidence.phases_at_origin(basin))
        parts = [plane.part(towards, basin) if isinstance(plane, Circular) else 1.0 for plane in incidence.planes]
        factors: np.ndarray = (np.array(parts) / (incidence.elevations * phases))[self.incident]
        return factors

    def drift_force(self, motions: np.ndarray | None = None) -> np.ndarray:
        """Return the mean force along x, of second order in the waves, per |c|² of each incident wave, dimensionless,
        shape (incident,).

        Each wave train carries momentum kP/ω, P its power, towards the bodies or away: with waves of amplitude A from
        the left, F = ρgA² (c_g/2c)(1 + |R|² − |T|²), in deep water without absorption ½ρgA²|R|² (Maruo 1960;
        Longuet-Higgins 1977, Proc. R. Soc. Lond. A 352, 463).
        """
        if self.incidence.directions == 1:
            # One order alone has none: see `orders`.
            return np.zeros(len(self.incident))
        momenta = self.momenta
        # Waves that leave to the left push to the right.
        force: np.ndarray = momenta[self.incident] - momenta @ np.abs(self.outgoing(motions)) ** 2
        return force

    def near_field_drift(self, incident: int = 0) -> float:
        """Return the drift force of one incident wave, by its number in the response, from the field beside the bodies
        (collective); in one liquid."""
        wave = self.incidence.planes[self.incident[incident]]
        return self.model.near_field.drift_force(self.squared.real, self.scattered[incident], wave.field)

    @property
    def wavenumbers(self) -> np.ndarray:
        """Of each wave, in units of the basin, shape (waves,)."""
        return np.array([plane.wave.wavenumber for plane in self.incidence.planes])

    @property
    def momenta(self) -> np.ndarray:
        """½λ(±k)P, by which each wave of a section carries momentum to the right, per |c|², shape (waves,)."""
        towards = np.array([plane.direction for plane in self.incidence.planes if isinstance(plane, Plane)])
        momenta: np.ndarray = 0.5 * self.squared.real * towards * self.wavenumbers * self.incidence.powers
        return momenta

    @property
    def absorbed(self) -> np.ndarray:
        """aᴴBa/ω, the power that all damping from outside takes over ½ω³, shape (incident,)."""
        damping = self.model.outside.damping + self.damping
        taken = np.einsum("wi,wij,wj->w", self.motions.conj(), damping, self.motions).real
        absorbed: np.ndarray = taken / np.sqrt(self.squared.real)
        return absorbed

    @property
    def absorption(self) -> np.ndarray:
        """Power that damping from outside takes, over incident power, shape (incident,)."""
        incoming = self.incidence.incoming
        absorption: np.ndarray = self.absorbed / (self.incidence.powers[self.incident] * incoming**2)
        return absorption

    def energy_residual(self) -> np.ndarray:
        """Outgoing and absorbed power over incident power, less one, shape (incident,)."""
        powers, incoming = self.incidence.powers, self.incidence.incoming
        outgoing = powers @ np.abs(self.outgoing()) ** 2 / (powers[self.incident] * incoming**2)
        residual: np.ndarray = outgoing + self.absorption - 1.0
        return residual
