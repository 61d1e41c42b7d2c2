"""Nodes on curves: where rings meet them, and how curved ones are cut into elements."""

from __future__ import annotations

from math import ceil, inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.outline import Curve, GradedPoint, Outline
from hydroelastic.meshes.rings import RingEnds
from hydroelastic.meshes.sign_changes import sign_changes
from hydroelastic.meshes.size_field import Discs, SizeField

# Largest radius of rings relative to the distance of the next curve or corner.
_ROOM = 0.45
# Triangles of the rings have angles of 17 degrees at a curve: within the rings it turns by this part of an element's.
_TURN_OF_RINGS = 0.5
# Samples of a curved piece turn by at most this part of what an element may, and are this part of its size at most.
_FINE = 0.125
_FIRST_SAMPLES = 65
_FIRST_PARTS = 16
# Number of points on which the first intersection of a ring with a curve is bracketed before bisection.
_GRID = 1025
# Directions of shorter samples, as parts of the extent, are rounding.
_SHORTEST = 1e-6
# Largest growth of elements per distance along a straight line: that of gmsh, √1.8 − 1.
_GROWTH_ALONG = 1.8**0.5 - 1.0
# A part of an element less than this one is no element more, as in gmsh.
_ROUNDED_DOWN = 0.01
# Elements of the same length grow by this part along a line: among triangles that are equal gmsh chooses by rounding,
# and leaves rows twice as coarse where it does not take one after the other. Measured on 40 tanks with a moved beam.
_UNEQUAL = 1e-12


def outermost_ring(outline: Outline, graded: GradedPoint, largest_turn: float) -> float:
    """Radius of the outermost ring that fits at a corner.

    It is `Corner.outer`, or less: the size of the curves that meet there, almost half the distance to the nearest curve
    or corner, and so small that the curves there turn within the ring by less than half of ``largest_turn`` (radians).
    """
    place = np.array(graded.point)
    rooms, limits = [], [graded.outer]
    for number in outline.curves_at(graded.point):
        curve = outline.curves[number]
        other = curve.end if graded.point == curve.start else curve.start
        rooms.append(float(np.hypot(*(np.array(other) - place))))
        limits.append(curve.size)
        if curve.path is not None:
            limits.append(_bent_radius(curve, graded, _TURN_OF_RINGS * largest_turn))
    chords = outline.chords
    away = distances(place[None, :], chords.starts, chords.ends)[0]
    rooms.append(float(away[~np.isin(chords.curves, outline.curves_at(graded.point))].min(initial=inf)))
    return min(_ROOM * min(rooms), *limits)


def distances(
    points: NDArray[np.float64], starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the distance of each point (points, 2) from each segment (segments, 2), shape (points, segments)."""
    edges = ends - starts
    away = points[:, None, :] - starts
    part = np.clip((away * edges).sum(axis=2) / (edges**2).sum(axis=1), 0.0, 1.0)
    away = away - part[:, :, None] * edges
    result: NDArray[np.float64] = np.hypot(away[:, :, 0], away[:, :, 1])
    return result


def _bent_radius(curve: Curve, graded: GradedPoint, largest_turn: float) -> float:
    """Distance from the corner up to which a curve turns by less than ``largest_turn`` and moves away from the
    corner."""
    parameters = curve_samples(curve, 0.0, 1.0, largest_turn)
    if graded.point == curve.end:
        parameters = parameters[::-1]
    points = curve.at(parameters)
    turned = np.append(0.0, np.cumsum(_turns(points)))
    away = np.hypot(*(points[:-1] - graded.point).T)
    beyond = away[turned > largest_turn]
    return float(beyond.min()) if len(beyond) else inf


def _turns(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Change of direction at each inner point of a polyline, radians."""
    edges = np.diff(points, axis=0)
    before, after = edges[:-1], edges[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turns: NDArray[np.float64] = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
    return turns


def curve_samples(curve: Curve, first: float, last: float, largest_turn: float) -> NDArray[np.float64]:
    """Return parameters from ``first`` to ``last``, 0 … 1, between which a curve turns by at most ``largest_turn``,
    rad."""
    parameters = np.linspace(first, last, _FIRST_SAMPLES, dtype=np.float64)
    shortest = _SHORTEST * float(np.ptp(curve.polyline(), axis=0).max())
    while True:
        points = curve.at(parameters)
        turns = np.concatenate([[0.0], _turns(points), [0.0]])
        turning = np.maximum(turns[:-1], turns[1:]) > _FINE * largest_turn
        lengths = np.hypot(*np.diff(points, axis=0).T)
        split = np.flatnonzero(turning & (lengths > shortest))
        if not len(split):
            return parameters
        parameters = np.insert(parameters, split + 1, 0.5 * (parameters[split] + parameters[split + 1]))


def ring_ends(curve: Curve, at_start: bool, radii: NDArray[np.float64]) -> RingEnds:
    """Nodes of a curve at given distances from a corner at its start, or its end."""
    place = np.array(curve.start if at_start else curve.end)
    if curve.path is None:
        away = np.array(curve.end if at_start else curve.start) - place
        length = float(np.hypot(*away))
        away /= length
        points = place + radii[:, None] * away
        fractions = np.asarray(radii / length, dtype=np.float64)
        angles = np.full(len(radii), np.arctan2(away[1], away[0]))
    else:
        fractions = _fractions_at(curve, at_start, radii)
        points = curve.at(fractions if at_start else 1.0 - fractions)
        angles = np.arctan2(*(points - place).T[::-1])
    return RingEnds(parameters=fractions if at_start else 1.0 - fractions, points=points, angles=angles)


def _fractions_at(curve: Curve, at_start: bool, radii: NDArray[np.float64]) -> NDArray[np.float64]:
    """Parameters, counted from the corner, where a curve first reaches the distances ``radii`` from it."""

    def distances_at(fractions: NDArray[np.float64]) -> NDArray[np.float64]:
        points = curve.at(fractions if at_start else 1.0 - fractions)
        away: NDArray[np.float64] = np.hypot(*(points - (curve.start if at_start else curve.end)).T)
        return away

    grid = np.linspace(0.0, 1.0, _GRID, dtype=np.float64)
    beyond = np.argmax(distances_at(grid) >= radii[:, None], axis=1)
    return sign_changes(lambda fractions: distances_at(fractions) - radii, grid[beyond - 1], grid[beyond])


def bend_sources(outline: Outline, number: int, span: tuple[float, float], largest_turn: float) -> Discs:
    """A curved piece as sources of the size field.

    Elements are as large as the curve allows, or smaller: they turn by at most ``largest_turn``, and their chord is off
    the curve by at most an eighth of the way to other curves.
    """
    curve = outline.curves[number]
    points = curve.at(curve_samples(curve, *span, largest_turn))
    lengths = np.hypot(*np.diff(points, axis=0).T)
    centres = 0.5 * (points[:-1] + points[1:])
    # Curvature at each sample, from the turn there and half the lengths on both sides.
    curvature = np.concatenate([[0.0], 2.0 * _turns(points) / (lengths[:-1] + lengths[1:]), [0.0]])
    with np.errstate(divide="ignore"):
        radius = 1.0 / np.maximum(curvature[:-1], curvature[1:])
    sizes = np.minimum(largest_turn * radius, curve.size)
    # A chord of length h is off by h²/8R: only nearer curves require a smaller one.
    counts = float((sizes**2 / radius).max())
    sizes = np.minimum(sizes, np.sqrt(radius * _gaps(outline, number, centres, counts)))
    finite = np.isfinite(sizes)
    return Discs(centres=centres[finite], radii=0.5 * lengths[finite], sizes=sizes[finite])


def _gaps(outline: Outline, number: int, points: NDArray[np.float64], most: float) -> NDArray[np.float64]:
    """Distance of points on a curve from the curves that do not meet it and are nearer than ``most``, or infinity."""
    curve, chords = outline.curves[number], outline.chords
    low, high = points.min(axis=0) - most, points.max(axis=0) + most
    near = (np.minimum(chords.starts, chords.ends) <= high) & (np.maximum(chords.starts, chords.ends) >= low)
    meeting = [*outline.curves_at(curve.start), *outline.curves_at(curve.end)]
    others = near.all(axis=1) & ~np.isin(chords.curves, meeting)
    if not others.any():
        return np.full(len(points), inf)
    gaps: NDArray[np.float64] = distances(points, chords.starts[others], chords.ends[others]).min(axis=1)
    return gaps


def element_parameters(
    curve: Curve, span: tuple[float, float], size: SizeField, largest_turn: float
) -> NDArray[np.float64]:
    """Parameters of the ends of a curved piece's elements, both ends of the piece included.

    Elements take equal parts of ∫ds/h, rounded up to a whole number.
    """
    parameters = curve_samples(curve, *span, largest_turn)
    while True:
        points = curve.at(parameters)
        lengths = np.hypot(*np.diff(points, axis=0).T)
        middles = 0.5 * (parameters[:-1] + parameters[1:])
        parts = lengths / size.along(curve.at(middles))
        split = np.flatnonzero(parts > _FINE)
        if not len(split):
            break
        parameters = np.insert(parameters, split + 1, middles[split])
    reached = np.concatenate([[0.0], np.cumsum(parts)])
    count = max(1, ceil(reached[-1] - 1e-9))
    nodes: NDArray[np.float64] = np.interp(np.linspace(0.0, reached[-1], count + 1), reached, parameters)
    nodes[0], nodes[-1] = span
    return nodes


def straight_elements(
    starts: NDArray[np.float64], ends: NDArray[np.float64], size: SizeField
) -> list[NDArray[np.float64]]:
    """Parts of straight lines, from 0 to 1, at the ends of their elements.

    Elements take equal parts of ∫ds/h, where h grows along a line by at most `_GROWTH_ALONG`. It is sampled so finely
    that no small size is overlooked: a sample is off by at most the growth of the size field times the distance.
    """
    lengths = np.hypot(*(ends - starts).T)
    line = np.repeat(np.arange(len(starts)), _FIRST_PARTS + 1)
    part = np.tile(np.linspace(0.0, 1.0, _FIRST_PARTS + 1), len(starts))

    def sizes_at(line: NDArray[np.int64], part: NDArray[np.float64]) -> NDArray[np.float64]:
        return size.along(starts[line] + part[:, None] * (ends - starts)[line])

    wanted = sizes_at(line, part)
    while True:
        steps = np.diff(part) * lengths[line[:-1]]
        split = np.flatnonzero(steps > _FINE * np.minimum(wanted[:-1], wanted[1:]))
        if not len(split):
            break
        own, middles = line[split], 0.5 * (part[split] + part[split + 1])
        line, part = np.insert(line, split + 1, own), np.insert(part, split + 1, middles)
        wanted = np.insert(wanted, split + 1, sizes_at(own, middles))
    found = []
    for own in np.split(np.arange(len(part)), np.flatnonzero(np.diff(line)) + 1):
        place = part[own] * lengths[line[own[0]]]
        rising = np.minimum.accumulate(wanted[own] - _GROWTH_ALONG * place) + _GROWTH_ALONG * place
        falling = np.minimum.accumulate((rising + _GROWTH_ALONG * place)[::-1])[::-1] - _GROWTH_ALONG * place
        density = 1.0 / falling
        reached = np.append(0.0, np.cumsum(0.5 * (density[:-1] + density[1:]) * np.diff(place)))
        count = max(1, ceil(reached[-1] - _ROUNDED_DOWN))
        equal = np.linspace(0.0, 1.0, count + 1)
        found.append(np.interp(reached[-1] * (equal - _UNEQUAL * equal * (1.0 - equal)), reached, part[own]))
    return found


def element_sources(points: NDArray[np.float64]) -> Discs:
    """Elements of a curved piece as sources of their own size."""
    lengths = np.hypot(*np.diff(points, axis=0).T)
    return Discs(centres=0.5 * (points[:-1] + points[1:]), radii=0.5 * lengths, sizes=lengths)
