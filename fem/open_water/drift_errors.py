"""Errors of the mean drift force, by the dual problem of each wave that leaves.

Of sections F = mᵢ − Σ mⱼ|cⱼ|², mⱼ = ±½λkⱼPⱼ, see `OpenResponse.drift_force`. The problem of bodies and liquid is
complex symmetric, and the amplitude cⱼ = i I(φ)/(2Pⱼ) is a functional of the field whose dual solution is the wave ψ_φ
that the wave φ from the opposite side scatters. So, to first order in the error,

    δF = −2 Re Σ mⱼ c̄ⱼ δcⱼ = Re A_λ(z − z_h, ψ − ψ_h),    z = −i Σ mⱼ c̄ⱼ ψ_φ / Pⱼ :

one dual solution for all of F, in which errors of reflected and transmitted waves cancel as they do in F.

It is bounded by `product_errors`. Beside it are the part r of the power that the ends of the absorbing layer reflect,
r √(P_z P_ψ) with the powers that z and ψ radiate; omitted dry modes of stiffness Kₙ, less than Σ Kₙ|aₙ(z) aₙ(ψ)|/λ; and
the relative errors of the reduced basis, of curved boundaries and of rounding. Between frequencies with dual solutions
the error over √(P_z P_ψ) is interpolated as a power of ω: long waves have ever less power beside the energy near the
bodies.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.omitted_modes import omitted_energy
from hydroelastic.fem.open_water.product_errors import product_errors
from hydroelastic.fem.open_water.response_errors import unmeshed_error

# Nothing moves below: a quotient by it is finite.
_LEAST = 1e-200


@dataclass(frozen=True, kw_only=True)
class DualOfDrift:
    """The dual solution z of the drift force in one incident wave, per |c|² of it."""

    response: OpenResponse  # of the bodies
    wave: int  # index of the incident wave
    damping: np.ndarray  # of the bodies beyond that of the equations of motion, shape (body unknowns, body unknowns)

    @cached_property
    def motions(self) -> np.ndarray:
        """Motions in each wave, shape (waves, body unknowns)."""
        equations, omega = self.response.equations, np.sqrt(self.response.squared)
        motions: np.ndarray = np.linalg.solve(equations.dynamic - 1j * omega * self.damping, equations.forces.T).T
        return motions

    @cached_property
    def scattered(self) -> np.ndarray:
        """c of the scattered waves in each wave, shape (outgoing waves, waves)."""
        incidence, equations = self.response.incidence, self.response.equations
        pressures = (incidence.pressures - equations.radiated) @ self.motions.T
        return incidence.amplitudes(pressures - incidence.own - equations.diffracted)

    @cached_property
    def outgoing(self) -> np.ndarray:
        """c of all outgoing waves, shape (waves,)."""
        outgoing = self.scattered[:, self.wave].copy()
        outgoing[self.wave] += self.response.incidence.incoming
        return outgoing

    @cached_property
    def parts(self) -> np.ndarray:
        """Parts of the scattered waves of each wave in z, shape (waves,)."""
        incidence = self.response.incidence
        parts: np.ndarray = (-1j * self.response.momenta * self.outgoing.conj() / incidence.powers)[incidence.reversed]
        return parts

    @cached_property
    def power(self) -> float:
        """√(P_z P_ψ)."""
        both = np.stack([self.scattered @ self.parts, self.scattered[:, self.wave]])
        return float(np.sqrt(np.prod(np.abs(both) ** 2 @ self.response.incidence.powers)))

    def missed(self) -> float:
        """Return the error by the mesh, the absorbing layer and omitted dry modes over √(P_z P_ψ) (collective)."""
        response, weights = self.response, np.stack([self.parts, np.eye(len(self.parts))[self.wave]])
        motions = weights @ self.motions
        dual, own = response.potentials(weights, motions)
        found = float(product_errors(response.model, dual[None], own[None])[0])
        pair = replace(response, motions=motions)
        for index in response.model.basin.tank.beams:
            found += float(np.prod(omitted_energy(pair, index))) / response.squared.real
        return found / max(self.power, _LEAST) + response.reflected

    def of_waves(self, error: float) -> float:
        """Return the error of F where all c have an error relative to the incident wave.

        With κ times the balance of power added, F = (λ/2) [(k − κ) P + Σ (κ ∓ kⱼ) Pⱼ|cⱼ|² + κ (power lost)] of incident
        power P. For one surface κ = k leaves the reflected wave alone, whose R has the relative error of R², κ = −k the
        transmitted one: the smaller error holds. By how much the powers found are out of balance is known.
        """
        response, place, squared = self.response, self.wave, self.response.squared.real
        powers, amplitudes, motion = response.incidence.powers, np.abs(self.outgoing), self.motions[self.wave]
        damping = response.model.outside.damping + self.damping
        absorbed = (motion.conj() @ damping @ motion).real / np.sqrt(squared)
        arm = 0.5 * squared * response.wavenumbers[place]
        sizes = 2.0 * error * amplitudes * np.sqrt(powers * powers[place])
        lost = 2.0 * error * absorbed
        waves = min(float(np.abs(kappa - response.momenta / powers) @ sizes) for kappa in (arm, -arm))
        unbalanced = abs(float(powers @ amplitudes**2 + absorbed - powers[place]))
        return waves + arm * (lost + min(unbalanced, lost + float(sizes.sum())))


def drift_errors(
    responses: Sequence[OpenResponse],
    omegas: np.ndarray,
    places: list[int],
    reduced: np.ndarray,
    damping: np.ndarray | None = None,
) -> np.ndarray:
    """Estimate errors of the drift force on sections per |c|² of each incident wave, shape (n, incident)
    (collective)."""
    if responses[0].incidence.directions == 1:
        # One order alone has none: see `drift_of_orders`.
        return np.zeros((len(responses), len(responses[0].incident)))
    duals = [
        [
            DualOfDrift(response=one, wave=wave, damping=own if damping is None else damping)
            for wave, own in zip(one.incident, one.damping, strict=True)
        ]
        for one in responses
    ]
    missed = np.array([[dual.missed() for dual in duals[place]] for place in places])
    powers = np.array([[dual.power for dual in row] for row in duals])
    rest = reduced + unmeshed_error(responses[0].model)
    others = np.array([[dual.of_waves(error) for dual in row] for row, error in zip(duals, rest, strict=True)])
    errors: np.ndarray = between_places(omegas, places, missed) * powers + others
    return errors


def between_places(omegas: np.ndarray, places: list[int], values: np.ndarray) -> np.ndarray:
    """Return values at all ω, shape (n, …), from those at some indices, shape (places, …), as powers of ω."""
    logarithms = np.log(np.maximum(values, _LEAST)).reshape(len(places), -1)
    known, wanted = np.log(omegas[places]), np.log(omegas)
    found = np.column_stack([np.interp(wanted, known, column) for column in logarithms.T])
    return np.exp(found).reshape(len(omegas), *values.shape[1:])
