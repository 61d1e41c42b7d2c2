"""The coordinate frame in which a thread is solved: a vertical plane that contains all of it, else space."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.motion_request import MotionRequest
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import ShearedStream, Stream, TabulatedStream, UniformStream
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd

Array = NDArray[np.float64]
_Number = TypeVar("_Number", np.float64, np.complex128)

# Horizontal vectors whose angle is below this are parallel: rounding of the input.
_PARALLEL = 1e-12


@dataclass(frozen=True)
class Frame:
    """Coordinates of a solution: (x', z) in a vertical plane, or (x', y', z), x' along a horizontal direction."""

    direction: tuple[float, float]  # (x, y) of x', of length 1
    dimension: int
    offset: float = 0.0  # y' of the plane, m; 0 in space

    @property
    def axes(self) -> Array:
        """Unit vectors of the coordinates as rows, shape (dimension, 3)."""
        c, s = self.direction
        rows = [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]
        return np.array([rows[0], rows[2]] if self.dimension == 2 else rows)

    def to_frame(self, vectors: FloatArray) -> Array:
        """Return components in these coordinates, shape (..., dimension), of vectors (x, y, z)."""
        return np.asarray(np.asarray(vectors, dtype=float) @ self.axes.T)

    def to_space(self, vectors: NDArray[_Number]) -> NDArray[_Number]:
        """Return components (x, y, z), shape (..., 3), of vectors in these coordinates."""
        return np.asarray(vectors @ self.axes, dtype=vectors.dtype)

    def positions_in_space(self, points: Array) -> Array:
        """Return positions (x, y, z), m, shape (..., 3), of points in these coordinates."""
        c, s = self.direction
        return self.to_space(points) + self.offset * np.array([-s, c, 0.0])

    def thread_in_frame(self, thread: Thread) -> Thread:
        """Return a thread in space in these coordinates."""

        def load(body: PointLoad) -> PointLoad:
            return replace(body, force=self.to_frame(body.force))

        def end(given: ThreadEnd) -> ThreadEnd:
            clamp = None if given.clamp is None else self.to_frame(given.clamp)
            return replace(
                given,
                load=load(given.load),
                held=given.held[3 - self.dimension :],
                position=self.to_frame(given.position),
                clamp=None if clamp is None else np.asarray(clamp / np.linalg.norm(clamp)),
            )

        return replace(
            thread,
            dimension=self.dimension,
            ends=(end(thread.ends[0]), end(thread.ends[1])),
            stream=None if thread.stream is None else _RotatedStream(thread.stream, Frame(self.direction, 3)),
            loads={s: load(body) for s, body in thread.loads.items()},
        )


@dataclass(frozen=True)
class _RotatedStream:
    stream: Stream
    frame: Frame

    @property
    def breaks(self) -> tuple[float, ...]:
        return self.stream.breaks

    @cached_property
    def _axes(self) -> Array:
        return self.frame.axes

    def velocity_at(self, points: FloatArray) -> FloatArray:
        return np.asarray(self.stream.velocity_at(points @ self._axes) @ self._axes.T)

    def gradient_at(self, points: FloatArray) -> FloatArray:
        return np.asarray(self._axes @ self.stream.gradient_at(points @ self._axes) @ self._axes.T)

    def times(self, factor: float) -> _RotatedStream:
        return replace(self, stream=self.stream.times(factor))


def choose_frame(thread: Thread, motions: Sequence[MotionRequest] = (), *, in_space: bool = False) -> Frame:
    """Choose a vertical plane if it contains all loads and motions of a thread, else space."""
    directions = [vector for vector in _horizontal(thread, motions) if hypot(*vector) > 0.0]
    longest = max(directions, key=lambda vector: hypot(*vector), default=(1.0, 0.0))
    size = hypot(*longest)
    along = (float(longest[0] / size), float(longest[1] / size))
    planar = all(abs(along[0] * y - along[1] * x) <= _PARALLEL * hypot(x, y) for x, y in directions)
    if not planar:
        return Frame((1.0, 0.0), 3)
    # One frame for either sense of the direction: x' points along x, or along y.
    if along < (0.0, 0.0):
        along = (-along[0], -along[1])
    if in_space or any(motion.shedding is not None for motion in motions):
        return Frame(along, 3)
    held = next(end.position for end in thread.ends if end.is_fixed)
    return Frame(along, 2, float(along[0] * held[1] - along[1] * held[0]))


def _horizontal(thread: Thread, motions: Sequence[MotionRequest]) -> Iterator[tuple[float, float]]:
    """Horizontal directions of the chord, of clamps, forces, motions and the stream."""
    first, last = thread.ends
    if first.is_fixed and last.is_fixed:
        x, y, _ = last.position - first.position
        yield x, y
    for end in thread.ends:
        if end.clamp is not None:
            yield end.clamp[0], end.clamp[1]
        yield end.load.force[0], end.load.force[1]
    for body in thread.loads.values():
        yield body.force[0], body.force[1]
    for motion in motions:
        if motion.start == "straight":
            yield motion.direction[0], motion.direction[1]
        for displacement in (*motion.displacements[0], *motion.displacements[1]):
            yield from displacement.directions()
    yield from _stream_directions(thread.stream)


def _stream_directions(stream: Stream | None) -> Iterator[tuple[float, float]]:
    vectors: tuple[tuple[float, float, float], ...]
    match stream:
        case None:
            vectors = ()
        case UniformStream():
            vectors = (stream.velocity,)
        case ShearedStream():
            vectors = stream.velocity, stream.gradient
        case TabulatedStream():
            vectors = stream.velocities
        case _:
            # No plane contains a stream whose direction varies with the height.
            vectors = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    yield from ((x, y) for x, y, _ in vectors)
