"""Streams by a table: what is continuous between rows, and nodes where the thread passes them."""

from typing import Any, get_args

import numpy as np
import pytest
from mpi4py import MPI
from thread_truth import true_error

from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium
from hydroelastic.fem.thread.knots import at_knots, knots_along
from hydroelastic.physics.stream import Interpolation, TabulatedStream
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_tables import LiquidStream
from hydroelastic.scenes.thread.solve import equilibrium_of

LEVELS = (0.0, 1.0, 2.5, 3.0)
ROWS = ((0.0, 0.0, 0.0), (1.0, 0.2, 0.0), (1.5, 0.0, 0.0), (0.2, 0.4, 0.0))
STEP = 1e-6


def jumps(interpolation: Any) -> tuple[float, float]:
    """Of the first and of the second derivative at the inner rows, the largest."""
    stream = TabulatedStream(LEVELS, ROWS, interpolation)
    rows = np.array(LEVELS[1:-1])
    far = 1e-3
    slopes = [stream.slope(rows + shift) for shift in (-STEP, STEP)]
    curvatures = [
        (stream.slope(rows - STEP) - stream.slope(rows - far)) / (far - STEP),
        (stream.slope(rows + far) - stream.slope(rows + STEP)) / (far - STEP),
    ]
    return float(np.abs(slopes[1] - slopes[0]).max()), float(np.abs(curvatures[1] - curvatures[0]).max())


def test_names_tell_what_is_continuous() -> None:
    # A step of 2e-6 changes slopes by 1e-5, one of 1e-3 curvatures by 2e-2 where no row is.
    assert jumps("linear")[0] > 0.1
    slope, curvature = jumps("monotone")
    assert slope < 1e-4
    assert curvature > 0.5
    slope, curvature = jumps("spline")
    assert slope < 1e-4
    assert curvature < 0.1


def test_monotone_cubics_do_not_overshoot_and_a_spline_does() -> None:
    heights = np.linspace(0.0, 3.0, 301)
    largest = {
        name: TabulatedStream(LEVELS, ROWS, name).profile(heights)[:, 0].max() for name in ("monotone", "spline")
    }
    assert largest["monotone"] == 1.5
    assert largest["spline"] > 1.51


def test_cubic_is_the_older_name_of_monotone() -> None:
    heights = np.linspace(-1.0, 4.0, 101)
    old, new = (TabulatedStream(LEVELS, ROWS, name) for name in ("cubic", "monotone"))
    assert np.array_equal(old.profile(heights), new.profile(heights))
    assert np.array_equal(old.slope(heights), new.slope(heights))
    annotation = LiquidStream.model_fields["interpolation"].annotation
    assert set(get_args(annotation)) == set(get_args(Interpolation))


def test_nodes_are_where_knots_are() -> None:
    nodes = np.linspace(0.0, 1.0, 5)
    # One is moved, one stays where it is near enough, one is added in the middle of an element, loads and ends stay.
    assert at_knots(nodes, np.array([0.3]), []) == pytest.approx([0.0, 0.3, 0.5, 0.75, 1.0])
    assert np.array_equal(at_knots(nodes, np.array([0.25 + 1e-5]), []), nodes)
    assert at_knots(nodes, np.array([0.3]), [0.25]) == pytest.approx([0.0, 0.25, 0.3, 0.5, 0.75, 1.0])
    assert at_knots(nodes, np.array([0.375]), []) == pytest.approx([0.0, 0.25, 0.375, 0.5, 0.75, 1.0])
    assert at_knots(nodes, np.array([0.05]), []) == pytest.approx([0.0, 0.05, 0.25, 0.5, 0.75, 1.0])
    both = at_knots(nodes, np.array([0.24, 0.27]), [])
    assert both == pytest.approx([0.0, 0.24, 0.27, 0.5, 0.75, 1.0])


def test_knots_are_where_the_thread_passes_their_heights() -> None:
    """An arch of height 2.6 passes 1 and 2.5 twice; the other heights are not passed."""
    found = knots_along(
        (-1.0, 1.0, 2.5, 3.0), lambda s: np.column_stack([s, 2.6 * np.sin(np.pi * s)]), np.linspace(0.0, 1.0, 4)
    )
    first, second = np.arcsin(1.0 / 2.6) / np.pi, np.arcsin(2.5 / 2.6) / np.pi
    assert found == pytest.approx([first, second, 1.0 - second, 1.0 - first], abs=1e-12)
    assert len(knots_along((), lambda s: s[:, None], np.linspace(0.0, 1.0, 4))) == 0


def test_too_many_kinks_leave_nodes_where_they_are() -> None:
    heights = tuple(np.linspace(0.001, 0.999, 400))
    assert len(knots_along(heights, lambda s: np.column_stack([s, s]), np.linspace(0.0, 1.0, 4))) == 0


def in_a_tabulated_stream(interpolation: str, seed: int) -> tuple[ThreadScene, FoundEquilibrium]:
    """A line of 100 m on a buoy in a stream of two to eight random rows."""
    draw = np.random.default_rng(seed)
    heights = np.sort(draw.uniform(0.0, 90.0, int(draw.integers(2, 9))))
    rows = [[float(z), float(draw.uniform(-1.0, 2.0)), float(draw.uniform(-0.5, 0.5))] for z in heights]
    scene = ThreadScene.model_validate(
        {
            "thread": {"length": 100.0, "weight": float(draw.uniform(1.0, 10.0)), "diameter": 0.05,
                       "normal_drag": 1.2, "tangential_drag": 0.02},
            "stream": {"density": 1000.0, "profile": rows, "interpolation": interpolation},
            "ends": {"b": {"kind": "free", "weight": -float(draw.uniform(3000.0, 8000.0))}},
        }
    )  # fmt: skip
    return scene, equilibrium_of(MPI.COMM_WORLD, scene)


@pytest.mark.parametrize(
    ("interpolation", "seed"),
    [
        pytest.param("linear", 1, marks=pytest.mark.slow),
        pytest.param("linear", 4, marks=pytest.mark.slow),
        pytest.param("monotone", 1, marks=pytest.mark.slow),
        pytest.param("spline", 1, marks=pytest.mark.slow),
    ],
)
def test_errors_cover_kinks(interpolation: str, seed: int) -> None:
    # With kinks inside elements the true errors of the first two were 2.5 and 1.4 of those stated, with 92 and 182
    # elements; that of "monotone" took 90.
    scene, found = in_a_tabulated_stream(interpolation, seed)
    assert true_error(scene, found.solution) < found.solution.errors.relative <= 1e-6
    assert found.solution.elements[-1] <= 60
