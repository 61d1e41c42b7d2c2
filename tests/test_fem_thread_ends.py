"""Ends of a thread at rest: a light body, a free tail, a buoy on the surface; compression; ramps; what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpi4py import MPI
from numpy.typing import NDArray
from thread_cases import load_of, results
from thread_field_cases import free_with, held_at, model_of, start_by, start_of

from hydroelastic.fem.thread import newton as thread_newton
from hydroelastic.fem.thread.continuation import solve_with_ramps
from hydroelastic.fem.thread.equilibrium import Start, solve_on_mesh
from hydroelastic.fem.thread.initial_mesh import initial_nodes
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.profile import thread_profile
from hydroelastic.fem.thread.refinement import CompressionError, solve_thread
from hydroelastic.modal.thread.march import march_back, march_tail
from hydroelastic.physics.stream import ShearedStream, TabulatedStream, UniformStream
from hydroelastic.physics.thread import PointLoad, StretchDrag, Thread, ThreadEnd
from hydroelastic.physics.thread_load import ThreadLoad

COMM = MPI.COMM_WORLD


@pytest.mark.parametrize("part", [1e-2, 1e-4])
def test_light_body_in_a_strong_stream(part: float) -> None:
    # The direction turns within T/|q| of the end.
    model = model_of("S08")
    force = part * 53.0 * model.length * np.array([0.3, 0.0, -1.0])
    model = replace(model, ends=(model.ends[0], free_with(force[[0, 2]])))
    marched = march_back(load_of("S08"), model.length, force, tolerance=1e-12)
    start = start_by(march_back(load_of("S08"), model.length, force, tolerance=1e-5).at, 2)
    solution = solve_thread(COMM, model, start, tolerance=1e-7)
    s = np.unique([0.0, *(model.length * (1.0 - np.geomspace(1e-5, 1.0, 60)))])
    expected = marched.at(s)
    difference = np.linalg.norm(solution.profile.position(s) - expected.positions[:, [0, 2]], axis=1)
    # The march is good to some ten times its tolerance.
    assert np.max(difference) <= solution.errors.position + 1e-11 * model.length
    assert np.max(np.abs(solution.profile.tension_at(s) - expected.tensions)) <= solution.errors.tension + 1e-8
    assert solution.elements[-1] < 100


def test_free_tail_in_a_sheared_stream() -> None:
    stream = ShearedStream((2.0, 0.0, 0.0), (0.01, 0.0, 0.0))
    model = replace(model_of("S08"), stream=stream)
    load = ThreadLoad(weight=8.89, normal_drag=13.299375, tangential_drag=0.2785414586489, stream=stream)
    marched = march_tail(load, model.length, tolerance=1e-9)
    solution = solve_thread(COMM, model, start_by(march_tail(load, model.length, tolerance=1e-6).at, 2), tolerance=1e-7)
    s = np.linspace(0.0, 0.99, 50) * model.length
    # The march takes the last 1e-5 of the length as straight.
    np.testing.assert_allclose(
        solution.profile.position(s), marched.at(s).positions[:, [0, 2]], atol=1e-6 * model.length
    )
    assert solution.profile.tension_at(s)[0] == pytest.approx(marched.at([0.0]).tensions[0], rel=1e-6)
    assert abs(solution.profile.tension[-1, 1]) < 1e-9 * solution.profile.tension[0, 0]


@pytest.mark.parametrize(("stretch_drag", "factor"), [("none", 1.0), ("volume", 1.2)])
def test_a_stretched_thread_has_the_drag_of_its_thinner_diameter(stretch_drag: StretchDrag, factor: float) -> None:
    """Stretched by λ = 1.44 its length grows by λ, and its diameter at constant volume falls by √λ."""
    model = Thread(
        dimension=2,
        length=1.0,
        ends=(held_at([0.0, 0.0]), held_at([0.0, 1.44])),
        axial_rigidity=1000.0,
        normal_drag=3.0,
        stretch_drag=stretch_drag,
        stream=UniformStream((0.5, 0.0, 0.0)),
    )
    start = Start(position=lambda s: np.outer(s, [0.0, 1.44]), force=lambda s: np.full(s.shape, 440.0))
    profile = thread_profile(solve_on_mesh(COMM, model, np.linspace(0.0, 1.0, 5), start, degree=2))
    drag = profile.force[0, 0] - profile.force[-1, 1]
    # It turns by q/(2T) = 1e-3 only, which changes stretch and drag by the square.
    assert drag == pytest.approx([0.75 * factor, 0.0], abs=2e-6)


@pytest.mark.mpi
def test_buoy_on_the_surface() -> None:
    # A dead pull of 900 N up takes the end to some height; a surface there must bear just that.
    stream = ShearedStream((0.6, 0.2, 0.0), (0.01, 0.0, 0.0))
    load = ThreadLoad(weight=4.0, normal_drag=12.0, tangential_drag=0.6, stream=stream)

    def force(place: NDArray[np.float64]) -> NDArray[np.float64]:
        velocity = stream.velocity_at(place[None])[0]
        return np.array([0.0, 0.0, 900.0]) + 40.0 * np.linalg.norm(velocity) * velocity

    marched = march_back(load, 120.0, force, tolerance=1e-11)
    surface = float(marched.positions[-1, 2])
    buoy = PointLoad(force=np.array([0.0, 0.0, 100.0]), drag=40.0)
    end = ThreadEnd(load=buoy, held=(False, False, True), position=np.array([0.0, 0.0, surface]))
    # What holds the anchor bears the drag on it, too.
    anchor = replace(held_at([0.0, 0.0, 0.0]), load=PointLoad(force=np.zeros(3), drag=10.0))
    model = Thread(
        dimension=3,
        length=120.0,
        ends=(anchor, end),
        weight=4.0,
        normal_drag=12.0,
        tangential_drag=0.6,
        stream=stream,
    )
    start = start_by(march_back(load, 120.0, np.array([0.0, 0.0, 900.0]), tolerance=1e-5).at, 3)
    profile = thread_profile(solve_on_mesh(COMM, model, np.linspace(0.0, 120.0, 21), start, degree=4))
    # Measured 1e-11.
    np.testing.assert_allclose(profile.position(np.array([120.0]))[0], marched.positions[-1], atol=1e-8 * 120.0)
    reactions = profile.reactions()
    drag = 10.0 * np.hypot(0.6, 0.2) * np.array([0.6, 0.2, 0.0])
    np.testing.assert_allclose(reactions[0], -marched.at([0.0]).forces[0] - drag, atol=1e-7 * 900.0)
    np.testing.assert_allclose(reactions[1], [0.0, 0.0, 800.0], atol=1e-7 * 900.0)


@pytest.mark.slow
def test_profile_with_kinks() -> None:
    levels, speeds = (-100.0, -60.0, -30.0, -10.0, 0.0), (0.1, 0.3, 0.35, 1.0, 1.4)
    stream = TabulatedStream(levels, tuple((speed, 0.0, 0.0) for speed in speeds))
    model = replace(model_of("S08"), length=100.0, stream=stream)
    model = replace(model, ends=(held_at([0.0, -95.0]), free_with([-300.0, 900.0])))
    load = ThreadLoad(weight=8.89, normal_drag=13.299375, tangential_drag=0.2785414586489, stream=stream)
    marched = march_back(load, 100.0, [-300.0, 0.0, 900.0], start=[0.0, 0.0, -95.0], tolerance=1e-6)
    rough, fine = (solve_thread(COMM, model, start_by(marched.at, 2), tolerance=tol) for tol in (1e-5, 1e-8))
    s = np.linspace(0.0, 100.0, 301)
    position = np.linalg.norm(rough.profile.position(s) - fine.profile.position(s), axis=1)
    assert np.max(position) <= rough.errors.position
    assert np.max(np.abs(rough.profile.tension_at(s) - fine.profile.tension_at(s))) <= rough.errors.tension
    # Halving everywhere would take thousands.
    assert fine.elements[-1] < 400


def test_arch_is_refused() -> None:
    start = start_of("S01")
    arch = Start(position=lambda s: start.position(s) * [1.0, -1.0], force=lambda s: -start.force(s))
    with pytest.raises(CompressionError, match=r"in compression: its tension is -7\.619e-01 N at s = "):
        solve_thread(COMM, model_of("S01"), arch)


@pytest.mark.parametrize(("name", "ramp", "sag"), [("S12", "growing drag", 4.0), ("S03", "growing stiffness", 0.3)])
def test_ramps(name: str, ramp: str, sag: float, monkeypatch: pytest.MonkeyPatch) -> None:
    # From so far away Newton's method wanders: it need not do so for long.
    monkeypatch.setattr(thread_newton, "_MOST_STEPS", 20)
    model = model_of(name)
    chord = model.ends[1].position

    def bow(s: NDArray[np.float64]) -> NDArray[np.float64]:
        part = s / model.length
        return np.asarray(np.outer(part, chord) - np.outer(np.sin(np.pi * part), [0.0, sag * model.length]))

    start = Start(position=bow, force=lambda s: np.full_like(s, model.weight * model.length))
    nodes = np.linspace(0.0, model.length, 25)
    found = solve_with_ramps(COMM, model, nodes, start, degree=3)
    assert found.ramp == ramp
    assert 2 <= found.steps < 20
    assert found.equilibrium.model.normal_drag == model.normal_drag
    assert found.equilibrium.model.axial_rigidity == model.axial_rigidity
    assert thread_profile(found.equilibrium).tension[0, 0] == pytest.approx(results(name)["T_A"], rel=1e-6)


def test_failures_say_how() -> None:
    model = model_of("S01")
    straight = Start(position=lambda s: np.outer(s, [0.0, 1.0]), force=np.zeros_like)
    weightless = replace(model, weight=0.0)
    with pytest.raises(ThreadSolverError, match=r"at once: .*; with growing stiffness: "):
        solve_with_ramps(COMM, weightless, np.linspace(0.0, 1.2, 9), straight, degree=3)


def test_first_nodes() -> None:
    model = replace(model_of("S07"), loads={123.0: PointLoad(force=np.array([0.0, -1.0]))})
    nodes = initial_nodes(model, start_of("S07"))
    assert nodes[0] == 0.0
    assert nodes[-1] == model.length
    assert 123.0 in nodes
    assert np.all(np.diff(nodes) > 0.0)
    light = replace(model_of("S08"), ends=(held_at([0.0, 0.0]), free_with([0.0, -1.0])))
    tail = Start(position=start_of("S08").position, force=lambda s: 1.0 + 4.4 * (light.length - s))
    # A twentieth of T/|q|, |q| at most w + kn U².
    assert np.diff(initial_nodes(light, tail))[-1] <= 0.05 / (8.89 + 13.299375 * 4.0)


@pytest.mark.parametrize(
    ("nodes", "message"),
    [
        ([0.0, 1.0], "nodes: 2 values; they must increase from 0 to the length 1.2"),
        ([0.0, 0.9, 0.8, 1.2], "nodes: 4 values"),
        ([0.0, 0.5, 1.2], "nodes: the load at s = 0.4"),
    ],
)
def test_nodes_that_do_not_fit(nodes: list[float], message: str) -> None:
    model = replace(model_of("S01"), loads={0.4: PointLoad(force=np.zeros(2))})
    with pytest.raises(ValueError, match=message):
        solve_on_mesh(COMM, model, np.array(nodes), start_of("S01"))


@pytest.mark.parametrize(
    ("options", "message"), [({"tolerance": 1e-13}, "tolerance is 1e-13"), ({"degree": 1}, "degree is 1")]
)
def test_accuracy_that_cannot_be(options: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        solve_thread(COMM, model_of("S01"), start_of("S01"), **options)  # type: ignore[arg-type]
