"""What the waves of a thin float in deep water add to its inertia, at every complex frequency."""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.floats.complex_moments import MOST_ANGLE, ComplexArray, complex_wave_moment
from hydroelastic.modal.floats.thin_shapes import check_pointed
from hydroelastic.physics.profiles import Profile

_STEP = 0.09
_REACH = 40
_NEAR_ONE = 0.25
_SERIES_TERMS = 28
_PLAIN_SECTOR = (math.pi + MOST_ANGLE) / 2


def greatest_angle(profile: Profile) -> float:
    """Return up to which |arg z| `wave_integral` is known: π for the exponential of infinite draught, 130° for other
    shapes.

    Beyond 3π/4 R(−z²) of a float with ends grows like e^{|z|²}.
    """
    return math.pi if has_infinite_draught(profile) else _PLAIN_SECTOR


def fastest_scale(profile: Profile) -> float:
    """Return √(h/extent), at least 1: the frequency z of waves as long as the float, where its end is short of h."""
    return math.sqrt(max(1.0, profile.half_height / profile.extent))


def wave_integral(profile: Profile, frequency: npt.ArrayLike) -> ComplexArray:
    """Return G(z) = ∫₀^∞ R(κ)² dκ/(κ + z²)/b² for Re z > 0, and its continuation across the imaginary axis:

        G(z) = ∫₀^∞ R² dκ/(κ + z²) − 2πi R(−z²)²,     π/2 < arg z.

    The exponential of infinite draught has (s − 1 − 2 Ln z)/(s − 1)², s = z². For other shapes κ runs on the ray arg κ
    = ±π/4, away from the pole −z², by the trapezoidal rule in ln κ, whose error falls exponentially with the step.

    Args:
        frequency: z = p √(h/g*) ≠ 0, p in e^{pt}, |arg z| up to `greatest_angle`; z = iω is the limit from Re z > 0,
            and on the cut z < 0 of the exponential it is that from above.

    Returns:
        Values in the shape of ``frequency``.

    Source: open water, docs, thin float.
    """
    check_pointed(profile)
    z = np.atleast_1d(np.asarray(frequency, dtype=np.complex128))
    limit = greatest_angle(profile)
    if np.any(z == 0) or np.any(np.abs(np.angle(z)) > limit * (1 + 1e-12)):
        raise ValueError(f"frequencies must not be 0, nor beyond an angle of {limit:.3f} from the positive axis")
    below = z.imag < 0
    upper = np.where(below, z.conj(), z)
    value = (_infinite_draught if has_infinite_draught(profile) else functools.partial(_by_ray, profile))(upper.ravel())
    value = value.reshape(z.shape)
    return np.where(below, value.conj(), value).reshape(np.shape(frequency))


def has_infinite_draught(profile: Profile) -> bool:
    """Whether it is the exponential without end, whose R has a pole at κ = −1 and no growth beyond."""
    return profile.shape == "exponential" and not profile.tail


def _infinite_draught(z: ComplexArray) -> ComplexArray:
    """(v − 2 Ln z)/v², v = z² − 1; beside z = 1, and only there, by Σ (−v)^m/(m + 2)."""
    v = z * z - 1
    near = (np.abs(v) < _NEAR_ONE) & (z.real > 0)
    value = np.empty_like(z)
    coefficients = [(-1) ** m / (m + 2) for m in range(_SERIES_TERMS)]
    value[near] = np.polyval(coefficients[::-1], v[near])
    value[~near] = (v[~near] - 2 * np.log(z[~near])) / v[~near] ** 2
    return value


def _by_ray(profile: Profile, z: ComplexArray) -> ComplexArray:
    """Im z ≥ 0: κ above the pole −z² until that crosses the positive axis, then below it with the residue."""
    square = z * z
    kappa, weights = _ray(profile, math.floor(min(0.0, 2 * math.log(np.abs(z).min())) / _STEP))
    value = np.empty_like(z)
    crossed = z.real < 0
    value[~crossed] = (weights / (kappa + square[~crossed, None])).sum(axis=1)
    pole = -square[crossed]
    value[crossed] = (weights.conj() / (kappa.conj() - pole[:, None])).sum(axis=1)
    value[crossed] -= 2j * math.pi * complex_wave_moment(profile, pole) ** 2
    return value


@functools.lru_cache(maxsize=64)
def _ray(profile: Profile, first: int) -> tuple[ComplexArray, ComplexArray]:
    """Return κ on arg κ = π/4 from e^{−40} below the smaller of 1 and |z²| to e^{40}, and the weights R² dκ."""
    reach = round(_REACH / _STEP)
    kappa = np.exp(_STEP * np.arange(first - reach, reach + 1) + 0.25j * math.pi)
    return kappa, _STEP * kappa * complex_wave_moment(profile, kappa) ** 2
