"""Complex frequencies at which a thin float in deep open water rings: poles of its free motion, and their number."""

from __future__ import annotations

import cmath
import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.floats.thin_float import thin_constants
from hydroelastic.modal.floats.wave_integral import fastest_scale, greatest_angle, has_infinite_draught, wave_integral
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

_FIRST_COUPLING = 0.02
_GROWTH = 1.15
_CIRCLE = 32
_NEWTON_STEPS = 40
_CONVERGED = 4e-16
_LEAST_LOG_RADIUS = -20.0
_MOST_LOG_RADIUS = 10.0
_MOST_TURN = 0.4
_MOST_REFINEMENTS = 60
_WHOLE = 1e-3


@dataclass(frozen=True, kw_only=True)
class FreePole:
    """A pole of the Laplace transform F(z) of the free motion f(θ), θ = t √(g*/h); its conjugate is one as well."""

    frequency: complex  # z = p √(h/g*), Re z < 0 < Im z: the motion contains 2 Re(residue e^{zθ})
    residue: complex  # that of F


def characteristic(profile: Profile, frequency: npt.ArrayLike) -> ComplexArray:
    """Return D(z) = z² (1 + ε G(z)) + Ω²h/g*, inertia with waves and stiffness of the float, whose zeros are its poles.

    Args:
        frequency: z, as for `wave_integral`.
    """
    constants = thin_constants(profile)
    return _characteristic(profile, constants.coupling, constants.frequency_squared, frequency)


@functools.lru_cache(maxsize=256)
def heave_pole(profile: Profile) -> FreePole:
    """Return the resonance of heave: the pole that comes from z = iΩ √(h/g*) as the float gets wider from nothing.

    It is followed by Newton's method through growing ε. For the exponential it is close to
    −(τ/4 + τ³/128) + i(1 + τ²/32 + τ³/16π).

    Args:
        profile: the section; for floats wider than they are high the label loses its meaning.

    Source: open water, docs, thin float.
    """
    target = thin_constants(profile).coupling
    coupling = min(target, _FIRST_COUPLING)
    return _followed(profile, coupling, 1j * math.sqrt(_frequency_squared(profile, coupling)))


@functools.lru_cache(maxsize=256)
def second_pole(profile: Profile) -> FreePole:
    """Return the other pole of the exponential of infinite draught, which comes from z = −1: −1 + (1 + i)√τ/2 +
    O(τ)."""
    if not has_infinite_draught(profile):
        raise NoEstimateError("only the exponential without end has exactly one more pole")
    coupling = min(thin_constants(profile).coupling, 1e-3)
    slenderness = math.pi * coupling / (2 - coupling)
    return _followed(profile, coupling, -1 + (1 + 1j) * math.sqrt(slenderness) / 2)


def pole_count(profile: Profile, angle: float) -> int:
    """Return how many poles have π/2 < arg z < ``angle``, from the argument of D along the border of that sector.

    For the exponential without end it is that of D (z² − 1)², without the double pole of G at −1 ± i0; with
    ``angle`` = π, along the upper side of the cut, it is 2.

    Args:
        angle: between π/2 and `greatest_angle`; no pole may lie on that ray.
    """
    if not math.pi / 2 < angle <= greatest_angle(profile):
        raise ValueError(f"angle is {angle}; it must be between π/2 and {greatest_angle(profile):.4f}")
    order = 4 if has_infinite_draught(profile) else 0
    outward = _turn(profile, math.pi / 2, order)
    back = _turn(profile, angle, order)
    arc = (2 + order) * (angle - math.pi / 2)
    turns = (outward + arc - back) / (2 * math.pi)
    if not abs(turns - round(turns)) < _WHOLE:
        raise NoEstimateError(f"the argument makes {turns:.4f} turns: a pole lies on the border of the sector")
    return round(turns)


def _characteristic(
    profile: Profile, coupling: float, frequency_squared: float, frequency: npt.ArrayLike
) -> ComplexArray:
    z = np.asarray(frequency, dtype=np.complex128)
    value: ComplexArray = z * z * (1 + coupling * wave_integral(profile, z)) + frequency_squared
    return value


def _frequency_squared(profile: Profile, coupling: float) -> float:
    """Ω²h/g* of a float of the same shape with another ε: (1 − Jε/2)/S."""
    constants = thin_constants(profile)
    return (1 - constants.inertia_factor * coupling / 2) / constants.area_factor


def _followed(profile: Profile, coupling: float, start: complex) -> FreePole:
    constants = thin_constants(profile)
    target, z = constants.coupling, start
    while True:
        last = coupling >= target
        squared = constants.frequency_squared if last else _frequency_squared(profile, coupling)
        z, slope = _newton(profile, coupling, squared, z)
        if last:
            return FreePole(frequency=z, residue=-squared / (z * slope))
        coupling = min(target, coupling * _GROWTH)


def _newton(profile: Profile, coupling: float, squared: float, start: complex) -> tuple[complex, complex]:
    """Return the zero and the derivative of D there, which comes from a circle around the point by Cauchy's formula."""
    z, slope, smallest = start, complex(math.nan), math.inf
    for _ in range(_NEWTON_STEPS):
        room = greatest_angle(profile) - cmath.phase(z)
        if room < 1e-9:
            break
        direction = np.exp(2j * math.pi * np.arange(_CIRCLE) / _CIRCLE)
        radius = 0.3 * abs(z) * math.sin(min(room, math.pi / 4))
        around = _characteristic(profile, coupling, squared, z + radius * direction)
        slope = complex(np.mean(around / direction) / radius)
        step = complex(np.mean(around)) / slope
        z -= step
        # Stop once rounding has taken over: the steps then no longer shrink.
        if abs(step) <= _CONVERGED * abs(z) or (abs(step) < 1e-12 * abs(z) and abs(step) >= smallest):
            return z, slope
        smallest = abs(step)
    raise NoEstimateError(f"the pole from {start:.6g} is not found in the sector where the theory is known")


def _turn(profile: Profile, angle: float, order: int) -> float:
    """Return by how much the argument of D (z² − 1)^{order/2} grows from near 0 to far out on the ray."""
    logarithms: FloatArray = np.linspace(_LEAST_LOG_RADIUS, _MOST_LOG_RADIUS + math.log(fastest_scale(profile)), 400)
    values = _on_ray(profile, angle, order, logarithms)
    for _ in range(_MOST_REFINEMENTS):
        coarse = np.abs(np.angle(values[1:] / values[:-1])) > _MOST_TURN
        if not coarse.any():
            break
        middle = (logarithms[1:][coarse] + logarithms[:-1][coarse]) / 2
        logarithms = np.concatenate([logarithms, middle])
        values = np.concatenate([values, _on_ray(profile, angle, order, middle)])
        ascending = np.argsort(logarithms)
        logarithms, values = logarithms[ascending], values[ascending]
    return float(np.sum(np.angle(values[1:] / values[:-1])))


def _on_ray(profile: Profile, angle: float, order: int, logarithms: npt.NDArray) -> ComplexArray:
    radius = np.exp(logarithms)
    z = radius * cmath.exp(1j * angle)
    if order:
        return _without_double_pole(profile, z)
    return characteristic(profile, z)


def _without_double_pole(profile: Profile, z: ComplexArray) -> ComplexArray:
    """D (z² − 1)² = (z² + Ω²)(z² − 1)² + ε z² (z² − 1 − 2 Ln z), finite at z = −1."""
    constants = thin_constants(profile)
    s = z * z
    # Ln of the upper side of the cut: the rounded imaginary part of a ray at π may be negative.
    logarithm = np.log(np.abs(z)) + 1j * np.abs(np.angle(z))
    return (s + constants.frequency_squared) * (s - 1) ** 2 + constants.coupling * s * (s - 1 - 2 * logarithm)
