"""Threads in motion: falls and swings in closed form, energy, the string as another model, slack, extremes."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_bvp, solve_ivp
from thread_cases import inputs, results
from thread_scenes import coefficients, fixed, free, scene

import hydroelastic as he

G = 9.81
WATER = {"density": 1000.0}
DIAMETER = (4e-3 / np.pi) ** 0.5


def motion(times: Any, tolerance: float = 1e-3, **more: Any) -> dict[str, Any]:
    return {"kind": "motion", "times": [float(time) for time in times], "tolerance": tolerance, **more}


def moved(document: dict[str, Any]) -> tuple[dict[str, Any], Any]:
    """What the summary tells of the only motion of a scene, and the data set."""
    result = he.solve(document)
    (told,) = result.summary["motion"]
    return told, result.dataset


@pytest.mark.slow
def test_a_bob_on_a_thread_is_a_pendulum() -> None:
    """Case D01: after three quarters of its period it passes the lowest point, with the speed of its fall."""
    period, angle = results("D01")["period"], np.deg2rad(60.0)
    thread = {"length": 1.0, "mass": 1e-6, "weight": 1e-6 * G}
    start = {"start": "straight", "direction": [np.sin(angle), 0.0, -np.cos(angle)]}
    asked = motion([0.0, 0.5 * period, 0.75 * period], 1e-3, **start)
    told, data = moved(scene(thread, free(weight=G, mass=1.0), asked))
    tips = data.motion_position.values[:, -1]
    allowed = told["position_error"] + 1e-6
    assert told["position_error"] < 1e-3
    assert tips[1] == pytest.approx([-np.sin(angle), 0.0, -np.cos(angle)], abs=allowed)
    assert tips[2] == pytest.approx([0.0, 0.0, -1.0], abs=allowed)
    # M g cos θ₀ where it is let go, M (g + v²/L) at the lowest point.
    assert data.motion_tension.values[0, 0] == pytest.approx(G * np.cos(angle), rel=1e-4)
    assert data.motion_tension.values[2, 0] == pytest.approx(G * (3.0 - 2.0 * np.cos(angle)), rel=1e-3)


def test_a_straight_thread_falls_by_two_laws() -> None:
    """Case D03: tanh laws of its own across and along, without tension; stable enough for 0.3 s."""
    given = inputs("D03")
    angle = np.deg2rad(given["theta_deg"])
    along, across = np.array([np.cos(angle), 0.0, -np.sin(angle)]), np.array([-np.sin(angle), 0.0, -np.cos(angle)])
    thread = {"length": given["L"], "weight": given["w"], **coefficients(given)}
    course = {"start": "straight", "direction": along.tolist(), "release": [{"end": "a", "time": 0.0}]}
    asked = motion([0.0, 0.1, 0.3], 1e-5, **course)
    result = he.solve(scene(thread, free(), asked, stream={"density": 1025.0}))
    (told,) = result.summary["motion"]
    assert result.summary["status"] == "ok"
    fall = result.dataset.motion_position.values[1:] - result.dataset.motion_position.values[0]
    for direction, key in ((across, "drop_n"), (along, "drop_t")):
        exact = np.array(results("D03")[key][:2])
        assert np.abs(fall @ direction - exact[:, None]).max() < told["position_error"] + 1e-7, key
    assert np.abs(result.dataset.motion_tension.values).max() < 1e-6 * given["w"]


def test_a_hanging_thread_that_is_let_go_falls_freely() -> None:
    """Its tension vanishes at once, and all of it falls by gt²/2."""
    release = {"release": [{"end": "a", "time": 0.25}]}
    thread = {"length": 1.0, "mass": 1.0, "weight": G}
    _, data = moved(scene(thread, free(), motion([0.0, 0.2, 0.25, 0.5], **release)))
    nodes, tension = data.node.values, data.motion_tension.values
    assert tension[:2] == pytest.approx(np.tile(G * (1.0 - nodes), (2, 1)), abs=1e-6)
    assert np.abs(tension[2:]).max() < 1e-6
    assert data.motion_position.values[-1, :, 2] == pytest.approx(-nodes - 0.5 * G * 0.25**2, abs=1e-8)


def test_the_tension_just_after_an_end_is_let_go() -> None:
    """T_ss = κ²T at rest, T_s = w τ_z at the end that is held, T = 0 at the free one; H = 0.3 weights of the thread."""
    height = 0.3
    thread, reach = {"length": 1.0, "mass": 1.0, "weight": G}, 2.0 * height * np.arcsinh(0.5 / height)
    solution = solve_bvp(
        lambda s, y: np.array([y[1], (height / (height**2 + (s - 0.5) ** 2)) ** 2 * y[0]]),
        lambda a, b: np.array([a[1] + G * 0.5 / np.hypot(0.5, height), b[0]]),
        np.linspace(0.0, 1.0, 50),
        np.zeros((2, 50)),
        tol=1e-8,
    )
    asked = motion([0.0, 0.1, 0.101], release=[{"end": "b", "time": 0.1}])
    _, data = moved(scene(thread, fixed(reach, 0.0, 0.0), asked))
    nodes, tension = data.node.values, data.motion_tension.values
    at_rest = G * np.hypot(nodes - 0.5, height)
    # Nodal tensions are means of linear functions on both sides, of second order: h²κ²T/12.
    assert np.abs(tension[0] - at_rest).max() < 2e-2
    assert np.abs(tension[1] - solution.sol(nodes)[0]).max() < 5e-2
    assert np.abs(solution.sol(nodes)[0] - at_rest).max() > 1.0


CHAIN = {"length": 1.0, "mass": 1.0, "weight": G}
BOB = free(weight=4.905, mass=0.5)
ASIDE = {"start": "straight", "direction": [np.sin(1.0), 0.0, -np.cos(1.0)]}
TRAILED: dict[str, Any] = {"drag": 2.0, "added_mass": 0.4}


@pytest.mark.mpi
@pytest.mark.parametrize("rigidity", [{}, {"axial_rigidity": 200.0, "flexural_rigidity": 0.05}])
def test_energy_is_kept_in_empty_space(rigidity: dict[str, float]) -> None:
    """However the thread whips: kinetic, of weight, of stretch and of bending together."""
    _, data = moved(scene(CHAIN | rigidity, BOB, motion([0.0, 0.7], 0.1, step=0.02, **ASIDE)))
    energies = data.energy.values
    assert energies[:, 0].max() > 1.0
    assert np.abs(energies.sum(axis=1) - energies[0].sum()).max() < 1e-9 * energies[:, 0].max()
    chords = np.linalg.norm(np.diff(data.motion_position.values, axis=1), axis=2)
    if not rigidity:
        # Of a thread that cannot stretch nodes are never farther apart than along it.
        assert np.all(chords < np.diff(data.node.values) * (1.0 + 1e-9))


def test_energy_lost_is_what_the_drag_takes() -> None:
    """Of a thread without added mass, whose energy in the liquid is none of the thread's."""
    thread = CHAIN | {"diameter": DIAMETER, "normal_drag": 0.112, "tangential_drag": 0.02}
    told, data = moved(scene(thread, BOB, motion([0.0, 0.6], 0.1, step=0.02, **ASIDE), stream=WATER))
    energies, work = data.energy.values.sum(axis=1), data.work_of_drag.values
    assert work[-1] == told["work_of_drag"] < -0.2
    # Drag in still liquid never drives.
    assert np.all(np.diff(work) <= 1e-12)
    assert energies - energies[0] == pytest.approx(work - work[0], abs=1e-9)
    assert told["energy_at_start"] == pytest.approx(energies[0])


@pytest.mark.slow_but("inextensible")
@pytest.mark.parametrize(
    ("thread", "integrator"),
    [({}, "midpoint"), ({"axial_rigidity": 400.0}, "midpoint"), ({"axial_rigidity": 400.0}, "generalized_alpha")],
    ids=["inextensible", "midpoint", "generalised alpha"],
)
def test_both_integrators_are_of_second_order(thread: dict[str, Any], integrator: str) -> None:
    """Of positions and tensions, in a smooth motion.

    A straight thread let go aslant has no acceleration at its held end and g sin θ beside it: waves of all lengths
    start there, and orders between 1.6 and 2.3 are seen until steps resolve the shortest ones of the mesh.
    """
    lead = [{"end": "a", "amplitude": [0.2, 0.0, 0.0], "omega": 3.0, "rise": 0.6}]
    solutions = []
    for step in (0.01, 0.005, 0.0025):
        asked = motion([0.0, 0.8], 0.1, step=step, integrator=integrator, move=lead)
        _, data = moved(scene(CHAIN | thread, BOB, asked))
        solutions.append((data.motion_position.values[1], data.motion_tension.values[1]))
    for quantity in zip(*solutions, strict=True):
        changes = [np.abs(a - b).max() for a, b in pairwise(quantity)]
        # Measured 2.00 to 2.02.
        assert np.log2(changes[0] / changes[1]) == pytest.approx(2.0, abs=0.05)


@pytest.mark.slow
def test_stated_errors_cover_the_true_ones() -> None:
    thread = CHAIN | {"diameter": DIAMETER, "normal_drag": 0.112, "tangential_drag": 0.02, "added_mass": 0.4}
    rough, fine = (
        moved(scene(thread, BOB, motion([0.0, 0.15, 0.3], tolerance, **ASIDE), stream=WATER))
        for tolerance in (2e-2, 2e-4)
    )
    error = np.linalg.norm(rough[1].motion_position.values[:, -1] - fine[1].motion_position.values[:, -1], axis=1).max()
    assert error <= rough[0]["position_error"] + fine[0]["position_error"]
    assert rough[0]["position_error"] <= 2e-2
    assert rough[0]["steps"] < fine[0]["steps"]


@pytest.mark.slow
def test_small_motions_are_those_of_the_hanging_string(tmp_path: Path) -> None:
    """Another model of the same thing: a chain with a body in a viscous liquid, its upper end led by a table."""
    times = np.linspace(0.0, 2.0, 81)
    lead = 1e-3 * np.sin(0.5 * np.pi * times) ** 4
    (tmp_path / "lead.csv").write_text(
        "".join(f"{time:.17g}, {x:.17g}, 0, 0\n" for time, x in zip(times, lead, strict=True)), encoding="utf-8"
    )
    string = {
        "kind": "string",
        "string": {"length": 1.0, "linear_density": 1.0, "resistance": 0.3, "tip_mass": 0.5, "added_mass": 0.4},
        "motion": {"kind": "table", "times": times.tolist(), "values": lead.tolist()},
        "output": {"positions": [0.0, 0.5], "times": [0.5, 1.0, 1.5], "frames": 0},
        "accuracy": {"tolerance": 1e-4},
    }
    expected = he.solve(string).dataset.displacement.values
    thread = CHAIN | {"diameter": DIAMETER, "viscous_drag": 0.6, "added_mass": 0.4}
    # A thousandth of the motion is a millionth of the length.
    asked = motion([0.0, 0.5, 1.0, 1.5], 1e-6, move=[{"end": "a", "file": str(tmp_path / "lead.csv")}])
    _, data = moved(scene(thread, BOB, asked, stream=WATER))
    places = [int(np.argmin(np.abs(data.node.values - place))) for place in (1.0, 0.5)]
    assert data.node.values[places] == pytest.approx([1.0, 0.5])
    found = data.motion_position.values[1:, places, 0].T
    assert found == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())
    assert np.abs(found).max() > 5e-4


@pytest.mark.slow
def test_towed_through_still_water_it_trails_as_in_a_current() -> None:
    """A short line led at −U comes to the shape that the current U gives to it."""
    thread = CHAIN | {"diameter": 0.05, "normal_drag": 1.2, "tangential_drag": 0.02, "added_mass": 1.0, "weight": 20.0}
    current = scene(thread, free(weight=5.0, mass=0.5, drag_area=0.002), stream=WATER | {"velocity": [0.8, 0.3]})
    expected = he.solve(current).summary["equilibrium"]
    shape = np.subtract(*np.array(expected["end_positions"])[::-1])
    lead = [{"end": "a", "velocity": [-0.8, -0.3, 0.0], "rise": 0.5}]
    asked = motion([0.0, 12.0], 1e-3, move=lead)
    told, data = moved(scene(thread, free(weight=5.0, mass=0.5, drag_area=0.002), asked, stream=WATER))
    last = data.motion_position.values[-1]
    assert last[-1] - last[0] == pytest.approx(shape, abs=told["position_error"] + 1e-3)
    assert data.motion_tension.values[-1, 0] == pytest.approx(expected["end_tensions"][0], rel=1e-2)
    assert np.hypot(*shape[:2]) > 0.3


def test_vortices_push_across() -> None:
    """A straight thread across a stream, let go, moves as a rigid body by drag and lift, and falls along itself."""
    lift, strouhal, diameter = 1.2, 0.2, 0.1
    thread = {"length": 1.0, "mass": 20.0, "weight": 200.0, "diameter": diameter, "normal_drag": 1.0}
    course = {"start": "straight", "release": [{"end": "a", "time": 0.0}]}
    asked = motion([0.0, 0.25, 0.5], 1e-4, vortices={"lift": lift, "strouhal": strouhal}, **course)
    told, data = moved(scene(thread, free(), asked, stream=WATER | {"velocity": [1.0, 0.0]}))

    def rates(_: float, y: Any) -> Any:
        relative = np.array([1.0 - y[0], -y[1]])
        speed = np.hypot(*relative)
        # τ × u_n/|u_n| of a thread that points down.
        side = np.array([relative[1], -relative[0]])
        way = np.sin(2.0 * np.pi * strouhal * y[2] / diameter)
        force = 0.5 * 1000.0 * diameter * speed * (relative + lift * way * side)
        return [*(force / 20.0), speed, y[0], y[1]]

    exact = solve_ivp(rates, (0.0, 0.5), np.zeros(5), t_eval=[0.25, 0.5], rtol=1e-10, atol=1e-12).y[3:].T
    way = data.motion_position.values[1:] - data.motion_position.values[0]
    for found in np.moveaxis(way, 1, 0):
        assert found[:, :2] == pytest.approx(exact, abs=told["position_error"] + 1e-6)
    assert np.abs(exact[-1, 1]) > 30.0 * told["position_error"]


@pytest.mark.slow
def test_a_stream_that_starts_ends_in_the_equilibrium() -> None:
    asked = motion([0.0, 400.0], 1e-2, start="still_liquid", step=2.0)
    result = he.solve(he.read("moored_buoy", {"analysis": [asked], "output.frames": 0}))
    (told,) = result.summary["motion"]
    positions = result.dataset.motion_position.values
    # The slowest motion dies away like e^(−0.0155 t); its amplitude at first is that of the distance.
    first = float(np.max(np.linalg.norm(positions[0] - positions[-1], axis=1)))
    assert told["distance_to_rest"] < 3.0 * first * np.exp(-0.0155 * 400.0)


def test_extremes_are_those_of_all_steps() -> None:
    """An anchor that heaves: what is told of tensions is of the steps between the times asked too."""
    heave = {"end": "a", "amplitude": [0.0, 0.0, 0.5], "omega": 2.0, "rise": 1.0}
    asked = motion([0.0, 2.0, 4.0], 1e-2, move=[heave])
    told, data = moved(he.read("moored_buoy", {"analysis": [asked], "output.frames": 0}))
    highest, lowest = data.tension_range.sel(extreme="highest").values, data.tension_range.sel(extreme="lowest").values
    assert told["largest_tension"] == highest.max() >= data.motion_tension.values.max()
    assert told["smallest_tension"] == lowest.min() <= data.motion_tension.values.min()
    assert told["largest_tension_at"][0] in data.step_end.values
    ends = data.end_tension.values
    assert told["end_tensions_range"] == np.column_stack([ends.min(axis=0), ends.max(axis=0)]).tolist()
    assert told["extreme_tension_error"] >= told["tension_error"]


@pytest.mark.slow
def test_extremes_do_not_depend_on_the_output_times() -> None:
    heave = {"end": "a", "amplitude": [0.0, 0.0, 0.5], "omega": 2.0, "rise": 1.0}
    few, many = (
        moved(he.read("moored_buoy", {"analysis": [motion(times, move=[heave])], "output.frames": 0}))[0]
        for times in ([0.0, 4.0, 8.0], np.linspace(0.0, 8.0, 161))
    )
    error = few["extreme_tension_error"] + many["extreme_tension_error"]
    assert few["largest_tension"] == pytest.approx(many["largest_tension"], abs=error)
    assert few["smallest_tension"] == pytest.approx(many["smallest_tension"], abs=error)


def test_compression_is_said_loudly() -> None:
    """The water burdens a chain across but not along: where it turns below, its upper part would push the lower one."""
    asked = motion([0.0, 0.5, 1.0], 1e-1, step=0.05, release=[{"end": "b", "time": 0.25}])
    chain = {"thread.length": 12.0, "thread.mass": 3.0, "ends.b.position": [10.0, 0.0, 2.0], "analysis": [asked]}
    result = he.solve(he.read("released_chain", chain))
    assert result.summary["status"] == "unconverged"
    assert "compression" in " ".join(result.summary["reasons"])
    assert result.summary["motion"][0]["slack"][0]["tension"] < 0.0
    assert "SLACK" in str(result)


HEAVY = 981000.0


@pytest.mark.parametrize("rigidity", [None, 1e12])
def test_a_slack_start_is_refused_at_once(rigidity: float | None) -> None:
    """A heavy bob two radians from the vertical would have to be pushed by its thread."""
    direction = [np.sin(2.0), 0.0, -np.cos(2.0)]
    thread = {"length": 1.0, "weight": G, "mass": 1.0, "axial_rigidity": rigidity}
    asked = motion([0.0, 1.3, 2.7], 1e-5, start="straight", direction=direction)
    with pytest.raises(he.UnsolvedError, match=r"starts slack.*flexural_rigidity") as refused:
        he.solve(scene(thread, free(weight=HEAVY, mass=1e5), asked))
    # The weight of bob and thread along the thread, at end A.
    assert f"{(HEAVY + G) * np.cos(2.0):.4g} N at s = 0 m" in str(refused.value)


@pytest.mark.parametrize("height", [-1e-2, 0.0])
def test_a_start_that_is_not_slack_is_followed(height: float) -> None:
    thread = {"length": 1.0, "weight": G, "mass": 1.0, "axial_rigidity": 1e6}
    asked = motion([0.0, 0.1], 1e-2, step=0.02, start="straight", direction=[1.0, 0.0, height])
    _, data = moved(scene(thread, free(weight=98.1, mass=10.0), asked))
    # Down by g t²/2 of a bob that begins to fall.
    assert data.motion_position.values[-1, -1, 2] == pytest.approx(height - 0.5 * G * 0.1**2, rel=2e-2)


@pytest.mark.slow
def test_a_line_that_would_hang_in_two_parts_in_still_liquid() -> None:
    """At the start of the motion nothing pulls the buoy aside, and the line is longer than it is deep."""
    thread = {"length": 91.44640239877445, "diameter": 0.0025999781482391564, "normal_drag": 1.2}
    thread |= {"weight": -5.92910037240637e-06, "mass": 3.767506063700118e-07}
    stream = {"density": 1.2, "veer": {"speed": 0.06147092368384201, "rate": 0.0011372609250726107}}
    end = {"kind": "surface", "level": 62.25627390568255, "drag_area": 2.975929769653988}
    with pytest.raises(he.UnsolvedError) as unsolved:
        he.solve(scene(thread, end, motion([0.0, 1.8], 1e-2, start="still_liquid"), stream=stream))
    message = str(unsolved.value)
    assert 'start = "still_liquid": without the stream no equilibrium under tension was found' in message
    assert "x0" not in message
