"""Heave of a thin float in the middle of a closed tank: exact modes of the thin boundary condition."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.special import zeta

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box_inertia import interface_moment, liquid_inertia
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float import thin_float_added_mass
from hydroelastic.modal.floats.thin_shapes import LARGE_ARGUMENT, check_pointed, wave_moment_series
from hydroelastic.modal.liquid.two_layer import interface_frequencies
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

_TAIL_RATIO = 8
_TAIL_TERMS = 18
_LEAST_WAVES = 64
_FEWEST_MODES = 16
_MOST_WAVES = 1_000_000
_MOST_MODES = 4096
_MARGIN = 1e-6
_TINY = 1e-300


@dataclass(frozen=True, kw_only=True)
class BoxModes:
    """The lowest modes in which the float heaves, symmetric about the middle of the tank."""

    omega: FloatArray  # angular frequencies, rad/s, ascending, shape (n,)
    modal_mass: FloatArray  # generalised masses for a unit of heave, kg/m, shape (n,)
    # share of heave in the potential energy, c'/(ω² M); over all modes it sums to 1, shape (n,)
    participation: FloatArray
    waves: FloatArray  # frequencies σ of the waves that the float couples, k = 2nπ/L, without it, rad/s, shape (n,)


@dataclass(frozen=True, kw_only=True)
class FloatMode:
    """The mode in which the float takes the largest part, see `float_mode`."""

    omega: float  # angular frequency, rad/s
    index: int  # its number among the symmetric modes, from 1
    modal_mass: float  # generalised mass for a unit of heave, kg/m
    participation: float  # share of heave in its potential energy


def box_modes(body: FloatInTank, count: int, *, volume_term: bool = True) -> BoxModes:
    """Return the lowest symmetric modes of the tank with a thin float in its middle, Λ = ω²:

        c (1 + 2b/L) − Λ M_∞ − Λ Σ_{n ≥ 1} w_n/(σ_n² − Λ) = 0,     w_n = (8/L)(ρ₂ − ρ₁) g R_n²,  k_n = 2nπ/L

    The left side falls between its poles, which holds one root below σ₁² and one between neighbours. The term 2b/L is
    that of k = 0: with the float sunk by s the mean level beside it rises by 2bs/L. Each root is found as its distance
    to the nearer pole, so that modes which hardly couple keep their modal mass; what the sum leaves out follows from
    the series of R in 1/k by Hurwitz zeta functions, without truncation.

    Args:
        body: the problem; two liquids need a rigid lid.
        volume_term: whether the mean level may rise; without it the volume is not kept, which is wrong.

    Source: two liquids, docs, § 6.
    """
    if count < 1:
        raise ValueError(f"count is {count}; it must be at least 1")
    return _modes(_secular(body, count, volume_term), count)


def float_mode(body: FloatInTank, *, volume_term: bool = True) -> FloatMode:
    """Return the mode with the largest participation of heave, among all symmetric modes.

    The participations sum to 1, which tells when no further mode can exceed the largest one found.

    Arguments and errors as in `box_modes`.
    """
    count = _FEWEST_MODES + _waves_below_resonance(body)
    while True:
        modes = box_modes(body, count, volume_term=volume_term)
        index = int(np.argmax(modes.participation))
        if modes.participation[index] >= 1 - modes.participation.sum():
            break
        if count >= _MOST_MODES:
            raise NoEstimateError(f"heave is spread over more than {_MOST_MODES} modes")
        count *= 2
    return FloatMode(
        omega=float(modes.omega[index]),
        index=index + 1,
        modal_mass=float(modes.modal_mass[index]),
        participation=float(modes.participation[index]),
    )


@dataclass(frozen=True, kw_only=True)
class _Secular:
    """c' − Λ M − Λ Σ w/(σ² − Λ), its first terms one by one, the others as a series in ν/N, ν = Λ/`spacing`."""

    stiffness: float
    inertia: float
    squares: FloatArray
    weights: FloatArray
    tail: FloatArray
    spacing: float

    def distances(self, pole: int | None, offset: float) -> FloatArray:
        """σ_n² − Λ for Λ = σ_pole² + offset."""
        return self.squares - self.origin(pole) - offset

    def origin(self, pole: int | None) -> float:
        return 0.0 if pole is None else float(self.squares[pole])

    def times_offset(self, pole: int | None, offset: float) -> float:
        """Return the left side times the offset, which has no pole there; the left side itself if pole is None."""
        square = self.origin(pole) + offset
        distances = self.distances(pole, offset)
        if pole is not None:
            distances[pole] = math.inf
        waves = np.sum(self.weights / distances) + np.polyval(self.tail, self._reach(square))
        rest = self.stiffness - square * (self.inertia + waves)
        return float(rest if pole is None else offset * rest + square * self.weights[pole])

    def modal_mass(self, pole: int | None, offset: float) -> float:
        """Return minus the derivative of the left side, M + Σ w σ²/(σ² − Λ)²."""
        reach = self._reach(self.origin(pole) + offset)
        terms = self.weights * self.squares / self.distances(pole, offset) ** 2
        order = np.arange(len(self.tail), 0, -1)
        return float(self.inertia + terms.sum() + np.polyval(self.tail * order, reach))

    def _reach(self, square: float) -> float:
        return square / (self.spacing * len(self.squares))


def _secular(body: FloatInTank, count: int, volume_term: bool) -> _Secular:
    profile = _thin_section(body)
    layers, length = body.layers, body.tank_length
    restoring = (layers.density_below - layers.density_above) * layers.gravity
    waves = _count_waves(profile, length, count)
    k = np.arange(1, waves + 1) * 2 * math.pi / length
    (sigma,) = interface_frequencies(layers, k).values()
    scale = 8 / length * restoring
    rise = scale / 2 * profile.half_width**2 if volume_term else 0.0
    spacing = _spacing(body)
    tail = _tail_series(profile, waves, k[-1] * profile.half_height)
    return _Secular(
        stiffness=body.stiffness + rise,
        inertia=body.mass + liquid_inertia(profile, layers, length, k),
        squares=sigma**2,
        weights=scale * interface_moment(profile, layers, k) ** 2,
        tail=scale * profile.half_width**2 / spacing * tail,
        spacing=spacing,
    )


def _spacing(body: FloatInTank) -> float:
    """Return the distance of σ² of neighbouring short waves, for which σ² = g* k."""
    layers = body.layers
    density_ratio = (layers.density_below - layers.density_above) / (layers.density_below + layers.density_above)
    return 2 * math.pi / body.tank_length * layers.gravity * density_ratio


def _waves_below_resonance(body: FloatInTank) -> int:
    """Return about how many waves are slower than the float without walls and waves, at most `_MOST_MODES`."""
    layers = body.layers
    added_mass = thin_float_added_mass(_thin_section(body), layers.density_below, layers.density_above)
    number = body.stiffness / (body.mass + added_mass) / _spacing(body)
    return min(math.ceil(number), _MOST_MODES)


def _thin_section(body: FloatInTank) -> Profile:
    """Return the section, or say why the secular equation does not hold."""
    profile = body.section()
    check_pointed(profile)
    if not body.is_centred:
        raise NoEstimateError("the float is not in the middle of the tank")
    if body.layers.density_above and body.layers.top != "rigid":
        raise NoEstimateError("the top over the two liquids is not a rigid lid")
    if math.isinf(body.clearance):
        raise NoEstimateError("a liquid is infinitely deep")
    return profile


def _count_waves(profile: Profile, length: float, count: int) -> int:
    """Return how many waves to sum one by one; beyond them coth = 1, no image is felt, and Λ ≪ σ²."""
    short = min(profile.half_height, profile.extent)
    waves = max(_LEAST_WAVES, _TAIL_RATIO * (count + 1), math.ceil(LARGE_ARGUMENT * length / (2 * math.pi * short)))
    if waves > _MOST_WAVES:
        raise NoEstimateError(f"the tank is so long beside the float that {waves} waves would be needed")
    return waves


def _tail_series(profile: Profile, waves: int, largest: float) -> FloatArray:
    """Return the coefficients, highest first, of Σ_{n>N} (R/b)²/(n − ν) in powers of ν/N; ``largest`` is κ_N.

    With (R/b)² = Σ C κ^{−P} they are Σ C κ_N^{−P} N^{P+p} ζ(P + 1 + p, N + 1), p the power.
    """
    powers, coefficients = wave_moment_series(profile)
    terms = coefficients * largest**-powers
    # The powers are evenly spaced, and the product is cut where the series itself is.
    squared, exponents = np.convolve(terms, terms)[: len(terms)], powers[0] + powers
    orders = exponents + 1 + np.arange(_TAIL_TERMS)[::-1, None]
    sums = float(waves) ** (orders - 1) * zeta(orders, waves + 1.0)
    tail: FloatArray = sums @ squared
    return tail


def _modes(secular: _Secular, count: int) -> BoxModes:
    roots = [_root(secular, index) for index in range(count)]
    squares = np.array([secular.origin(pole) + offset for pole, offset in roots])
    masses = np.array([secular.modal_mass(pole, offset) for pole, offset in roots])
    return BoxModes(
        omega=np.sqrt(squares),
        modal_mass=masses,
        participation=secular.stiffness / (squares * masses),
        waves=np.sqrt(secular.squares[:count]),
    )


def _root(secular: _Secular, index: int) -> tuple[int | None, float]:
    """Return the nearer pole and the distance to it of the root below pole ``index`` and above the one before."""
    lower = index - 1 if index else None
    half = (float(secular.squares[index]) - secular.origin(lower)) / 2
    # The left side falls from one pole to the next: its sign in the middle tells the half. A little more than that
    # half is searched, since beside the other pole rounding may change a sign that is nearly 0.
    pole, far = (index, -half) if secular.times_offset(lower, half) > 0 else (lower, half)
    far *= 1 + _MARGIN
    offset = brentq(lambda x: secular.times_offset(pole, x), 0.0, far, xtol=_TINY, rtol=4 * np.finfo(float).eps)
    return pole, float(offset)
