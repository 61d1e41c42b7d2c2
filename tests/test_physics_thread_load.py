"""Streams, the load on a thread and its derivatives."""

from __future__ import annotations

import numpy as np
import pytest

from hydroelastic.physics.stream import (
    ShearedStream,
    Stream,
    TabulatedStream,
    UniformStream,
    VeeringStream,
)
from hydroelastic.physics.thread_load import ThreadLoad

LEVELS = (-2.0, 0.0, 1.0, 4.0)
ROWS = ((0.2, 0.0, 0.0), (0.5, 0.3, 0.0), (1.5, -0.2, 0.1), (1.0, 0.4, 0.0))
STREAMS: list[Stream] = [
    UniformStream((1.0, -0.5, 0.2)),
    ShearedStream((0.4, 0.1, 0.0), (0.2, -0.1, 0.05), level=1.0),
    VeeringStream(0.8, 0.3),
    TabulatedStream(LEVELS, ROWS),
    TabulatedStream(LEVELS, ROWS, "cubic"),
]
RANDOM = np.random.default_rng(5)
# None nearer to a row of the table than the difference steps.
POINTS = RANDOM.uniform(-4, 6, (60, 3))
TANGENTS = RANDOM.normal(size=(60, 3))
TANGENTS /= np.linalg.norm(TANGENTS, axis=1, keepdims=True)
STEP = 1e-5


@pytest.mark.parametrize("stream", STREAMS, ids=lambda stream: type(stream).__name__)
def test_gradient_is_that_of_the_velocity(stream: Stream) -> None:
    for axis, step in enumerate(STEP * np.eye(3)):
        expected = (stream.velocity_at(POINTS + step) - stream.velocity_at(POINTS - step)) / (2 * STEP)
        # Rounding of the difference, eps/STEP, and its own error, STEP² u'''.
        assert stream.gradient_at(POINTS)[:, :, axis] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("stream", STREAMS, ids=lambda stream: type(stream).__name__)
def test_a_stream_times_a_factor_has_its_velocities_and_gradients_multiplied(stream: Stream) -> None:
    faster = stream.times(2.5)
    # Rounding of interpolation, all kinds of which are linear, or homogeneous, in the rows.
    assert faster.velocity_at(POINTS) == pytest.approx(2.5 * stream.velocity_at(POINTS), abs=1e-14)
    assert faster.gradient_at(POINTS) == pytest.approx(2.5 * stream.gradient_at(POINTS), abs=1e-14)


def test_table_holds_its_rows_and_is_constant_beyond() -> None:
    for stream in STREAMS[3:]:
        assert stream.profile(LEVELS) == pytest.approx(np.array(ROWS), abs=1e-15)
        assert stream.profile([-9.0, 9.0]) == pytest.approx(np.array([ROWS[0], ROWS[-1]]), abs=1e-15)
        assert stream.breaks == LEVELS
        assert (stream.slope([-9.0, 9.0]) == 0).all()
    assert STREAMS[3].profile([0.25])[0] == pytest.approx([0.75, 0.175, 0.025])
    assert STREAMS[0].breaks == ()


@pytest.mark.parametrize("stream", STREAMS, ids=lambda stream: type(stream).__name__)
def test_derivatives_of_the_load(stream: Stream) -> None:
    load = ThreadLoad(weight=0.7, normal_drag=1.3, tangential_drag=0.2, viscous_drag=0.4, stream=stream)
    for axis, step in enumerate(STEP * np.eye(3)):
        by_position = (load.load(POINTS + step, TANGENTS) - load.load(POINTS - step, TANGENTS)) / (2 * STEP)
        by_tangent = (load.load(POINTS, TANGENTS + step) - load.load(POINTS, TANGENTS - step)) / (2 * STEP)
        # As above; near uₙ = 0 and uₜ = 0 the third derivatives are larger.
        assert load.load_by_position(POINTS, TANGENTS)[:, :, axis] == pytest.approx(by_position, abs=1e-8)
        assert load.load_by_tangent(POINTS, TANGENTS)[:, :, axis] == pytest.approx(by_tangent, abs=1e-8)


def test_load_of_known_directions() -> None:
    load = ThreadLoad(
        weight=3.0, normal_drag=2.0, tangential_drag=0.5, viscous_drag=0.1, stream=UniformStream((2.0, 0.0, 0.0))
    )
    tangents = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    expected = [[2.0 * 4 + 0.1 * 2, 0, -3.0], [0.5 * 4, 0, -3.0], [0.5 * 4, 0, -3.0]]
    assert load.load(np.zeros((3, 3)), tangents) == pytest.approx(np.array(expected))
    still = ThreadLoad(weight=3.0, normal_drag=2.0)
    assert still.load(np.zeros((1, 3)), tangents[:1])[0] == pytest.approx([0, 0, -3.0])
    assert not still.load_by_position(np.zeros((1, 3)), tangents[:1]).any()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ThreadLoad(weight=float("nan")), "weight is nan"),
        (lambda: ThreadLoad(weight=1.0, normal_drag=-1.0), "normal_drag is -1.0"),
        (lambda: UniformStream((1.0, 2.0)), "velocity is"),  # type: ignore[arg-type]
        (lambda: VeeringStream(float("inf"), 1.0), "speed is inf"),
        (lambda: TabulatedStream((0.0, 0.0), ROWS[:2]), "levels is"),
        (lambda: TabulatedStream((0.0, 1.0), ROWS), "velocities has 4 rows"),
        (lambda: TabulatedStream(LEVELS, ROWS, "square"), "interpolation is 'square'"),  # type: ignore[arg-type]
    ],
)
def test_refuses(make: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()  # type: ignore[operator]
