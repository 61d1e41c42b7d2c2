"""Runs of threads: numbers against references, coordinates, files, pictures, sequences, the command."""

import json
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from math import cos, sin
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import xarray
from click.testing import CliRunner
from mpi4py import MPI
from PIL import Image
from thread_cases import inputs, results

from hydroelastic.physics.stream import TabulatedStream
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.thread.physics import thread_of
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.run import run_thread
from hydroelastic.scenes.thread.solve import solve_thread_scene

DENSITY, DIAMETER = 1025.0, 0.024


def thread_scene(name: str, *overrides: str) -> ThreadScene:
    scene = read_scene(name, overrides)
    assert isinstance(scene, ThreadScene)
    return scene


def solve(scene: ThreadScene) -> ThreadSolutionOfScene:
    return solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)


def scene_of(case: str, tolerance: float = 1e-8) -> ThreadScene:
    """A public reference case as a scene: its drag as that of a line of one diameter."""
    given = inputs(case)
    current = given["current"]
    stream: dict[str, Any] = {"density": DENSITY}
    if current["type"] == "uniform":
        stream["velocity"] = current["U"][:2]
    elif current["type"] == "linear":
        stream |= {"velocity": current["U0"][:2], "shear": current["G"][:2]}
    elif current["type"] == "veer":
        stream["veer"] = {"speed": current["U"], "rate": current["rate"]}
    thread = {
        "length": given["L"],
        "weight": given["w"],
        "diameter": DIAMETER,
        "normal_drag": 2.0 * given["kn"] / (DENSITY * DIAMETER),
        "tangential_drag": 2.0 * given["kt"] / (np.pi * DENSITY * DIAMETER),
        "axial_rigidity": given.get("EA"),
    }
    if "body_B" in given:
        body = given["body_B"]
        end: dict[str, Any] = {
            "kind": "free",
            "weight": -body["net_buoyancy"],
            "drag_area": 2.0 * body["kb"] / DENSITY,
        }
    elif "F_B" in given:
        end = {"kind": "free", "force": given["F_B"]}
    else:
        end = {"kind": "fixed", "position": given["B"]}
    document = {
        "thread": thread,
        "stream": stream,
        "ends": {"a": {"kind": "fixed", "position": given["A"]}, "b": end},
        "output": {"positions": (0.0, 0.5 * given["L"], given["L"])},
        "accuracy": {"tolerance": tolerance},
    }
    return ThreadScene.model_validate_json(json.dumps(document))


@pytest.mark.slow_but("S01")
@pytest.mark.parametrize("case", ["S01", "S03", "S05", "S07", "S10", "S12", "S14", "S17"])
def test_public_references_are_within_the_stated_errors(case: str) -> None:
    solution, expected = solve(scene_of(case)), results(case)
    rest = solution.rest
    assert rest.relative_error <= 1e-8
    # The references have eleven digits at least.
    length, largest = solution.scene.thread.length, float(np.max(rest.tensions))
    assert rest.end_positions[1] == pytest.approx(expected["rB"], abs=rest.position_error + 1e-11 * length)
    assert rest.positions[1] == pytest.approx(expected["r_mid"], abs=rest.position_error + 1e-11 * length)
    for place, name in ((0, "N_A"), (2, "N_B")):
        assert rest.forces[place] == pytest.approx(expected[name], abs=rest.tension_error + 1e-11 * largest)
    assert rest.tensions[1] == pytest.approx(expected["T_mid"], abs=rest.tension_error + 1e-11 * largest)


def test_jumper_of_the_literature() -> None:
    rest = solve(thread_scene("jumper", "analysis=[]")).rest
    # FRyDoM's theory manual gives four digits of a catenary that stretches: 47.14 and 26.63 kN.
    assert rest.end_tensions == pytest.approx([26630.0, 47140.0], rel=2e-4)


def turned(scene: ThreadScene, angle: float) -> ThreadScene:
    """The whole scene turned about z."""
    c, s = cos(angle), sin(angle)

    def turn(vector: tuple[float, ...]) -> tuple[float, ...]:
        return (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], *vector[2:])

    assert scene.stream is not None
    assert scene.stream.velocity is not None
    changes: dict[str, Any] = {"velocity": turn(scene.stream.velocity)}
    if scene.stream.shear is not None:
        changes["shear"] = turn(scene.stream.shear)
    return scene.model_copy(update={"stream": scene.stream.model_copy(update=changes)})


def test_a_scene_that_is_turned_gives_what_is_turned() -> None:
    scene = scene_of("S10")
    plain, other = solve(scene), solve(turned(scene, 0.7))
    assert plain.frame.dimension == other.frame.dimension == 2
    c, s = cos(0.7), sin(0.7)
    matrix = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    assert other.rest.positions == pytest.approx(plain.rest.positions @ matrix.T, abs=1e-10 * 120.0)
    assert other.rest.forces == pytest.approx(plain.rest.forces @ matrix.T, abs=1e-9 * 1800.0)


def test_ends_can_change_their_names() -> None:
    scene = scene_of("S10")
    ends = scene.ends.model_copy(update={"a": scene.ends.b, "b": scene.ends.a})
    plain, swapped = solve(scene), solve(scene.model_copy(update={"ends": ends}))
    assert swapped.rest.positions[::-1] == pytest.approx(plain.rest.positions, abs=1e-9 * 120.0)
    assert swapped.rest.forces[::-1] == pytest.approx(-plain.rest.forces, abs=1e-8 * 1800.0)


@pytest.mark.slow
def test_a_plane_need_not_pass_through_the_origin() -> None:
    overrides = ("output.frames=0", 'analysis=[{kind = "motion", times = [0.0, 0.1], step = 0.05, tolerance = 0.1}]')
    plain = solve(thread_scene("released_chain", *overrides))
    ends = ("ends.a.position=[0.0, 2.0, 0.0]", "ends.b.position=[8.0, 2.0, -5.5]")
    aside = solve(thread_scene("released_chain", *overrides, *ends))
    assert aside.frame.dimension == 2
    way = np.array([0.0, 2.0, 0.0])
    assert aside.rest.positions == pytest.approx(plain.rest.positions + way, abs=1e-10)
    assert aside.rest.end_positions == pytest.approx(plain.rest.end_positions + way, abs=1e-10)
    assert aside.motions[0].positions == pytest.approx(plain.motions[0].positions + way, abs=1e-8)
    assert aside.rest.forces == pytest.approx(plain.rest.forces, abs=1e-8)


def test_a_stream_by_a_table_grows_like_any_other() -> None:
    table = "stream={density = 1000.0, profile = [[-10.0, 1.0, 0.0], [10.0, 2.0, 0.5]]}"
    thread = thread_of(thread_scene("fluttering_hose", table, "analysis=[]"))
    faster = TabulatedStream((-10.0, 10.0), ((2.0, 0.0, 0.0), (4.0, 1.0, 0.0)))
    assert thread.with_stream_factor(2.0).stream == faster
    assert thread.with_stream_factor(0.0).stream is None


def clamped(axial_rigidity: float | None, **changes: Any) -> ThreadScene:
    """A line clamped across its pull, whose moment is in a layer of √(EI/T) = 0.07 m."""
    document = {
        "thread": {"length": 10.0, "weight": 4.0, "mass": 1.0, "flexural_rigidity": 1.0,
                   "axial_rigidity": axial_rigidity},
        "ends": {"a": {"kind": "fixed", "clamp": [1.0, 0.0, 0.0]},
                 "b": {"kind": "free", "force": [30.0, 0.0, 200.0]}},
        "accuracy": {"tolerance": 1e-8}, **changes,
    }  # fmt: skip
    return ThreadScene.model_validate_json(json.dumps(document))


@pytest.mark.slow
def test_clamps_leave_a_thread_its_stretch() -> None:
    stiff = solve(clamped(None)).rest.end_moments[0]
    rigidities = np.array([1e6, 1e7, 1e8])
    moments = [solve(clamped(float(rigidity))).rest.end_moments[0] for rigidity in rigidities]
    # In proportion to the strain T/EA, up to a term of its square root: 1.4 % of it at most.
    slope = np.polyfit(np.log(rigidities), np.log(np.abs(np.array(moments) - stiff)), 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.015)


@pytest.mark.slow
def test_modes_of_a_clamped_thread_that_stretches() -> None:
    """Undamped, and those of a thread that does not stretch but for the strain."""
    asked = {"analysis": [{"kind": "modes", "count": 4}], "accuracy": {"tolerance": 1e-6}}
    (stiff,), (soft,) = solve(clamped(None, **asked)).modes, solve(clamped(1e7, **asked)).modes
    assert np.all(np.abs(soft.oscillating.values.real) < 1e-9 * soft.frequencies)
    # T/EA = 2e-5.
    assert soft.frequencies == pytest.approx(stiff.frequencies, rel=1e-4)


def test_body_on_the_thread_is_a_jump_of_the_force() -> None:
    load = "[{ at = 40.0, weight = -300.0 }]"
    rest = solve(thread_scene("moored_buoy", "analysis=[]", f"load={load}", "output.positions=[39.999999, 40.0]")).rest
    # Beyond a load the force is that of the part beyond it; q acts on a millionth of a metre.
    assert rest.forces[1] - rest.forces[0] == pytest.approx([0.0, 0.0, -300.0], abs=1e-3)


def test_slack_in_a_motion_is_said_loudly() -> None:
    # The water burdens a chain across but not along: where it turns below, its upper part would push the lower one.
    overrides = (
        "thread.length=12.0",
        "thread.mass=3.0",
        "ends.b.position=[10.0, 0.0, 2.0]",
        'analysis=[{kind = "motion", times = [0.0, 0.5, 1.0], step = 0.05, tolerance = 1e-1, '
        'release = [{end = "b", time = 0.25}]}]',
    )
    outcome = run_thread(thread_scene("released_chain", *overrides))
    assert outcome.status == "unconverged"
    assert "compression" in " ".join(outcome.reasons)
    assert "SLACK" in outcome.tables


def test_a_motion_of_unknown_tensions_is_said_to_be_so() -> None:
    overrides = ("output.frames=0", 'analysis=[{kind = "motion", times = [0.0, 0.1], step = 0.05, tolerance = 0.1}]')
    solution = solve(thread_scene("released_chain", *overrides))
    (motion,) = solution.motions
    assert solution.reasons == ()
    extremes = replace(motion.extremes, error=0.11 * float(np.max(motion.extremes.highest)))
    unknown = replace(motion, extremes=extremes)
    (reason,) = replace(solution, motions=(unknown,)).reasons
    assert "estimated error of tensions" in reason


@pytest.mark.slow
def test_stream_that_starts_ends_in_the_equilibrium() -> None:
    overrides = (
        'analysis=[{kind = "motion", start = "still_liquid", times = [0.0, 400.0], tolerance = 1e-2, step = 2.0}]',
        "output.frames=0",
    )
    (motion,) = solve(thread_scene("moored_buoy", *overrides)).motions
    # The slowest motion dies away like e^(−0.0155 t); its amplitude at first is that of the distance.
    first = float(np.max(np.linalg.norm(motion.positions[0] - motion.positions[-1], axis=1)))
    assert motion.distance_to_rest < 3.0 * first * np.exp(-0.0155 * 400.0)


def test_given_tension_of_a_straight_string_in_a_stream() -> None:
    given, (first, second) = inputs("M07a"), results("M07a")["lam"]
    document = {
        # Added mass of 1 kg/m.
        "thread": {"length": given["L"], "diameter": (4e-3 / np.pi) ** 0.5, "mass": given["m"], "tension": given["T"],
                   "added_mass": given["M"], "reactive": "lighthill", "weight": 0.0},
        "stream": {"density": 1000.0, "velocity": [given["U"], 0.0]},
        "ends": {"b": {"kind": "fixed", "position": [given["L"], 0.0, 0.0]}},
        "analysis": [{"kind": "modes", "count": 4}],
    }  # fmt: skip
    (modes,) = solve(ThreadScene.model_validate_json(json.dumps(document))).modes
    # Each in both directions across the string.
    expected = [first[1], first[1], second[1], second[1]]
    assert modes.oscillating.values.imag == pytest.approx(expected, rel=1e-9)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of a scene with modes and a motion."""
    scene = thread_scene(
        "released_chain",
        "output.frames=3",
        'analysis=[{kind = "modes", count = 2}, {kind = "motion", times = [0.0, 0.5, 1.0], tolerance = 1e-2, '
        'release = [{end = "b", time = 0.25}]}]',
    )
    found = tmp_path_factory.mktemp("thread") / "results"
    assert run_thread(scene, out=found).status == "ok"
    return found


def test_files_tell_the_same(folder: Path) -> None:
    shape = np.genfromtxt(folder / "shape.csv", delimiter=",", names=True)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert shape["tension"][[0, -1]] == pytest.approx(summary["equilibrium"]["end_tensions"], rel=1e-9)
    modes = np.genfromtxt(folder / "modes.csv", delimiter=",", names=True)
    omegas = [mode["damped_omega"] for mode in summary["modes"][0]["oscillating"]]
    assert modes["imaginary_part"] == pytest.approx(omegas, rel=1e-10)
    with xarray.open_dataset(folder / "dataset.nc") as dataset:
        assert dataset["tension"].values == pytest.approx(shape["tension"], rel=1e-10)
        assert dataset["position"].sel(axis="z").values == pytest.approx(shape["z"], abs=1e-9)
        assert dataset["root"].sel(complex="im").values == pytest.approx(omegas, rel=1e-12)
        motion = np.genfromtxt(folder / "motion.csv", delimiter=",", names=True)
        assert motion["x"] == pytest.approx(dataset["motion_position"].sel(axis="x").values.ravel(), abs=1e-9)
        assert dataset["motion_tension"].attrs["units"] == "N"
        assert dataset.attrs["status"] == "ok"


def test_paraview_plays_the_motion(folder: Path) -> None:
    entries = ElementTree.parse(folder / "fields" / "motion.pvd").getroot().findall("Collection/DataSet")
    assert [float(entry.attrib["timestep"]) for entry in entries] == [0.0, 0.5, 1.0]
    last = meshio.read(folder / "fields" / entries[-1].attrib["file"])
    with xarray.open_dataset(folder / "dataset.nc") as dataset:
        assert last.points == pytest.approx(dataset["motion_position"].isel(time=-1).values, abs=1e-9)
        assert last.point_data["tension"] == pytest.approx(dataset["motion_tension"].isel(time=-1).values, abs=1e-9)
    rest = meshio.read(folder / "fields" / "equilibrium.vtu")
    assert len(rest.cells_dict["line"]) == len(rest.points) - 1


def test_pictures_show_something(folder: Path) -> None:
    names = {path.name for path in (folder / "images").glob("*.png")}
    assert names == {"equilibrium.png", "tension.png", "modes.png", "motion.png", "tension_in_time.png"}
    frames = sorted(path.name for path in (folder / "images" / "frames").iterdir())
    assert frames == ["frame_0000.png", "frame_0001.png", "frame_0002.png"]
    for path in (*(folder / "images").glob("*.png"), *(folder / "images" / "frames").iterdir()):
        pixels = np.asarray(Image.open(path).convert("RGB"), dtype=int)
        # A line, its axes and words: neither blank nor full.
        drawn = np.mean(np.any(pixels < 250, axis=2))
        assert 0.005 < drawn < 0.6, path.name


def test_command_prints_the_table(tmp_path: Path) -> None:
    arguments = ["run", "catenary", "--set", "analysis=[]", "--out", str(tmp_path / "out"), "--no-images"]
    found = CliRunner().invoke(main, arguments)
    assert found.exit_code == 0, found.output
    assert "tensions at the ends A and B, N" in found.output
    assert "258.611" in found.output


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_processes_agree() -> None:
    one = solve_thread_scene(scene_of("S14"), MPI.COMM_SELF, lambda _message: None).rest
    all_of_them = solve(scene_of("S14")).rest
    assert all_of_them.positions == pytest.approx(one.positions, abs=1e-10 * 200.0)
    assert all_of_them.tensions == pytest.approx(one.tensions, abs=1e-10 * 2500.0)
