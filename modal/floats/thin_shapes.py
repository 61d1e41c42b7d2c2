"""Moments of a thin float's flux q = −ω' in units of half-width and half-height, for every shape with pointed ends."""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss
from scipy.special import j1, poch, spherical_jn

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import FloatShape, Profile

LARGE_ARGUMENT = 50.0
"""From here on e^{−κ} is nothing beside 1, and the series of R in 1/κ have full precision."""

_FAR = 1e3
_POINTS = 20
_PANELS = 4
_SERIES_TERMS = 13
_INERTIA: dict[FloatShape, float] = {"parabola": 2.0, "ellipse": math.pi**2 / 4, "wedge": 2 * math.log(2)}
_AREA: dict[FloatShape, float] = {"parabola": 2 / 3, "ellipse": math.pi / 4, "wedge": 1 / 2}


def check_pointed(profile: Profile) -> None:
    """Refuse a section that ends in a flat edge."""
    if profile.is_blunt:
        raise NoEstimateError(
            f"the {profile.shape} ends in flat edges, where the slope of a thin float would be infinite: "
            "its added mass J diverges"
        )


def area_factor(profile: Profile) -> float:
    """Return S = ∫ω dy/(b h) over the upper half."""
    check_pointed(profile)
    if profile.shape != "exponential":
        return _AREA[profile.shape]
    if not profile.tail:
        return 1.0
    end = _relative_extent(profile)
    # (1 − t − t ln(1/t))/(1 − t), t = e^{−end}, without cancellation for t near 1.
    return _over_decay(end) if end < 1 else 1 - profile.tail * end / (1 - profile.tail)


def inertia_factor(profile: Profile) -> float:
    """Return J/b² = ∬ q(y) q(y') ln|(y + y')/(y − y')| dy dy' over the upper half, y in units of h."""
    check_pointed(profile)
    if profile.shape != "exponential":
        return _INERTIA[profile.shape]
    return _exponential_inertia(_relative_extent(profile)) if profile.tail else 1.0


def wave_moment(profile: Profile, argument: npt.ArrayLike) -> FloatArray:
    """Return R(κ)/b = ∫ q e^{−κy} dy over the upper half, y in units of h: what the float sends into waves of κ = kh.

    Args:
        argument: κ ≥ 0.

    Returns:
        Values in the shape of ``argument``; 1 at κ = 0.
    """
    check_pointed(profile)
    kappa = np.atleast_1d(np.asarray(argument, dtype=np.float64))
    if profile.shape == "exponential":
        end = _relative_extent(profile)
        moment = -np.expm1(-(1 + kappa) * end) / ((1 + kappa) * (1 - profile.tail))
    else:
        moment = np.empty_like(kappa)
        large = kappa > LARGE_ARGUMENT
        moment[~large] = _by_points(profile, kappa[~large])
        powers, coefficients = wave_moment_series(profile)
        moment[large] = np.sum(coefficients * kappa[large, None] ** -powers, axis=1)
    return moment.reshape(np.shape(argument))


def wave_moment_series(profile: Profile) -> tuple[FloatArray, FloatArray]:
    """Return powers p and coefficients c of R(κ)/b = Σ c κ^{−p}, to full precision for κ and κ·extent/h > 50."""
    check_pointed(profile)
    m = np.arange(_SERIES_TERMS, dtype=np.float64)
    if profile.shape == "wedge":
        return np.array([1.0]), np.array([1.0])
    if profile.shape == "parabola":
        return np.array([2.0]), np.array([2.0])
    if profile.shape == "exponential":
        return m + 1, (-1.0) ** m / (1 - profile.tail)
    # Watson's lemma for y (1 − y²)^{−1/2}.
    factorials = np.array([math.factorial(2 * int(i) + 1) / math.factorial(int(i)) for i in m])
    return 2 * m + 2, poch(0.5, m) * factorials


def end_wave_moment(profile: Profile, argument: npt.ArrayLike) -> FloatArray:
    """Return ∫ q e^{−κ(Y − y)} dy/b, y and the extent Y in units of h, for 0 ≤ κY ≤ 50; the image of R in a bottom.

    Args:
        profile: the section, bounded.
        argument: κ, shape (n,).
    """
    kappa = np.asarray(argument, dtype=np.float64)
    _, gaps, weights = flux_rule(profile)
    moment: FloatArray = np.exp(-np.multiply.outer(kappa, gaps)) @ weights
    return moment


def sine_moment(profile: Profile, argument: npt.ArrayLike) -> FloatArray:
    """Return Q_s(κ)/b = ∫ q sin κy dy over the upper half, y in units of h.

    Args:
        argument: κ > 0, shape (n,).
    """
    check_pointed(profile)
    kappa = np.asarray(argument, dtype=np.float64)
    if profile.shape == "wedge":
        return 2 * np.sin(kappa / 2) ** 2 / kappa
    if profile.shape == "parabola":
        return 2 * spherical_jn(1, kappa)
    if profile.shape == "ellipse":
        return np.pi / 2 * j1(kappa)
    if not profile.tail:
        return kappa / (1 + kappa**2)
    end = _relative_extent(profile)
    phase = kappa * end
    ending = profile.tail * (np.sin(phase) + kappa * np.cos(phase))
    moment = (kappa - ending) / ((1 + kappa**2) * (1 - profile.tail))
    small = phase < 20
    y, _, weights = flux_rule(profile)
    moment[small] = np.sin(np.multiply.outer(kappa[small], y)) @ weights
    return moment


@functools.lru_cache(maxsize=64)
def flux_rule(profile: Profile, smallest: float = 1.0) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return a quadrature rule for ∫ q(y) f(y) dy/b over the upper half, y in units of h.

    Args:
        smallest: relative distance from the pointed end on which f still changes; panels are graded down to it.

    An exponential without end, or with a very distant one, is taken as far as e^{−y} reaches in double precision.

    Returns:
        Points y, their distances to the end Y − y (precise where small), and weights, which sum to 1, each of shape
        (n,); do not write to them.
    """
    check_pointed(profile)
    end = min(_relative_extent(profile), _FAR)
    # u = 0 at the pointed end, 1 at the level y = 0.
    u, weights = _panel_rule(_breaks(end if profile.shape == "exponential" else 0.0, smallest))
    if profile.shape == "ellipse":
        angle = np.pi / 2 * u
        return np.cos(angle), 2 * np.sin(angle / 2) ** 2, np.pi / 2 * np.cos(angle) * weights
    if profile.shape == "exponential":
        y = end * (1 - u)
        return y, end * u, end * np.exp(-y) / (1 - profile.tail) * weights
    density = np.ones_like(u) if profile.shape == "wedge" else 2 * (1 - u)
    return 1 - u, u, density * weights


def _breaks(decays: float, smallest: float) -> FloatArray:
    """Return the ends of the panels in u; ``decays`` is the number of decay lengths over 0 < u < 1."""
    start = 0.0 if decays <= LARGE_ARGUMENT else 1 - LARGE_ARGUMENT / decays
    count = max(_PANELS, math.ceil(decays * (1 - start) / 3))
    even = np.linspace(start, 1.0, count + 1)
    halvings = math.ceil(-math.log2(min(max(smallest, 1e-16), 1.0)))
    graded = even[1] * 0.5 ** np.arange(1, halvings + 1) if start == 0 else np.empty(0)
    return np.unique(np.concatenate([even, graded]))


def _panel_rule(breaks: FloatArray) -> tuple[FloatArray, FloatArray]:
    nodes, weights = leggauss(_POINTS)
    half = np.diff(breaks)[:, None] / 2
    return (breaks[:-1, None] + half * (nodes + 1)).ravel(), (half * weights).ravel()


def _relative_extent(profile: Profile) -> float:
    return profile.extent / profile.half_height


def _by_points(profile: Profile, kappa: FloatArray) -> FloatArray:
    y, _, weights = flux_rule(profile)
    moment: FloatArray = np.exp(-np.multiply.outer(kappa, y)) @ weights
    return moment


def _over_decay(end: float) -> float:
    """Return (1 − e^{−Y}(1 + Y))/(1 − e^{−Y}) by Σ_{m ≥ 2} Y^m/m! = e^Y − 1 − Y."""
    remainder = sum(end**m / math.factorial(m) for m in range(2, 20))
    return remainder / math.expm1(end)


@functools.lru_cache(maxsize=64)
def _exponential_inertia(end: float) -> float:
    """Return J/b² of the exponential that ends at Y, from its integrals over y + y' and |y − y'| alone:

    (1 − e^{−Y})² J = ∫₀^Y [u e^{−u} − e^{−u} (1 − e^{−2(Y−u)})] ln(u/Y) du + ∫_Y^{2Y} (2Y − u) e^{−u} ln(u/Y) du.
    """
    reach = min(end, LARGE_ARGUMENT)
    # u = reach s⁶ turns the logarithm into a smooth function.
    s, weights = _panel_rule(np.linspace(0, 1, 9))
    u = reach * s**6
    density = u * np.exp(-u) + np.exp(-u) * np.expm1(-2 * (end - u))
    total = np.sum(6 * reach * s**5 * weights * density * np.log(u / end))
    if end < LARGE_ARGUMENT:
        v, weights = _panel_rule(np.linspace(end, 2 * end, 9))
        total += np.sum(weights * (2 * end - v) * np.exp(-v) * np.log(v / end))
    return float(total / math.expm1(-end) ** 2)
