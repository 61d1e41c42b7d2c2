"""The non-resonant part of the motion after a release: an integral along a ray, on which the integrand decays.

E is S less the S of the bodies with their added mass at infinite frequency, whose integral is zero for t > 0; without
it the integral would not converge at t = 0. H on the ray comes from the field solution, continued by the complex
scaling, on a reduced basis of a few solutions; for waves that are longer or shorter than those of the mesh H is taken
from the series `low_frequency` and `high_frequency`. An error δH of H changes the motion by

    (1/π) Im ∫ D⁻¹ p δH D⁻¹ K a₀ e^{pt} dp,    D = p²(M + H) + K.

In deep water H of sections has a logarithm at p = 0, which leaves the tail −(2/π) K⁻¹ h a₀/t², h = lim Im H = lim b/ω;
at finite depth there is none. The waves of solids of revolution spread in two directions: they have this tail at finite
depth, and (12/π) K⁻¹ h a₀/t⁴ with h = lim b/ω³ in deep water.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi, sqrt

import numpy as np

from hydroelastic.fem.open_water.field_model import ANGLE as DEEP_ANGLE
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.high_frequency import HighFrequencySeries, arc, high_frequency_series
from hydroelastic.fem.open_water.low_frequency import SPREAD, LowFrequencySeries, low_frequency_series
from hydroelastic.fem.open_water.radiation import relative_difference
from hydroelastic.fem.open_water.resonance import ANGLE
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.open_water.sweep import Problem, Swept, sweep
from hydroelastic.fem.tank.error_estimates import FrequencyErrors

# Least (if possible) and largest angle between the ray and the resonances beside it, rad.
_NARROW, _WIDE = 0.05, 0.12
# Ends of the integral, as multiples of 1/t and of the highest frequency of the mesh: the rest is negligible.
_LOWER, _HIGHER = 2e-4, 200.0
# Far below the resonances the sensitivity of the motion to H falls like the square of the frequency; this least weight
# keeps the accuracy of the tail.
_LEAST_WEIGHT = 0.1
# Above them it is as insensitive, but errors of the basis there appear in the sum at t = 0.
_LEAST_ABOVE = 0.01
# Step h of the trapezoidal rule in ln r over the angle d within which the integrand is analytic: error e^{−2πd/h} =
# 1e-18.
_STEP = 0.13
# Points of the ray and of the arc beyond it at which the residual of the reduced basis is computed.
_ON_RAY, _ON_ARC = 60, 12
# Errors of H at different frequencies have different phases, and cancel in the integral, as energy errors of
# different phases do in each H. Measured on a circle and on six thin floats, alone, over a bed and between two liquids,
# at tolerances from 1e-3 to 1e-6: the sum of their magnitudes is 24 to 620 times the largest error of the motion.
_PHASES = 0.05
# Number of times that are evaluated together.
_CHUNK = 256


@dataclass(frozen=True, kw_only=True)
class Ray:
    """A ray ω = re^{−iδ}: δ, and the angle to the nearest resonance or to the continuous spectrum, rad."""

    angle: float
    gap: float

    @property
    def turned(self) -> complex:
        """e^{−iδ}."""
        return complex(np.exp(-1j * self.angle))

    @property
    def scaling(self) -> float:
        """α of the complex scaling, rad: that of deep water, unless the ray is near the continuous spectrum.

        Beside a tall body, where only x is rotated, 1/(x ± iy) varies over (π/2 − α)|y|: with the α of resonances the
        error of H is ten times larger.
        """
        return DEEP_ANGLE if self.angle < 0.25 * DEEP_ANGLE else ANGLE


@dataclass(frozen=True, kw_only=True)
class RayMotion:
    """The integral at one resolution, dimensionless. Shapes: n times, m body unknowns."""

    motion: np.ndarray  # body unknowns, shape (n, m)
    errors: FrequencyErrors  # error of the largest motion, by cause, each of shape (n,)
    slow: np.ndarray | None  # lim b/ω for ω → 0, shape (m, m); ``None`` over a bed
    solved: int  # number of frequencies that were solved by a factorization


def ray_between(resonances: list[complex]) -> Ray:
    """Return a ray between resonances ω, the nearest to the real axis of ω with room: deeper ones may not be known."""
    angles = sorted(float(-np.angle(omega)) for omega in resonances)
    stops = [0.0, *(angle for angle in angles if angle < 0.5 * ANGLE), 0.5 * ANGLE]
    gaps = [(low, min(0.5 * (high - low), _WIDE)) for low, high in pairwise(stops)]
    low, gap = next((found for found in gaps if found[1] >= _NARROW), max(gaps, key=lambda found: found[1]))
    return Ray(angle=low + gap, gap=gap)


class RayIntegral:
    """The integral for one model.

    Args:
        limit: a(∞) in units of the model, shape (m, m).
        initial: a₀ in body unknowns, shape (m,).
        ray: path of integration.
        band: lowest and highest frequency of the mesh, dimensionless.
        slow: dimensionless frequency below which H determines the tail.
    """

    def __init__(
        self,
        model: OpenModel,
        limit: np.ndarray,
        initial: np.ndarray,
        ray: Ray,
        band: tuple[float, float],
        slow: float,
    ) -> None:
        """Prepare (collective)."""
        self._model, self._limit, self._initial, self._ray, self._band = model, limit, initial, ray, band
        self._slow = slow
        self._solver = OpenSolver(model)
        # ω and the relative errors of H of the solutions by a factorization.
        self._omegas: list[complex] = []
        self._causes: list[FrequencyErrors] = []

    def followed(self, times: np.ndarray, *, has_low_series: bool) -> RayMotion:
        """Return the motion at some times (collective)."""
        low, high = self._band
        meshed = np.geomspace(low, high, _ON_RAY) * self._ray.turned
        # The end of the ray is on the arc already.
        chosen = np.concatenate([meshed, arc(high * self._ray.turned, _ON_ARC)[:-1]])
        swept = sweep(self._problem(), chosen, self._model.tolerance)
        least = min(_LOWER / max(float(times.max()), 1.0 / high), 1e-2 * low)
        radii = np.exp(np.arange(np.log(least), np.log(_HIGHER * high), _STEP * self._ray.gap))
        fast = high_frequency_series(
            lambda omegas: self._solver.hydrodynamics(omegas**2), high * self._ray.turned, self._limit
        )
        added, slow = hydrodynamics_along_ray(
            self._solver, self._ray, radii, self._band, fast, has_low_series=has_low_series
        )
        weights = self._ray_weights(radii)
        motion = _summed(times, radii, self._ray, self._integrand(radii, added) * weights[:, None])
        errors = self._errors(times, radii, added, chosen, swept, (slow, fast))
        return RayMotion(
            motion=motion,
            errors=errors,
            slow=slow.damping_over_frequency if slow else None,
            solved=self._solver.factorizations,
        )

    def _problem(self) -> Problem[tuple[np.ndarray, float]]:
        """Return the sweep of H along the ray, with errors weighted by the sensitivity of the motion."""
        model = self._model

        def full(omega: complex) -> tuple[np.ndarray, float]:
            radiated = self._solver.radiation(omega**2)
            added = model.pencil.products(model.pencil.loads.astype(complex), radiated)
            self._omegas.append(omega)
            self._causes.append(model.errors(radiated, np.abs(np.diag(added))))
            return added, self._weight(omega, added)

        def reduced(omega: complex) -> tuple[tuple[np.ndarray, float], float]:
            added, residual = self._solver.hydrodynamic(omega**2)
            weight = self._weight(omega, added)
            return (added, weight), residual * sqrt(weight)

        def difference(one: tuple[np.ndarray, float], other: tuple[np.ndarray, float]) -> float:
            return other[1] * relative_difference(one[0], other[0])

        return Problem(full=full, reduced=reduced, difference=difference)

    def _weight(self, omega: complex, added: np.ndarray) -> float:
        """Return the relative change of the motion per relative error of H, from a factor e of frequencies."""
        moved = self._sensitivities(np.array([omega]), added[None], np.abs(added)[None])[0]
        least = _LEAST_WEIGHT if abs(omega) < self._slow else _LEAST_ABOVE
        return max(float(np.abs(omega) * moved.max() / np.abs(self._initial).max() / pi), least)

    def _sensitivities(self, omegas: np.ndarray, added: np.ndarray, errors: np.ndarray) -> np.ndarray:
        """Return |D⁻¹| |p| |δH| |D⁻¹ K a₀|, shape (points, restored unknowns), for |δH|, shape (points, m, m).

        Motions without restoring force are left out. A release that starts one is refused, and D⁻¹, unbounded as
        p → 0, would multiply the rounding of what is zero by symmetry.
        """
        restored = np.flatnonzero(np.diag(self._model.stiffness) > 0.0)

        def own(matrices: np.ndarray) -> np.ndarray:
            return matrices[..., restored, :][..., restored]

        stiffness, rates = own(self._model.stiffness), -1j * omegas[:, None, None]
        inertia = rates * own(self._model.mass + added) + own(self._model.outside.damping)
        inverse = np.linalg.inv(stiffness + rates * inertia)
        pushed = np.abs(inverse @ (stiffness @ self._initial[restored]))
        moved: np.ndarray = np.einsum("nij,njk,nk->ni", np.abs(inverse), own(errors), pushed) * np.abs(omegas)[:, None]
        return moved

    def _integrand(self, radii: np.ndarray, added: np.ndarray) -> np.ndarray:
        """E at p = conj(−iω), shape (points, body unknowns)."""
        model = self._model
        p = (-1j * radii * self._ray.turned)[:, None, None]
        limit = np.broadcast_to(model.mass + self._limit, added.shape)
        # Without damping the limit has its poles on the imaginary axis, to the right of the ray.
        whole, high = (
            np.linalg.solve(p * momentum + model.stiffness, momentum @ self._initial[:, None])[..., 0]
            for momentum in (p * (model.mass + added) + model.outside.damping, p * limit)
        )
        values: np.ndarray = np.conj(whole - high)
        return values

    def _ray_weights(self, radii: np.ndarray) -> np.ndarray:
        """Weights of the trapezoidal rule in ln r, with the direction of the ray, shape (points,)."""
        step = np.log(radii[1] / radii[0])
        weights: np.ndarray = radii * step * np.conj(-1j * self._ray.turned) / pi
        return weights

    def _errors(
        self,
        times: np.ndarray,
        radii: np.ndarray,
        added: np.ndarray,
        chosen: np.ndarray,
        swept: Swept[tuple[np.ndarray, float]],
        series: tuple[LowFrequencySeries | None, HighFrequencySeries],
    ) -> FrequencyErrors:
        """Estimate the errors of the motion by cause: elements, reduced basis, series."""
        slow, fast = series
        omegas = radii * self._ray.turned
        on_ray = np.isclose(np.angle(self._omegas), -self._ray.angle)
        order = [int(place) for place in np.argsort(np.abs(self._omegas)) if on_ray[place]]
        known = np.log(np.abs(np.array(self._omegas)[order]))
        diagonal = np.abs(np.einsum("nii->ni", added))
        # The error of the coefficient of the logarithm grows with the distance from the frequencies of the fit.
        farther = 1.0 + np.maximum(np.log(SPREAD * self._band[0] / radii), 0.0) / np.log(SPREAD)

        def moved(errors: np.ndarray) -> np.ndarray:
            """Error of the motion by |δH|, shape (points, m, m), at all times, shape (n,)."""
            sizes = self._sensitivities(omegas, added, errors).max(axis=1)
            return _decaying(times, radii, self._ray, sizes * np.abs(self._ray_weights(radii)))

        def of_parts(relative: np.ndarray) -> np.ndarray:
            """|δH| of relative errors, shape (points, m)."""
            roots = np.sqrt(relative * farther[:, None] * diagonal)
            matrices: np.ndarray = roots[:, :, None] * roots[:, None, :]
            return matrices

        def of_elements(cause: str) -> np.ndarray:
            values = np.array([getattr(causes, cause) for causes in self._causes])[order]
            relative = np.array([np.interp(np.log(radii), known, column) for column in values.T]).T
            return _PHASES * moved(of_parts(relative))

        basis = np.array([error / found[1] for error, found in zip(swept.errors, swept.solutions, strict=True)])
        others = np.interp(np.log(radii), np.log(np.abs(chosen[:_ON_RAY])), basis[:_ON_RAY])
        # The high-frequency series has the error of the values from which it was fitted.
        others = np.where(radii > self._band[1], basis[_ON_RAY - 1 :].max(), others)
        if slow is not None:
            others = others + np.where(radii < self._band[0], slow.misfit, 0.0)
        shorter = np.where((radii > self._band[1])[:, None, None], fast.errors(omegas), 0.0)
        return FrequencyErrors(
            liquid=of_elements("liquid") + moved(of_parts(np.broadcast_to(others[:, None], diagonal.shape)) + shorter),
            tips=of_elements("tips"),
            truncation=np.zeros(len(times)),
            rounding=of_elements("rounding"),
        )


def hydrodynamics_along_ray(
    solver: OpenSolver,
    ray: Ray,
    radii: np.ndarray,
    band: tuple[float, float],
    fast: HighFrequencySeries | None,
    *,
    has_low_series: bool,
) -> tuple[np.ndarray, LowFrequencySeries | None]:
    """Return H at |ω| of shape (n,) along a ray, shape (n, m, m), and its low-frequency series (collective)."""
    low, high = band
    omegas = radii * ray.turned
    slow = low_frequency_series(lambda few: solver.hydrodynamics(few**2), low * ray.turned) if has_low_series else None
    first = np.searchsorted(radii, low) if slow else 0
    last = np.searchsorted(radii, high, side="right")
    parts = [solver.hydrodynamics(omegas[first:last] ** 2)]
    if slow is not None:
        parts.insert(0, slow.hydrodynamic(omegas[:first]))
    if fast is not None:
        parts.append(fast.hydrodynamic(omegas[last:]))
    return np.concatenate(parts), slow


def _summed(times: np.ndarray, radii: np.ndarray, ray: Ray, weighed: np.ndarray) -> np.ndarray:
    """Im Σ E w e^{pt}, shape (times, body unknowns)."""
    rates = radii * np.conj(-1j * ray.turned)
    parts = [np.imag(np.exp(np.outer(part, rates)) @ weighed) for part in _chunks(times)]
    return np.concatenate(parts)


def _decaying(times: np.ndarray, radii: np.ndarray, ray: Ray, sizes: np.ndarray) -> np.ndarray:
    """Σ |E w| |e^{pt}|, shape (times,)."""
    rates = radii * np.imag(ray.turned)
    return np.concatenate([np.exp(np.outer(part, rates)) @ sizes for part in _chunks(times)])


def _chunks(times: np.ndarray) -> list[np.ndarray]:
    return np.array_split(times, -(-len(times) // _CHUNK))
