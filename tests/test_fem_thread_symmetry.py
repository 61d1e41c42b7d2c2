"""A thread at rest turned, seen from its other end, upside down, in space instead of in a plane."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpi4py import MPI
from numpy.typing import NDArray
from thread_field_cases import free_with, held_at, model_of, start_by, start_of

from hydroelastic.fem.thread.equilibrium import Start, solve_on_mesh
from hydroelastic.fem.thread.profile import ThreadProfile, thread_profile
from hydroelastic.modal.thread.march import march_back
from hydroelastic.physics.stream import Stream, TabulatedStream
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd
from hydroelastic.physics.thread_load import ThreadLoad

COMM = MPI.COMM_WORLD
LENGTH = 150.0
PARTS = np.linspace(0.0, 1.0, 31)
NODES = LENGTH * PARTS
S = np.linspace(0.0, LENGTH, 61)
HEAVE = PointLoad(force=np.array([0.0, 0.0, -150.0]), drag=30.0)
PULL, BODY_DRAG = np.array([20.0, -50.0, 1400.0]), 60.0
STREAM = TabulatedStream((-10.0, 60.0, 160.0), ((0.2, 0.1, 0.0), (0.6, 0.3, 0.0), (0.9, -0.2, 0.0)), "cubic")


class MovedStream:
    """u'(r) = R u(Rᵀ r)."""

    def __init__(self, stream: Stream, matrix: NDArray[np.float64]) -> None:
        self.stream, self.matrix = stream, matrix

    def velocity_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.stream.velocity_at(points @ self.matrix) @ self.matrix.T

    def gradient_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.matrix @ self.stream.gradient_at(points @ self.matrix) @ self.matrix.T


def thread(**changes: object) -> Thread:
    """An anchored buoy in a sheared stream that turns, with a weight on its line."""
    options: dict[str, object] = {
        "dimension": 3,
        "length": LENGTH,
        "ends": (held_at([1.0, 2.0, 3.0]), free_with(PULL, BODY_DRAG)),
        "weight": 3.0,
        "axial_rigidity": 4e4,
        "normal_drag": 12.0,
        "tangential_drag": 0.6,
        "stream": STREAM,
        "loads": {50.0: HEAVE},
    }
    return Thread(**(options | changes))  # type: ignore[arg-type]


def solved(model: Thread, start: Start, degree: int = 3) -> ThreadProfile:
    return thread_profile(solve_on_mesh(COMM, model, model.length * PARTS, start, degree=degree))


@pytest.fixture(scope="module")
def start() -> Start:
    load = ThreadLoad(weight=3.0, normal_drag=12.0, tangential_drag=0.6, stream=STREAM)
    return start_by(march_back(load, LENGTH, PULL, start=[1.0, 2.0, 3.0], tolerance=1e-6).at, 3)


@pytest.fixture(scope="module")
def original(start: Start) -> ThreadProfile:
    return solved(thread(), start)


def turned(model: Thread, matrix: NDArray[np.float64]) -> Thread:
    def load(of: PointLoad) -> PointLoad:
        return replace(of, force=matrix @ of.force)

    def end(of: ThreadEnd) -> ThreadEnd:
        return replace(of, load=load(of.load), position=matrix @ of.position)

    assert model.stream is not None
    return replace(
        model,
        ends=(end(model.ends[0]), end(model.ends[1])),
        loads={s: load(of) for s, of in model.loads.items()},
        stream=MovedStream(model.stream, matrix),
    )


def same(found: ThreadProfile, expected: ThreadProfile, matrix: NDArray[np.float64]) -> None:
    # Two solutions by Newton's method: the last step is below 1e-10 of the length, and quadratic.
    np.testing.assert_allclose(found.position(S), expected.position(S) @ matrix.T, atol=1e-9 * LENGTH)
    size = float(np.max(expected.tension))
    np.testing.assert_allclose(found.force, expected.force @ matrix.T, atol=1e-9 * size)
    np.testing.assert_allclose(found.reactions(), expected.reactions() @ matrix.T, atol=1e-9 * size)


@pytest.mark.mpi
def test_march_with_loads(original: ThreadProfile) -> None:
    def dragged(load: PointLoad) -> object:
        def force(place: NDArray[np.float64]) -> NDArray[np.float64]:
            velocity = STREAM.velocity_at(place[None])[0]
            return np.asarray(load.force + load.drag * np.linalg.norm(velocity) * velocity)

        return force

    load = ThreadLoad(weight=3.0, normal_drag=12.0, tangential_drag=0.6, stream=STREAM)
    marched = march_back(
        load,
        LENGTH,
        dragged(PointLoad(force=PULL, drag=BODY_DRAG)),  # type: ignore[arg-type]
        axial_rigidity=4e4,
        start=[1.0, 2.0, 3.0],
        point_forces=[(50.0, dragged(HEAVE))],  # type: ignore[list-item]
        tolerance=1e-11,
    )
    expected = marched.at(NODES)
    # The profile has a kink in its second derivative at z = 60: measured 3e-9 and 3e-8.
    np.testing.assert_allclose(original.position(NODES), expected.positions, atol=1e-7 * LENGTH)
    np.testing.assert_allclose(original.tension_at(NODES), expected.tensions, rtol=1e-6)
    # N jumps by the force of the load, and both sides of it are known.
    jump = original.force[9, 1] - original.force[10, 0]
    np.testing.assert_allclose(jump, dragged(HEAVE)(original.position(np.array([50.0]))[0]), rtol=1e-7)  # type: ignore[operator]


def test_rotation_about_the_vertical(original: ThreadProfile, start: Start) -> None:
    cosine, sine = np.cos(0.7), np.sin(0.7)
    matrix = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    moved = Start(position=lambda s: start.position(s) @ matrix.T, force=start.force)
    same(solved(turned(thread(), matrix), moved), original, matrix)


def test_upside_down(original: ThreadProfile, start: Start) -> None:
    matrix = np.diag([1.0, 1.0, -1.0])
    moved = Start(position=lambda s: start.position(s) @ matrix, force=start.force)
    same(solved(turned(thread(weight=-3.0), matrix), moved), original, matrix)


def test_from_the_other_end(original: ThreadProfile, start: Start) -> None:
    first, second = thread().ends
    model = thread(ends=(second, first), loads={100.0: HEAVE})
    moved = Start(position=lambda s: start.position(LENGTH - s), force=lambda s: start.force(LENGTH - s))
    found = solved(model, moved)
    np.testing.assert_allclose(found.position(LENGTH - S), original.position(S), atol=1e-9 * LENGTH)
    size = float(np.max(original.tension))
    np.testing.assert_allclose(found.tension[::-1, ::-1], original.tension, atol=1e-9 * size)
    np.testing.assert_allclose(found.force[::-1, ::-1], -original.force, atol=1e-9 * size)
    np.testing.assert_allclose(found.reactions()[::-1], original.reactions(), atol=1e-9 * size)


def test_plane_is_space_without_a_direction() -> None:
    plane, space = (solved(model_of("S12", dimension), start_of("S12", dimension)) for dimension in (2, 3))
    np.testing.assert_allclose(space.position(plane.nodes)[:, [0, 2]], plane.position(plane.nodes), atol=1e-7)
    np.testing.assert_allclose(space.position(plane.nodes)[:, 1], 0.0, atol=1e-10)
    np.testing.assert_allclose(space.tension, plane.tension, rtol=1e-8)


def test_stiff_thread_is_one_that_does_not_stretch() -> None:
    stiff, rigid = (solved(model_of("S12", axial_rigidity=ea), start_of("S12")) for ea in (1e12, np.inf))
    # Strain of some 400 N: 4e-10 of the length, as above.
    np.testing.assert_allclose(stiff.position(stiff.nodes), rigid.position(rigid.nodes), atol=1.5e-7)
    np.testing.assert_allclose(stiff.tension, rigid.tension, rtol=2e-8)


def test_load_of_nothing(original: ThreadProfile, start: Start) -> None:
    nothing = PointLoad(force=np.zeros(3))
    same(solved(thread(loads={50.0: HEAVE, 100.0: nothing}), start), original, np.eye(3))
