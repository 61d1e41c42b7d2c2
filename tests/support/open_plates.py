"""Thin elastic and rigid plates that lie on a level of open water: one integral equation along the plate.

EI w'''' − mω²w = p on the plate and w + p/c + ∫ Q(x − ξ) p(ξ) dξ = w_incident (`open_levels`), e^{-iωt}. The unknown
EI w'''' is a polynomial in each of many panels that shrink towards the ends and joints, where it has logarithms; w is
its fourfold integral and a cubic on each segment. No mode of depth and no matching is used.

Nothing of the package is imported.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from open_levels import Level
from open_panels import Panels, graded_edges, layer_matrix
from scipy.linalg import block_diag


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A uniform part of a plate.

    Attributes:
        length: m.
        rigidity: EI per metre of width, N m.
        mass: per area, kg/m².
    """

    length: float
    rigidity: float
    mass: float


@dataclass(frozen=True, kw_only=True)
class Scattering:
    """A plate in waves of unit elevation e^{ikx}, x from its left end.

    Attributes:
        reflected, transmitted: complex elevations of the waves e^{∓ikx} at the level, per wave number of the level.
        deflection: w at the points asked for.
    """

    reflected: np.ndarray
    transmitted: np.ndarray
    deflection: np.ndarray


@dataclass(frozen=True)
class Plate:
    """Segments from left to right, joined by rotational springs.

    Attributes:
        segments: from left to right.
        joints: stiffness k of each joint, N m/rad per metre of width: 0 a hinge, infinite none.
    """

    segments: tuple[Segment, ...]
    joints: tuple[float, ...] = ()

    @property
    def length(self) -> float:
        """m."""
        return sum(segment.length for segment in self.segments)


def plate_of(row: dict[str, Any], *, turned: bool = False) -> Plate:
    """The plate of a stored case, or its mirror image."""
    segments = tuple(Segment(**segment) for segment in row["segments"])
    joints = tuple(math.inf if spring is None else spring for spring in row["joints"])
    return Plate(segments[::-1], joints[::-1]) if turned else Plate(segments, joints)


class _Shapes:
    """w of one segment from f = EI w''''/c at its nodes and the four numbers of a cubic.

    Attributes:
        panels: of the segment, from 0.
        load, cubic: the 0th to the 3rd derivative at the nodes and, the last row, at the right end.
        start: of the cubic, at the left end, where the integrals of f vanish.
    """

    def __init__(self, segment: Segment, panels: Panels, stiffness: float) -> None:
        self.panels = panels
        integral = panels.integral
        load = [stiffness / segment.rigidity * integral]
        for _ in range(3):
            load.insert(0, integral @ load[0][:-1])
        self.load = load
        x = np.append(panels.nodes, segment.length) / segment.length
        cubics = [np.polynomial.Polynomial.basis(degree) for degree in range(4)]
        scale = segment.length ** -np.arange(4.0)
        self.cubic = [np.stack([c.deriv(d)(x) for c in cubics], axis=1) * scale[d] for d in range(4)]
        self.start = [np.array([c.deriv(d)(0.0) for c in cubics]) * scale[d] for d in range(4)]


class _Unknowns:
    """Which columns belong to which segment: f at all nodes first, then the cubics."""

    def __init__(self, shapes: list[_Shapes]) -> None:
        self.ends = np.concatenate([[0], np.cumsum([len(s.panels.nodes) for s in shapes])])
        self.size = int(self.ends[-1]) + 4 * len(shapes)

    def row(self, segment: int, load: np.ndarray | None, cubic: np.ndarray) -> np.ndarray:
        """A row of the matrix."""
        row = np.zeros(self.size)
        if load is not None:
            row[self.ends[segment] : self.ends[segment + 1]] = load
        first = int(self.ends[-1]) + 4 * segment
        row[first : first + 4] = cubic
        return row


def scattering(plate: Plate, level: Level, points: np.ndarray, wave: int = 0, order: int = 14) -> Scattering:
    """Reflection, transmission and deflection of a plate in waves.

    Args:
        plate: the plate.
        level: what it lies on.
        points: x from the left end, m.
        wave: which wave of the level comes, by wave number.
        order: nodes in each panel.
    """
    shapes = [_Shapes(s, Panels(_edges(s, level), order), level.stiffness) for s in plate.segments]
    starts = np.concatenate([[0], np.cumsum([s.length for s in plate.segments])])
    inner = [s.panels.edges[:-1] + start for s, start in zip(shapes, starts, strict=False)]
    panels = Panels(np.concatenate([*inner, starts[-1:]]), order)
    blocks = [block_diag(*[s.load[0][:-1] for s in shapes]), block_diag(*[s.cubic[0][:-1] for s in shapes])]
    to_deflection = np.hstack(blocks)
    masses = [np.full(len(g.panels.nodes), s.mass) for s, g in zip(plate.segments, shapes, strict=True)]
    inertia = np.concatenate(masses) * level.omega**2 / level.stiffness
    to_pressure = np.eye(*to_deflection.shape) - inertia[:, None] * to_deflection
    layer = layer_matrix(panels, level.kernel(plate.length))
    conditions = _conditions(plate, shapes)
    k, nodes = level.wave_numbers, panels.nodes
    matrix = np.vstack([to_deflection + to_pressure + layer @ to_pressure, conditions])
    right = np.concatenate([np.exp(1j * k[wave] * nodes), np.zeros(len(conditions))])
    scale = np.linalg.norm(matrix, axis=1)
    unknowns = np.linalg.solve(matrix / scale[:, None], right / scale)
    reflected, transmitted = radiated(level, panels, to_pressure @ unknowns)
    transmitted[wave] += 1
    deflection = panels.at(to_deflection @ unknowns, points)
    return Scattering(reflected=reflected, transmitted=transmitted, deflection=deflection)


def radiated(level: Level, panels: Panels, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Elevations of the waves e^{−ikx} and e^{ikx} that p/c at the nodes sends to the left and to the right."""
    strength = -1j * level.stiffness * level.residues
    phase = np.exp(1j * np.outer(level.wave_numbers, panels.nodes))
    loads = panels.weights * pressure
    return strength * (phase @ loads), strength * (phase.conj() @ loads)


def _edges(segment: Segment, level: Level) -> np.ndarray:
    bending = (segment.rigidity / level.stiffness) ** 0.25
    return graded_edges(segment.length, min(2 * bending, 2 / level.wave_numbers[-1], level.depth), 1e-6)


def _conditions(plate: Plate, shapes: list[_Shapes]) -> np.ndarray:
    """Free ends and joints."""
    unknowns = _Unknowns(shapes)
    rigidities = [s.rigidity for s in plate.segments]

    def left(segment: int, derivative: int) -> np.ndarray:
        return unknowns.row(segment, None, shapes[segment].start[derivative])

    def right(segment: int, derivative: int) -> np.ndarray:
        shape = shapes[segment]
        return unknowns.row(segment, shape.load[derivative][-1], shape.cubic[derivative][-1])

    last = len(shapes) - 1
    rows = [left(0, 2), left(0, 3), right(last, 2), right(last, 3)]
    for joint, spring in enumerate(plate.joints):
        rows.append(right(joint, 0) - left(joint + 1, 0))
        moments = [rigidities[joint] * right(joint, 2), rigidities[joint + 1] * left(joint + 1, 2)]
        rows.append(moments[0] - moments[1])
        rows.append(rigidities[joint] * right(joint, 3) - rigidities[joint + 1] * left(joint + 1, 3))
        turned = left(joint + 1, 1) - right(joint, 1)
        rows.append(turned if math.isinf(spring) else moments[0] - spring * turned)
    return np.stack(rows)


def rigid_radiation(length: float, level: Level, order: int = 14) -> tuple[np.ndarray, np.ndarray]:
    """Heave and pitch (about the middle, anticlockwise) of a rigid plate.

    Args:
        length: m.
        level: what it lies on.
        order: nodes in each panel.

    Returns:
        a + ib/ω, shape (2, 2), kg/m, kg and kg m, and the elevations of the waves e^{∓ikx}, x from the left end, per
        unit motion, shape (2 directions, waves, 2 motions).
    """
    longest = min(length / 4, 2 / level.wave_numbers[-1], level.depth)
    panels = Panels(graded_edges(length, longest, 1e-6), order)
    motions = np.stack([np.ones(len(panels.nodes)), panels.nodes - length / 2], axis=1)
    layer = layer_matrix(panels, level.kernel(length))
    pressure = np.linalg.solve(np.eye(len(panels.nodes)) + layer, -motions)
    static = motions.T @ (panels.weights[:, None] * motions)
    impedance = level.stiffness / level.omega**2 * (motions.T @ (panels.weights[:, None] * pressure) + static)
    waves = [radiated(level, panels, column) for column in pressure.T]
    return impedance, np.moveaxis(np.array(waves), 0, 2)
