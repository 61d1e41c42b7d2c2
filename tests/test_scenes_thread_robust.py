"""Equilibria of threads that are hard to find: random ones, and each hard case by itself."""

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from random_threads import all_numbers, random_thread
from thread_truth import true_error

from hydroelastic.fem.thread.equilibrium import Start
from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium
from hydroelastic.fem.thread.refinement import CompressionError, solve_thread
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.physics import frame_of, thread_of
from hydroelastic.scenes.thread.solve import equilibrium_of

TOLERANCE = 1e-6
# What a march or a shot with steps of 1e-12 is good for.
INTEGRATION = 1e-10
QUICK = all_numbers(0.07)


def solved(data: dict[str, Any]) -> FoundEquilibrium:
    scene = ThreadScene.model_validate(data)
    return equilibrium_of(MPI.COMM_WORLD, scene)


def fixed(*position: float, **more: Any) -> dict[str, Any]:
    return {"kind": "fixed", "position": position, **more}


def free(**more: Any) -> dict[str, Any]:
    return {"kind": "free", **more}


def scene_of(
    length: float, weight: float, end: dict[str, Any], stream: dict[str, Any] | None = None, **thread: Any
) -> dict[str, Any]:
    """A thread 1 cm thick in water, kn = 6 N·s²/m³, from the origin."""
    given = {"length": length, "diameter": 0.01, "weight": weight, "normal_drag": 1.2, "tangential_drag": 0.02}
    return {
        "thread": given | thread,
        "stream": {"density": 1000.0, **(stream or {})},
        "ends": {"a": fixed(0.0, 0.0, 0.0), "b": end},
    }


def assert_sound(kind: str, number: int, *, truth: bool) -> None:
    data = random_thread(kind, number)
    solution = solved(data).solution
    assert solution.errors.relative <= TOLERANCE
    if kind != "bending":
        smallest, _ = solution.profile.smallest_tension()
        assert smallest >= -1e-8 * solution.equilibrium.units.force
    if truth:
        assert true_error(ThreadScene.model_validate(data), solution) <= solution.errors.relative + INTEGRATION


@pytest.mark.slow_but("free-0", "slack-1", "taut-0", "tail-1", "bending-3")
@pytest.mark.parametrize(("kind", "number"), QUICK)
def test_random_threads(kind: str, number: int) -> None:
    assert_sound(kind, number, truth=number == 0)


@pytest.mark.slow
def test_all_random_threads() -> None:
    for kind, number in all_numbers():
        assert_sound(kind, number, truth=number % 8 == 0)


@pytest.mark.slow_but("3.0")
@pytest.mark.parametrize("length", [3.0, 30.0])
def test_deep_sag(length: float) -> None:
    """A hanging thread of three and of thirty times the distance of its ends: T = H cosh, H from the length."""
    solution = solved(scene_of(length, 1.0, fixed(1.0, 0.0, 0.0))).solution
    horizontal = solution.profile.smallest_tension()[0]
    # L = 2 (H/w) sinh(w c/2H).
    assert 2.0 * horizontal * np.sinh(0.5 / horizontal) == pytest.approx(length, rel=1e-5)


# As the angle between stream and chord falls the thread comes near to a fold without tension.
def test_slack_nearly_along_the_stream() -> None:
    found = solved(scene_of(1.5, 0.0, fixed(1.0, 0.0, 0.0), {"velocity": (1.0, 0.1)}))
    assert 0.0 < found.solution.profile.smallest_tension()[0] < 0.05


@pytest.mark.parametrize(
    "stream",
    [
        {"velocity": (1.0, 0.0), "shear": (0.1, 0.0)},
        pytest.param({"velocity": (1.0, 1e-7)}, marks=pytest.mark.slow),
    ],
)
def test_slack_along_the_stream_has_no_shape(stream: dict[str, Any]) -> None:
    with pytest.raises(UnsolvedError, match="no equilibrium under tension was found: "):
        solved(scene_of(1.5, 0.0, fixed(1.0, 0.0, 0.0), stream))


def test_nothing_pulls_an_unstretched_thread() -> None:
    with pytest.raises(UnsolvedError, match="not stretched, without load across its chord, has no tension"):
        solved(scene_of(1.0, 0.0, fixed(1.0, 0.0, 0.0), axial_rigidity=100.0))


def test_nearly_vertical_tow() -> None:
    """The end moves downstream by ∫ s q ds/F = kn U² L²/2F to first order in the load by the force."""
    length, force, speed = 100.0, 1e5, 0.01
    data = scene_of(length, 1.0, free(force=(0.0, 0.0, -force)), {"velocity": (speed, 0.0)})
    end = solved(data).solution.profile.position(np.array([length]))[0]
    assert end[0] == pytest.approx(6.0 * speed**2 * length**2 / (2.0 * force), rel=2.0 * length / force)


@pytest.mark.slow_but("1.0-0.001")
@pytest.mark.parametrize("part", [1e-2, 1e-3])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_light_body_at_the_end(part: float, sign: float) -> None:
    """The layer at the end, T_B/|q| long, is found by a mesh that is graded to it: of few elements."""
    data = scene_of(100.0, 1.0, free(weight=sign * part * 600.0), {"velocity": (1.0, 0.0)})
    solution = solved(data).solution
    assert true_error(ThreadScene.model_validate(data), solution) < solution.errors.relative < TOLERANCE
    # Elements of one size would be 1/(20 part) and more.
    assert solution.elements[-1] <= 80


def test_arch_is_refused() -> None:
    """From above its ends a thread without rigidity comes to stand as an arch, in compression."""
    scene = ThreadScene.model_validate(scene_of(1.5, 1.0, fixed(1.0, 0.0, 0.0)))
    model = frame_of(scene).thread_in_frame(thread_of(scene))
    hanging = equilibrium_of(MPI.COMM_WORLD, scene).solution.profile
    arch = Start(
        position=lambda s: hanging.position(s) * [1.0, -1.0], force=lambda s: np.asarray(-hanging.tension_at(s))
    )
    with pytest.raises(CompressionError, match=r"would be in compression: its tension is -\d"):
        solve_thread(MPI.COMM_WORLD, model, arch)


@pytest.mark.slow_but("1e-10")
@pytest.mark.parametrize("rigidity", [1e-4, 1e-10])
def test_clamp_layer_is_resolved(rigidity: float) -> None:
    """M = 2 √(EI T) sin(Δφ/2) at the clamp up to √(EI/T)/L, from where the thread without rigidity leaves."""
    stream, body = {"velocity": (0.5, 0.0)}, free(weight=5.0)
    loose = solved(scene_of(10.0, 1.0, body, stream)).solution.profile
    force = loose.force[0, 0]
    data = scene_of(10.0, 1.0, body, stream, flexural_rigidity=rigidity)
    data["ends"]["a"]["clamp"] = (1.0, 0.0, 0.0)
    moment = solved(data).solution.profile.end_moments()[0]
    tension = float(np.linalg.norm(force))
    angle = float(np.arccos(force[0] / tension))
    layer = 2.0 * np.sqrt(rigidity * tension) * np.sin(0.5 * angle)
    assert moment == pytest.approx(layer, rel=np.sqrt(rigidity / tension) / 10.0 + 1e-5)


def test_nearly_inextensible() -> None:
    """EA = 1e12 N moves nothing by more than T/EA, which is far below the tolerance."""
    data = scene_of(1.5, 1.0, fixed(1.0, 0.0, 0.0), {"velocity": (0.2, 0.1)})
    s = np.linspace(0.0, 1.5, 11)
    rigid = solved(data).solution.profile
    data["thread"]["axial_rigidity"] = 1e12
    soft = solved(data).solution.profile
    np.testing.assert_allclose(soft.position(s), rigid.position(s), atol=1e-10)
    np.testing.assert_allclose(soft.tension_at(s), rigid.tension_at(s), rtol=1e-9)


@pytest.mark.slow
def test_current_that_turns_round() -> None:
    """u_t changes its sign inside the thread, where the load has a kink."""
    data = scene_of(100.0, 0.1, free(force=(50.0, 0.0, 400.0)), {"velocity": (1.0, 0.0), "shear": (-0.03, 0.0)})
    solution = solved(data).solution
    assert true_error(ThreadScene.model_validate(data), solution) < solution.errors.relative < TOLERANCE


@pytest.mark.slow
@pytest.mark.parametrize("factor", [pytest.param(1.0, marks=pytest.mark.slow), 1.1])
def test_weight_that_nearly_cancels_drag(factor: float) -> None:
    """The thread lies along its critical line and turns back in a hook, far from every catenary."""
    drag = 6.0 * np.sqrt(0.5) / 2.0 - 0.5 * 1000.0 * np.pi * 0.02 * 0.01 * 0.5 * np.sqrt(0.5)
    end = fixed(np.sqrt(0.5), 0.0, -np.sqrt(0.5))
    data = scene_of(1.5, factor * drag, end, {"velocity": (1.0, 0.0)})
    found = solved(data)
    assert found.start == "a thread that bends less and less"
    assert found.failed
    assert found.solution.profile.smallest_tension()[0] > 0.1
    assert true_error(ThreadScene.model_validate(data), found.solution) < TOLERANCE


def test_ends_on_a_vertical_in_a_weak_stream() -> None:
    data = scene_of(1.5, 1.0, fixed(0.0, 0.0, 1.0), {"velocity": (1e-3, 0.0)})
    assert 0.0 < solved(data).solution.profile.smallest_tension()[0] < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("weight", [1.0, 0.0])
def test_rigidity_gives_a_folded_thread_a_shape(weight: float) -> None:
    """Both ends on one vertical; without weight half a loop of the elastica, whose ends bear the same force."""
    found = solved(scene_of(1.5, weight, fixed(0.0, 0.0, 1.0), flexural_rigidity=1e-3))
    assert found.start == "a bow"
    reactions = found.solution.profile.reactions()
    np.testing.assert_allclose(reactions.sum(axis=0), [0.0, 1.5 * weight], atol=1e-6)


def test_clamp_that_points_away_is_turned_to() -> None:
    """From a catenary the thread folds at a clamp that points upwards; there it is no thread, on no mesh."""
    data = scene_of(1.75, 1.0, fixed(1.0, 0.0, 0.0), flexural_rigidity=1.75 * 0.0175**2)
    data["ends"]["a"]["clamp"] = (0.0, 0.0, 1.0)
    solution = solved(data).solution
    assert solution.ramps[0][0] == "turning clamps"
    table = solution.profile.curvature_table
    assert table is not None
    along = np.sum(table.at(np.zeros(1)) * solution.profile.position_table.at(np.zeros(1), 1))
    assert abs(along) < 1e-3 * np.linalg.norm(table.at(np.zeros(1)))


@pytest.mark.slow
def test_moving_load_beyond_the_tension() -> None:
    """M U² > T: bends of the thread are pushed on, and no mesh is fine enough."""
    data = scene_of(
        10.0,
        0.0,
        free(force=(0.05, 0.0, 0.0)),
        {"velocity": (1.0, 0.0)},
        added_mass=1.0,
        reactive="moving_load",
    )
    with pytest.raises(UnsolvedError, match="the error is still"):
        solved(data)


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_on_all_processes() -> None:
    found = solved(random_thread("slack", 2))
    tension = found.solution.profile.tension
    np.testing.assert_array_equal(MPI.COMM_WORLD.bcast(tension), tension)
    assert true_error(ThreadScene.model_validate(random_thread("slack", 2)), found.solution) < TOLERANCE
