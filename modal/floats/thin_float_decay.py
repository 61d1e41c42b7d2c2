"""Free motion of a thin float that is released in deep open water."""

from __future__ import annotations

import cmath
import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import lambertw

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.floats.thin_float import thin_constants
from hydroelastic.modal.floats.thin_float_resonance import FreePole, heave_pole, pole_count, second_pole
from hydroelastic.modal.floats.wave_integral import fastest_scale, greatest_angle, has_infinite_draught, wave_integral
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

SELF_CHECK = 1e-10
"""Greatest |f(0) − 1|, beyond which no value is given."""

LATEST = 1e100
"""Greatest θ: z² beyond its inverse would underflow."""

_BOTH_POLES = 0.45
_SECOND_RAY = 0.4
# Errors e^{−46}: late waves grow by up to 1e4 towards the imaginary axis, beside which slender floats have their pole.
_DIGITS = 46
_LEAST_LOG_RADIUS = -21.0
_MOST_LOG_RADIUS = 10.0
_CHUNK = 1000
_EPS = np.finfo(float).eps
_LEAST_GAP = math.radians(4)
_BISECTIONS = 6


@dataclass(frozen=True, kw_only=True)
class FreeMotion:
    """Motion after a release from rest, relative to the first displacement."""

    heave: FloatArray  # f = s/s₀, in the shape of the times
    error: FloatArray  # estimate of its absolute error, of the same shape


def free_motion(profile: Profile, time: npt.ArrayLike) -> FreeMotion:
    """Return f(θ) of a thin float released in deep liquids, for all θ ≥ 0:

        f = Σ 2 Re(r e^{zθ}) + (1/π) Im ∫₀^∞ E(ρe^{iφ}) e^{iφ} e^{ρe^{iφ}θ} dρ,
        E = z Ω² εG/((z²(1 + εG) + Ω²)(z² + Ω²)),

    over the poles z between the imaginary axis and a ray arg z = φ that stays clear of all poles. The integral goes by
    the trapezoidal rule in ln ρ. The error estimate is the difference between two rays, the nodes of one between those
    of the other, with the rounding of the phase Im(z) θ. The ray holds the late tail with full relative precision.

    Args:
        time: θ = t √(g*/h), from 0 to `LATEST`.

    Source: open water, docs, thin float.
    """
    theta = np.asarray(time, dtype=np.float64)
    if not np.all((theta >= 0) & (theta <= LATEST)):
        raise ValueError(f"times must be between 0 and {LATEST:g}")
    poles, angle, gap = _plan(profile)
    # θ = 0 last, for the check.
    flat = np.append(theta.ravel(), 0.0)
    ringing, rounding = _ringing(poles, flat)
    waves = _ray_integral(profile, angle, gap, flat)
    shift = (1 - 2 * _SECOND_RAY) * gap
    # Between the nodes of a rule its error has the other sign.
    other = _ray_integral(profile, angle - shift, gap - shift, flat, offset=0.5)
    heave = ringing + waves
    if not abs(heave[-1] - 1) < SELF_CHECK:
        raise NoEstimateError(f"the motion of so wide a float begins at {heave[-1]:.6g}, not at 1")
    error = np.abs(waves - other) + rounding + 4 * _EPS * np.abs(waves)
    return FreeMotion(heave=heave[:-1].reshape(theta.shape), error=error[:-1].reshape(theta.shape))


def free_motion_tail(profile: Profile, time: npt.ArrayLike) -> FloatArray:
    """Return −(4τ/π)/θ² = −(4/π) b/(g* t²), to which f tends at late times: neither mass nor shape matters.

    Args:
        time: θ > 0.

    Source: F. Ursell, J. Fluid Mech. 19 (1964), for the half-immersed circle; open water, docs, thin float.
    """
    theta = np.asarray(time, dtype=np.float64)
    tail: FloatArray = -4 / math.pi * profile.half_width / profile.half_height / theta**2
    return tail


def crossover_time(profile: Profile) -> float:
    """Return the last θ at which 2|r| e^{−γθ} of the heave pole equals the tail 4τ/(πθ²); later the tail is all."""
    pole = heave_pole(profile)
    rate = -pole.frequency.real
    ratio = 2 / math.pi * profile.half_width / profile.half_height / abs(pole.residue)
    argument = -rate / 2 * math.sqrt(ratio)
    if argument < -1 / math.e:
        raise NoEstimateError("the tail exceeds the oscillation of so wide a float at all times")
    return float(-2 / rate * lambertw(argument, -1).real)


@functools.lru_cache(maxsize=256)
def _plan(profile: Profile) -> tuple[tuple[FreePole, ...], float, float]:
    """Return the poles to the right of the ray, its angle φ, and how far the nearest singularity is from it."""
    poles: tuple[FreePole, ...] = (heave_pole(profile),)
    if has_infinite_draught(profile):
        poles, limit = _plan_infinite_draught(profile)
    else:
        limit = _clear_angle(profile)
    first = max(cmath.phase(pole.frequency) for pole in poles)
    return poles, (first + limit) / 2, (limit - first) / 2


def _plan_infinite_draught(profile: Profile) -> tuple[tuple[FreePole, ...], float]:
    heave, second = heave_pole(profile), second_pole(profile)
    if thin_constants(profile).coupling > _BOTH_POLES:
        return (heave, second), math.pi
    return (heave,), cmath.phase(second.frequency)


def _clear_angle(profile: Profile) -> float:
    """Return up to which angle heave is the only pole, found by counting."""
    heave = cmath.phase(heave_pole(profile).frequency)
    low, high = heave + _LEAST_GAP, greatest_angle(profile)
    if pole_count(profile, high) == 1:
        return high
    if low >= high or pole_count(profile, low) != 1:
        raise NoEstimateError("the float is so wide that a further pole is as near as that of heave")
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if pole_count(profile, middle) == 1 else (low, middle)
    return low


def _ringing(poles: tuple[FreePole, ...], theta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return Σ 2 Re(r e^{zθ}) and its rounding."""
    total, rounding = np.zeros_like(theta), np.zeros_like(theta)
    for pole in poles:
        term = 2 * pole.residue * np.exp(pole.frequency * theta)
        total += term.real
        rounding += 4 * _EPS * (1 + abs(pole.frequency) * theta) * np.abs(term)
    return total, rounding


def _ray_integral(profile: Profile, angle: float, gap: float, theta: FloatArray, offset: float = 0.0) -> FloatArray:
    constants = thin_constants(profile)
    step = 2 * math.pi * gap / _DIGITS
    least = _LEAST_LOG_RADIUS - math.log1p(float(theta.max()))
    most = _MOST_LOG_RADIUS + math.log(fastest_scale(profile))
    logarithm = step * (np.arange(math.floor(least / step), math.ceil(most / step) + 1) + offset)
    z: ComplexArray = np.exp(logarithm) * cmath.exp(1j * angle)
    waves = constants.coupling * wave_integral(profile, z)
    free = z * z + constants.frequency_squared
    weights = step * z * z * constants.frequency_squared * waves / ((free + z * z * waves) * free)
    chunks = np.array_split(theta, math.ceil(theta.size / _CHUNK))
    return np.concatenate([(np.exp(np.multiply.outer(part, z)) @ weights).imag for part in chunks]) / math.pi
