"""Catenaries between two points under a constant load per unstretched length."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, root

from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape
from hydroelastic.modal.thread.taut import taut_tension
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread_load import UP

# sinh(x)/x − 1 by its series below: at 0.5 the first term left out is 1e-17 of the sum.
_SERIES = 0.5
_SERIES_TERMS = 8


@dataclass(frozen=True)
class _Plane:
    """Plane of the chord and the load; the load acts along −up."""

    level: FloatArray  # unit vector in the plane, across the load
    up: FloatArray  # unit vector against the load
    span: float  # component of the chord along level, m, not negative
    rise: float  # component of the chord along up, m


def _plane(chord: FloatArray, load: FloatArray) -> _Plane:
    size = float(np.linalg.norm(load))
    up = -load / size if size > 0 else UP
    rise = float(chord @ up)
    across = chord - rise * up
    span = float(np.linalg.norm(across))
    # Rounding of the chord is no span: without one any level does.
    if span <= 4 * np.finfo(float).eps * abs(rise):
        return _Plane(np.zeros(3), up, 0.0, rise)
    return _Plane(across / span, up, span, rise)


def catenary_between(a: ArrayLike, b: ArrayLike, length: float, load_vector: ArrayLike, s: ArrayLike) -> ThreadShape:
    """Return the catenary of a thread that does not stretch, under a constant load q.

    In the plane of the chord and q, with h across and v against q: √(L² − v²)/h = sinh(x)/x, H = |q| h/(2x).

    Args:
        a: position of end A, m, shape (3,).
        b: position of end B, m.
        length: L, m, longer than the chord.
        load_vector: q, N/m, shape (3,).
        s: places along the thread, m, shape (n,).

    Returns:
        Positions and contact forces at s.
    """
    begin, places = np.asarray(a, dtype=float), np.asarray(s, dtype=float)
    chord, load = np.asarray(b, dtype=float) - begin, np.asarray(load_vector, dtype=float)
    weight, distance = float(np.linalg.norm(load)), float(np.linalg.norm(chord))
    if not weight > 0:
        raise ValueError(f"load_vector is {load}: a slack thread needs a load, which must not be zero")
    if not length > distance:
        raise ValueError(f"length is {length} m: it must be longer than the chord, {distance} m")
    plane = _plane(chord, load)
    if plane.span == 0:
        raise NoTensionError("the chord is parallel to the load: the thread hangs in two straight parts")
    tension, start = _inextensible(plane, length, distance, weight)
    return _shape(plane, begin, places, tension, start, weight, math.inf)


def elastic_catenary(
    a: ArrayLike, b: ArrayLike, length: float, weight: float, axial_rigidity: float, s: ArrayLike
) -> ThreadShape:
    """Return the catenary of a thread that stretches, under its weight.

    x(s) = H s/EA + (H/w)(asinh((V + ws)/H) − asinh(V/H)), z(s) = (Vs + ws²/2)/EA + (T(s) − T(0))/w,
    T² = H² + (V + ws)², with H and V such that the thread ends at B.

    Args:
        a: position of end A, m, shape (3,).
        b: position of end B, m.
        length: L, unstretched, m; shorter or longer than the chord.
        weight: w, submerged, N/m of unstretched length; negative if the thread is buoyant.
        axial_rigidity: EA, N.
        s: places along the thread, m, shape (n,).

    Returns:
        Positions and contact forces at s.

    Source: Irvine, Cable Structures, 1981, ch. 1.
    """
    begin, places = np.asarray(a, dtype=float), np.asarray(s, dtype=float)
    chord = np.asarray(b, dtype=float) - begin
    if not (math.isfinite(length) and length > 0):
        raise ValueError(f"length is {length}: it must be finite and positive")
    if not (math.isfinite(axial_rigidity) and axial_rigidity > 0):
        raise ValueError(f"axial_rigidity is {axial_rigidity}: it must be finite and positive")
    distance, size = float(np.linalg.norm(chord)), abs(weight)
    if weight == 0 and distance <= length:
        raise NoTensionError("a thread without weight that is not stretched has no shape of its own")
    plane = _plane(chord, -weight * UP)
    if plane.span == 0:
        return _vertical(plane, begin, places, length, size, axial_rigidity)
    for guess in _guesses(plane, length, distance, size, axial_rigidity):
        force = max(math.hypot(*guess), size * length)

        def miss(unknowns: FloatArray, force: float = force) -> FloatArray:
            level, start = force * unknowns
            end = catenary_coordinates(np.array([length]), abs(level), start, size, axial_rigidity)
            return np.array([end[0][0] - plane.span, end[1][0] - plane.rise]) / length

        found = root(miss, np.array(guess) / force, options={"xtol": 1e-14})
        if np.abs(miss(found.x)).max() < 1e-10:
            return _shape(plane, begin, places, abs(force * found.x[0]), force * found.x[1], size, axial_rigidity)
    raise NoTensionError("no elastic catenary is found between the ends")


def _guesses(
    plane: _Plane, length: float, distance: float, weight: float, axial_rigidity: float
) -> list[tuple[float, float]]:
    """Return (H, V at A) of a nearly straight thread, and of one that does not stretch where there is one."""
    across = weight * plane.span / distance
    tension = taut_tension(length, distance, across, axial_rigidity)
    taut = (tension * plane.span / distance, tension * plane.rise / distance - 0.5 * weight * length)
    if not length > distance:
        return [taut]
    slack = _inextensible(plane, length, distance, weight)
    return [taut, slack] if tension > weight * length else [slack, taut]


def _vertical(
    plane: _Plane, begin: FloatArray, places: FloatArray, length: float, weight: float, axial_rigidity: float
) -> ThreadShape:
    """Return the straight vertical thread: v = ±L + (V L + w L²/2)/EA, V ≷ 0 all along it."""
    for sign in (1.0, -1.0):
        start = axial_rigidity * (plane.rise - sign * length) / length - 0.5 * weight * length
        if min(sign * start, sign * (start + weight * length)) > 0:
            along = start + weight * places
            height = sign * places + (start * places + 0.5 * weight * places**2) / axial_rigidity
            return ThreadShape(s=places, positions=begin + np.outer(height, plane.up), forces=np.outer(along, plane.up))
    raise NoTensionError("the chord is vertical: the thread hangs in two straight parts")


def _inextensible(plane: _Plane, length: float, distance: float, weight: float) -> tuple[float, float]:
    """Return H and the component of N(0) against the load."""
    reach = math.sqrt((length - plane.rise) * (length + plane.rise))
    excess = (length - distance) * (length + distance) / (plane.span * (reach + plane.span))
    # x² /6 < sinh(x)/x − 1 and log(sinh(x)/x) > x/2 − 1 bound the root.
    high = min(math.sqrt(6 * excess), 2 * math.log1p(excess) + 2) * (1 + 1e-9)
    x = brentq(lambda x: _log_excess(x) - math.log(excess), 1e-3 * high, high, xtol=1e-300, rtol=1e-15)
    return weight * plane.span / (2 * x), 0.5 * weight * (plane.rise / math.tanh(x) - length)


def _log_excess(x: float) -> float:
    """Return log(sinh(x)/x − 1), without cancellation near 0 and without overflow."""
    if x < _SERIES:
        term, total = 1.0, 0.0
        for number in range(1, _SERIES_TERMS + 1):
            term *= x * x / (2 * number * (2 * number + 1))
            total += term
        return math.log(total)
    logarithm = x + math.log1p(-math.exp(-2 * x)) - math.log(2 * x)
    return logarithm + math.log1p(-math.exp(-logarithm))


def catenary_coordinates(
    s: FloatArray, level: float, start: float, weight: float, axial_rigidity: float
) -> tuple[FloatArray, FloatArray]:
    """Return the coordinates of a catenary from its lower forces, in forms without cancellation when nearly straight.

    With V₀, T₀ at A and V = V₀ + ws, T at s: T − T₀ = ws(V₀ + V)/(T + T₀), and the difference of asinh V/H and
    asinh V₀/H is the asinh of ws(TT₀ − VV₀ + H²)/(H²(T + T₀)).

    Args:
        s: places along the thread, m, shape (n,).
        level: H, N, positive.
        start: V₀, N.
        weight: w, N/m, not negative.
        axial_rigidity: EA, N; infinite if the thread does not stretch.

    Returns:
        The coordinates across the load and against it, from A, m, shape (n,) each.
    """
    after = start + weight * s
    first, tension = math.hypot(level, start), np.hypot(level, after)
    height = s * (start + after) / (tension + first)
    product = start * after
    # TT₀ − VV₀, cancellation-free where V₀V > 0.
    squares = level**2 * (level**2 + start**2 + after**2)
    gap = np.where(product > 0, squares / (tension * first + np.abs(product)), tension * first - product)
    argument = s * (gap + level**2) / (level * (tension + first))
    turn = weight * argument / level
    across = argument * np.where(turn == 0, 1.0, np.arcsinh(turn) / np.where(turn == 0, 1.0, turn))
    return across + level * s / axial_rigidity, height + 0.5 * s * (start + after) / axial_rigidity


def _shape(
    plane: _Plane, begin: FloatArray, s: FloatArray, level: float, start: float, weight: float, axial_rigidity: float
) -> ThreadShape:
    across, height = catenary_coordinates(s, level, start, weight, axial_rigidity)
    positions = begin + np.outer(across, plane.level) + np.outer(height, plane.up)
    forces = level * plane.level + np.outer(start + weight * s, plane.up)
    return ThreadShape(s=s, positions=positions, forces=forces)
