"""Resonance and free motion of a thin float in an open channel of finite depth."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from numpy.polynomial.chebyshev import chebpts1, chebval, chebvander
from numpy.polynomial.legendre import leggauss
from scipy.optimize import brentq

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.channel_radiation import channel_inertia, channel_radiation, check_channel
from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_decay import FreeMotion
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

CHANNEL_SELF_CHECK = 1e-8
"""Greatest |f(0) − 1|, beyond which no value is given."""

_AGREEMENT = 1e-8
_NEWTON_STEPS = 20
_MOST_DAMPED = 0.3
_SERIES_REACH = ((0.7, 1.3), (0.5, 1.7), (0.3, 2.0))
_SERIES_POINTS = (32, 27)
_RATIO = 1.6
_POINTS = 20
_MOST_PANELS = 80
_NEGLIGIBLE = 1e-14
_GAUSS = 16
_MOST_PHASE = 12.0
_MOST_NODES = 2_000_000
_CHUNK = 4_000_000


@dataclass(frozen=True, kw_only=True)
class _Panel:
    """a and b on start < ω < end, as Chebyshev series; analytic, so that they hold for complex ω nearby as well."""

    start: float
    end: float
    coefficients: FloatArray

    def radiation(self, omega: npt.NDArray) -> tuple[npt.NDArray, npt.NDArray]:
        x = (2 * omega - self.start - self.end) / (self.end - self.start)
        added_mass, damping = chebval(x, self.coefficients)
        return added_mass, damping


@dataclass(frozen=True, kw_only=True)
class _Response:
    """The equation of motion, c − ω²(m + a + ib/ω), over all frequencies that matter."""

    stiffness: float
    mass: float
    panels: tuple[_Panel, ...]

    def dynamic_stiffness(self, panel: _Panel, omega: npt.NDArray) -> ComplexArray:
        added_mass, damping = panel.radiation(omega)
        value: ComplexArray = self.stiffness - omega**2 * (self.mass + added_mass) - 1j * omega * damping
        return value

    def density(self, panel: _Panel, omega: FloatArray) -> FloatArray:
        """(2/π) c b/|c − ω²(m + a) − iωb|², of which f is the cosine transform."""
        _, damping = panel.radiation(omega)
        response: FloatArray = damping / np.abs(self.dynamic_stiffness(panel, omega)) ** 2
        return 2 / math.pi * self.stiffness * response

    @property
    def resonant_panel(self) -> _Panel:
        """That in which c − ω²(m + a) changes its sign."""
        for panel in self.panels:
            if self.dynamic_stiffness(panel, np.array([panel.end]))[0].real < 0:
                return panel
        raise NoEstimateError("no resonance below the frequencies that matter")


def channel_resonance(profile: Profile, layers: TwoLayers) -> complex:
    """Return the complex resonance ω − iγ of heave in the channel, rad/s: c = ω²(m + a + ib/ω), a and b continued.

    Args:
        profile: the section.
        layers: the liquids, as for `channel_radiation`.

    Raises:
        NoEstimateError: as `channel_radiation`, and where the resonance is so far from the real axis that γ > 0.3 ω, or
            that two continuations, of different order, differ by more than 1e-8.

    Source: open water, docs, thin float.
    """
    response = _response(profile, layers, _POINTS)
    coarse = response.resonant_panel
    omega = _undamped(response, coarse)
    # Narrow series are more precise near the real axis, wide ones reach farther from it.
    candidates = []
    for start, end in _SERIES_REACH:
        found, other = (
            _damped(response, _fit(profile, layers, start * omega, end * omega, points), omega)
            for points in _SERIES_POINTS
        )
        candidates.append((abs(found - other) / abs(found), found))
    agreeing = [pair for pair in candidates if pair[0] < _AGREEMENT and -pair[1].imag < _MOST_DAMPED * pair[1].real]
    if not agreeing:
        raise NoEstimateError("the float is so wide that its resonance is too far from the real frequencies")
    return min(agreeing, key=lambda pair: pair[0])[1]


def channel_free_motion(profile: Profile, layers: TwoLayers, time: npt.ArrayLike) -> FreeMotion:
    """Return s(t)/s₀ of a float released from rest in the channel, where it is also at rest:

        f(t) = (2/π) ∫₀^∞ c b cos ωt/|c − ω²(m + a) − iωb|² dω.

    With both depths finite a and b are even in ω and smooth at ω = 0, so that f has no algebraic tail like that of deep
    liquids. a and b are taken from Chebyshev series on panels of ω; the integral goes by Gauss points on panels that
    resolve the resonance and cos ωt. The error estimate is the difference to coarser series and panels, and |f(0) − 1|.

    Args:
        profile: the section.
        layers: the liquids, as for `channel_radiation`.
        time: t ≥ 0, s.

    Raises:
        NoEstimateError: as `channel_radiation`; for times so late that they need too many points; or if f(0) misses 1
            by more than `CHANNEL_SELF_CHECK`.
        ValueError: if a time is negative or not finite.

    Source: open water, docs, thin float.
    """
    instants = np.asarray(time, dtype=np.float64)
    if not np.all(np.isfinite(instants) & (instants >= 0)):
        raise ValueError("times must be finite and not negative")
    flat = np.append(instants.ravel(), 0.0)
    fine = _transform(_response(profile, layers, _POINTS + 4), flat, _MOST_PHASE / 2)
    coarse = _transform(_response(profile, layers, _POINTS), flat, _MOST_PHASE)
    miss = abs(fine[-1] - 1)
    if not miss < CHANNEL_SELF_CHECK:
        raise NoEstimateError(f"the motion in the channel begins at {fine[-1]:.10g}, not at 1")
    error = np.abs(fine - coarse) + miss
    return FreeMotion(heave=fine[:-1].reshape(instants.shape), error=error[:-1].reshape(instants.shape))


@functools.lru_cache(maxsize=16)
def _response(profile: Profile, layers: TwoLayers, points: int) -> _Response:
    check_channel(profile, layers)
    stiffness = thin_float_stiffness(profile, layers.density_below, layers.density_above, layers.gravity)
    mass = thin_float_mass(profile, layers.density_below, layers.density_above)
    stiff = math.sqrt(stiffness / (mass + channel_inertia(profile, layers)))
    panels: list[_Panel] = []
    # Long waves of the deepest liquid are the slowest that matter.
    depths = [layers.depth_below, layers.depth_above if layers.density_above else 0.0]
    deepest = max(depth for depth in depths if math.isfinite(depth))
    start, end = 0.0, min(0.05 * stiff, 0.1 * math.sqrt(stiffness / (mass / profile.half_height * deepest)))
    while len(panels) < _MOST_PANELS:
        panels.append(_fit(profile, layers, start, end, points))
        response = _Response(stiffness=stiffness, mass=mass, panels=tuple(panels))
        if end > 2 * stiff and end * response.density(panels[-1], np.array([end]))[0] < _NEGLIGIBLE:
            return response
        start, end = end, end * _RATIO
    raise NoEstimateError("the float answers over too wide a range of frequencies")


def _fit(profile: Profile, layers: TwoLayers, start: float, end: float, points: int) -> _Panel:
    nodes = chebpts1(points)
    omega = start + (end - start) * (nodes + 1) / 2
    values = np.stack(channel_radiation(profile, layers, omega), axis=1)
    return _Panel(start=start, end=end, coefficients=np.linalg.solve(chebvander(nodes, points - 1), values))


def _damped(response: _Response, panel: _Panel, omega: float) -> complex:
    """Return the zero of c − ω²(m + a) − iωb by Newton's method from real ω; nan if it does not converge."""
    z, change = complex(omega), complex(math.inf)
    for _ in range(_NEWTON_STEPS):
        step = 1e-4 * abs(z)
        value, ahead, behind = response.dynamic_stiffness(panel, np.array([z, z + step, z - step]))
        change = complex(value * 2 * step / (ahead - behind))
        z -= change
    # Far from the real axis rounding is amplified, and steps end above it: two series tell how much that matters.
    return z if abs(change) < _AGREEMENT * abs(z) else complex(math.nan)


def _undamped(response: _Response, panel: _Panel) -> float:
    """Return ω of c = ω²(m + a)."""
    return float(
        brentq(lambda w: response.dynamic_stiffness(panel, np.array([w]))[0].real, panel.start, panel.end, xtol=1e-15)
    )


def _transform(response: _Response, time: FloatArray, phase: float) -> FloatArray:
    """Return ∫ density cos ωt dω with at most ``phase`` radians of ωt a panel."""
    omega, weights = _rule(response, phase / max(float(time.max()), 1e-300))
    chunks = np.array_split(time, max(1, math.ceil(time.size * omega.size / _CHUNK)))
    return np.concatenate([np.cos(np.multiply.outer(part, omega)) @ weights for part in chunks])


def _rule(response: _Response, widest: float) -> tuple[FloatArray, FloatArray]:
    nodes, gauss = leggauss(_GAUSS)
    breaks = _breaks(response)
    all_points, all_weights = [], []
    for panel in response.panels:
        inner = breaks[(breaks > panel.start) & (breaks < panel.end)]
        edges = np.concatenate([[panel.start], inner, [panel.end]])
        counts = np.ceil(np.diff(edges) / widest)
        if counts.sum() * _GAUSS > _MOST_NODES:
            raise NoEstimateError("times are so late that they need too many frequencies")
        edges = np.concatenate(
            [np.linspace(a, b, int(n) + 1)[:-1] for a, b, n in zip(edges[:-1], edges[1:], counts, strict=True)]
            + [edges[-1:]]
        )
        half = np.diff(edges)[:, None] / 2
        omega = (edges[:-1, None] + half * (nodes + 1)).ravel()
        all_points.append(omega)
        all_weights.append((half * gauss).ravel() * response.density(panel, omega))
    return np.concatenate(all_points), np.concatenate(all_weights)


def _breaks(response: _Response) -> FloatArray:
    """Return ends of panels that get finer towards the resonance, down to its width γ = b/2(m + a)."""
    panel = response.resonant_panel
    omega = _undamped(response, panel)
    added_mass, damping = panel.radiation(np.array([omega]))
    width = float(damping[0] / (2 * (response.mass + added_mass[0])))
    distances = width * 2.0 ** np.arange(math.ceil(math.log2(max(omega / width, 2.0))))
    return np.sort(np.concatenate([omega - distances, [omega], omega + distances]))
