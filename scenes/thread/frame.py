"""The coordinates in which a thread is solved: a vertical plane where one holds all of it, else space."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import ThreadMotion
from hydroelastic.scenes.models.thread_parts import FixedEnd

Array = NDArray[np.float64]
_Number = TypeVar("_Number", np.float64, np.complex128)

# Horizontal vectors whose angle is below this are parallel: rounding of what was written in the scene.
_PARALLEL = 1e-12


@dataclass(frozen=True)
class Frame:
    """Coordinates of a model: (x', z) in a vertical plane, or (x', y', z), x' along a horizontal direction.

    Attributes:
        direction: (x, y) of x', of length 1.
        dimension: 2 or 3.
        offset: y' of the plane, m; 0 in space.
    """

    direction: tuple[float, float]
    dimension: int
    offset: float = 0.0

    @property
    def axes(self) -> Array:
        """Unit vectors of the model's coordinates as rows, shape (dimension, 3)."""
        c, s = self.direction
        rows = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]
        return np.array([rows[0], rows[2]] if self.dimension == 2 else rows)

    def inside(self, vectors: Array) -> Array:
        """Components in the model's coordinates, shape (..., dimension)."""
        return np.asarray(np.asarray(vectors, dtype=float) @ self.axes.T)

    def places(self, points: Array) -> Array:
        """Positions (x, y, z), m, shape (..., 3), of points in the model's coordinates."""
        c, s = self.direction
        return self.outside(points) + self.offset * np.array([-s, c, 0.0])

    def outside(self, vectors: NDArray[_Number]) -> NDArray[_Number]:
        """Components (x, y, z), shape (..., 3)."""
        return np.asarray(vectors @ self.axes, dtype=vectors.dtype)


def frame_of(scene: ThreadScene) -> Frame:
    """Choose the coordinates of a scene: a vertical plane if what is given and what is asked lie in one."""
    directions = [vector for vector in _horizontal(scene) if hypot(*vector) > 0.0]
    longest = max(directions, key=lambda vector: hypot(*vector), default=(1.0, 0.0))
    size = hypot(*longest)
    along = (longest[0] / size, longest[1] / size)
    planar = all(abs(along[0] * y - along[1] * x) <= _PARALLEL * hypot(x, y) for x, y in directions)
    if not planar:
        return Frame((1.0, 0.0), 3)
    # The same plane whichever way it is looked at: x' goes the way of x, or of y.
    if along < (0.0, 0.0):
        along = (-along[0], -along[1])
    if _leave_the_plane(scene):
        return Frame(along, 3)
    held = next(end for end in (scene.ends.a, scene.ends.b) if isinstance(end, FixedEnd))
    return Frame(along, 2, along[0] * held.position[1] - along[1] * held.position[0])


def _leave_the_plane(scene: ThreadScene) -> bool:
    """Modes go every way, and so does what vortices do."""
    motions = [analysis for analysis in scene.analysis if isinstance(analysis, ThreadMotion)]
    return len(motions) < len(scene.analysis) or any(motion.vortices is not None for motion in motions)


def _moved(scene: ThreadScene, motion: ThreadMotion) -> Iterator[tuple[float, float]]:
    """Horizontal directions of what moves the ends, and of a straight start."""
    if motion.start == "straight":
        yield motion.direction[0], motion.direction[1]
    for move in motion.move:
        yield from ((vector[0], vector[1]) for vector in (move.velocity, move.amplitude))
        yield from ((row[1], row[2]) for row in scene.table_of(move))


def _horizontal(scene: ThreadScene) -> Iterator[tuple[float, float]]:
    """All horizontal directions of a scene."""
    fixed = [end for end in (scene.ends.a, scene.ends.b) if end.kind == "fixed"]
    if len(fixed) == 2:
        first, last = (end.position for end in fixed)
        yield last[0] - first[0], last[1] - first[1]
    for end in (scene.ends.a, scene.ends.b):
        if end.kind == "fixed":
            if end.clamp is not None:
                yield end.clamp[0], end.clamp[1]
        else:
            yield end.force[0], end.force[1]
    for analysis in scene.analysis:
        if isinstance(analysis, ThreadMotion):
            yield from _moved(scene, analysis)
    stream = scene.stream
    if stream is None:
        return
    if stream.velocity is not None:
        yield stream.velocity
    if stream.shear is not None:
        yield stream.shear
    if stream.veer is not None:
        # It turns: no plane holds it.
        yield from ((1.0, 0.0), (0.0, 1.0))
    for _, x, y in scene.profile or ():
        yield x, y
