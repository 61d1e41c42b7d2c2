"""What is written of a solution of open water: tables, CSV, NetCDF with Capytaine's names, curves, result folder.

The numbers are arbitrary, see `open_tables`: what counts is that each arrives where it belongs.
"""

from __future__ import annotations

import csv
import json
import sys
import types
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import CliRunner
from mpi4py import MPI
from open_tables import ANALYSES, FROM_BOTH_SIDES, arbitrary_solution, open_scene, two_bodies
from scene_files import CIRCLE_IN_OPEN_WATER

from hydroelastic.output.dataset import write_dataset
from hydroelastic.output.json_values import json_ready
from hydroelastic.output.open_water.files import write_open_csv
from hydroelastic.output.open_water.tables import open_cost, open_sections
from hydroelastic.output.open_water.variables import open_variables
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import markdown_sections, printed_sections
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.figures import draw_open
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.open_water.solve import solve_open
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.study.run import study_scene
from hydroelastic.scenes.tank.run import compare_tank


def summary_of(solution: OpenSolution) -> Summary:
    return run_open.summarized(solution.scene, solution)


@pytest.mark.parametrize("kind", range(4))
def test_each_analysis_may_stand_alone(tmp_path: Path, kind: int) -> None:
    solution = arbitrary_solution(open_scene(analyses=[ANALYSES[kind]]))
    write_dataset(tmp_path / "dataset.nc", open_variables(solution), {})
    xarray.load_dataset(tmp_path / "dataset.nc")
    assert printed_open(solution, summary_of(solution))
    write_open_csv(solution, tmp_path)
    assert [path.stem for path in tmp_path.glob("*.csv")] == [ANALYSES[kind]["kind"]]


def test_the_summary_holds_all_numbers_in_strict_json() -> None:
    solution = two_bodies()
    found = json.loads(json.dumps(summary_of(solution), allow_nan=False))
    assert TankScene.model_validate(found["scene"]) == solution.scene
    assert (found["status"], found["reasons"]) == ("ok", [])
    (radiation,), (response,), (resonance,), (decay,) = (
        found[kind] for kind in ("radiation", "response", "resonance", "decay")
    )
    assert radiation["omega"] == [0.0, 1.0, 2.0, 3.0, "inf"]
    assert radiation["energy_residual"] == [1e-8] * 4 + [None]
    assert radiation["added_mass"] == solution.radiation[0].added_mass.tolist()
    force = solution.radiation[0].excitation_force[1, 0, 1, 2]
    assert radiation["excitation_force"][1][0][1][2] == [force.real, force.imag]
    assert response["plates"][0]["body"] == 2
    assert resonance["omega"][0] == [1.0, -0.1]
    assert decay["certified_until"] == 20.0
    assert found["size"]["dofs"] == 20000
    assert found["versions"]["xarray"] == xarray.__version__


def test_json_knows_no_infinity() -> None:
    assert json_ready({"a": [inf, -inf, float("nan"), np.float64(1.5), 2, 1j, "text", None, True]}) == {
        "a": ["inf", "-inf", None, 1.5, 2, [0.0, 1.0], "text", None, True]
    }


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def test_csv_files_hold_all_numbers(tmp_path: Path) -> None:
    solution = two_bodies(FROM_BOTH_SIDES)
    write_open_csv(solution, tmp_path)
    radiation, response = solution.radiation[0], solution.response[1]
    rows = rows_of(tmp_path / "radiation.csv")
    assert [row["omega"] for row in rows] == ["0.0", "1.0", "2.0", "3.0", "inf"]
    assert float(rows[1]["added_mass_body_1__heave_body_2__elastic_1"]) == radiation.added_mass[1, 0, 4]
    force = complex(radiation.excitation_force[2, 1, 1, 3])
    name = "excitation_force_surface_from_right_body_2__pitch"
    assert complex(float(rows[2][f"re_{name}"]), float(rows[2][f"im_{name}"])) == force
    rows = rows_of(tmp_path / "response.csv")
    last = rows[-1]
    assert (last["analysis"], last["waves_from"], last["wave"], last["omega"]) == ("2", "right", "surface", "4.0")
    assert float(last["re_transmission_internal"]) == response.transmission[1, 1, 0].real
    assert float(last["im_body_1__sway"]) == response.amplitudes[1, 1, 1].imag
    rows = rows_of(tmp_path / "deflection.csv")
    assert len(rows) == 5 * 2 * 101
    assert float(rows[-1]["re_deflection"]) == response.plates[0].deflection[-1, -1, -1].real
    assert float(rows_of(tmp_path / "resonance.csv")[1]["im_omega"]) == -0.2
    assert len(rows_of(tmp_path / "decay.csv")) == 41


def test_tables_show_certain_digits_and_say_where_the_rest_is() -> None:
    sweep = {"kind": "radiation", "omega": {"start": 0.1, "stop": 10.0, "number": 100}}
    solution = arbitrary_solution(open_scene(analyses=[sweep, *ANALYSES[2:]]))
    text = printed_open(solution, summary_of(solution))
    heave = text[text.index("Radiation by heave") : text.index("Radiation by sway")]
    assert "21 of 100 frequencies; all of them are in radiation.csv." in heave
    # Every fifth, which makes no more rows than `MOST_ROWS`; the ends of the sweep are always shown.
    shown = [line.split()[0] for line in heave.splitlines() if line.split()[-1:] == ["1.0e-07"]]
    assert shown == [*(f"{0.1 + 0.5 * row:.6g}" for row in range(20)), "10"]
    # Seven digits are certain to 1e-7.
    assert f"{solution.radiation[0].added_mass[0, 0, 0]:#.7g}" in heave
    assert "gives 4: as many as were found" in text
    assert "The released motion decays asymptotically like 0.002/t²" in text
    assert "20000 unknowns" in text


def test_tables_of_two_waves_fit_a_terminal() -> None:
    text = printed_open(two_bodies(), summary_of(two_bodies()))
    assert "…" not in text
    assert "|R| internal" in text
    assert "Motions in waves from the left" in text


def test_what_falls_short_is_said_loudly() -> None:
    solution = arbitrary_solution(open_scene(), reasons=("the error of heave is 1e-3",))
    summary = summary_of(solution)
    assert summary["status"] == "unconverged"
    for text in (printed_open(solution, summary), markdown_open(solution, summary)):
        assert "NOT CONVERGED to the tolerance 1e-06" in text
        assert "the error of heave is 1e-3" in text
    text = markdown_open(solution, summary)
    assert "## Radiation by heave" in text
    # A bar in a cell would end it: all lines of a table have as many cells.
    heave = text[text.index("## Radiation by heave") : text.index("## Radiation by sway")]
    counts = {line.replace(r"\|", "").count("|") for line in heave.splitlines() if line.startswith("|")}
    assert counts == {8}


@pytest.mark.slow
def test_every_analysis_has_its_curves(tmp_path: Path) -> None:
    from PIL import Image

    draw_open(two_bodies(FROM_BOTH_SIDES), tmp_path, PictureOptions())
    names = ["decay_1", "deflection_1_body_2", "deflection_2_body_2", "radiation_1", "resonance_1", "response_1"]
    assert sorted(path.stem for path in tmp_path.iterdir()) == [*names, "response_2"]
    for path in tmp_path.iterdir():
        with Image.open(path) as image:
            assert len(image.convert("L").resize((200, 100)).getcolors() or ()) > 10


@pytest.mark.parametrize("height", [100.0, 2.0])
def test_a_narrow_peak_far_above_all_else_leaves_the_axes(tmp_path: Path, height: float) -> None:
    """Its legend tells how high it is, and where; one that is not far above stays inside."""
    solution = two_bodies([{"kind": "response", "omega": [1.0]}])
    (response,) = solution.response
    omega = np.linspace(0.5, 1.5, 201)
    sizes = np.ones((201, *response.amplitudes.shape[1:]))
    sizes[101, 0, 0] = height
    ratios = np.repeat(response.reflection, 201, axis=0)
    curve = replace(response, omega=omega, amplitudes=sizes, reflection=ratios, transmission=ratios)
    draw_open(replace(solution, response=(replace(response, curve=curve),)), tmp_path, PictureOptions(formats=("svg",)))
    told = f"up to {height:.3g} at 1.005 rad/s" in (tmp_path / "response_1.svg").read_text(encoding="utf-8")
    assert told == (height == 100.0)


SCENE = CIRCLE_IN_OPEN_WATER + '[[analysis]]\nkind = "radiation"\nomega = [1.0, inf]\n'


@pytest.fixture
def scene_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene file in the current folder."""
    monkeypatch.chdir(tmp_path)
    for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "circle.toml").write_text(SCENE, encoding="utf-8")
    return tmp_path / "circle.toml"


def printed_open(solution: OpenSolution, summary: Any) -> str:
    return printed_sections(summary, open_sections(solution, run_open.read(summary)), open_cost(run_open.read(summary)))


def markdown_open(solution: OpenSolution, summary: Any) -> str:
    return markdown_sections(
        summary, open_sections(solution, run_open.read(summary)), open_cost(run_open.read(summary))
    )


def use_solver(monkeypatch: pytest.MonkeyPatch, *, reasons: tuple[str, ...] = ()) -> None:
    """Let arbitrary numbers stand for a solution."""

    def solve_open(scene: TankScene, comm: MPI.Comm, report: Any) -> OpenSolution:
        report("solving")
        return arbitrary_solution(scene, reasons=reasons)

    solver = types.ModuleType("hydroelastic.scenes.open_water.solve")
    solver.solve_open = solve_open  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, solver.__name__, solver)
    monkeypatch.delitem(sys.modules, "hydroelastic.scenes.open_water.run", raising=False)


def test_a_run_writes_its_folder(scene_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use_solver(monkeypatch)
    result = CliRunner().invoke(main, ["run", str(scene_file)])
    assert result.exit_code == 0, result.output
    assert "Radiation by heave" in result.stdout
    folder = Path("results/circle")
    files = ["dataset.nc", "images", "manifest.json", "radiation.csv", "summary.json", "summary.md"]
    assert sorted(path.name for path in folder.iterdir()) == files
    assert [path.name for path in (folder / "images").iterdir()] == ["radiation_1.png"]
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["scene"]["liquid"] == [{"density": 1000.0, "depth": "inf"}]
    assert {"import", "write", "draw"} <= summary["timing"].keys()
    # A previous result folder is replaced.
    again = CliRunner().invoke(main, ["run", str(scene_file), "--no-images", "--quiet"])
    assert (again.exit_code, again.output) == (0, "")
    assert not (folder / "images").exists()


def test_a_run_that_falls_short_ends_with_3(scene_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use_solver(monkeypatch, reasons=("it is not good enough",))
    result = CliRunner().invoke(main, ["run", str(scene_file), "--no-images"])
    assert result.exit_code == 3
    assert "NOT CONVERGED" in result.stdout
    assert json.loads(Path("results/circle/summary.json").read_text(encoding="utf-8"))["status"] == "unconverged"


def test_a_folder_appears_whole_or_not_at_all(scene_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use_solver(monkeypatch)
    import hydroelastic.scenes.open_water.run as open_run

    def refuse(*_arguments: Any) -> None:
        raise RuntimeError("no pen")

    def sample(solution: OpenSolution, _summary: Any) -> Any:
        return open_run.SampledWater(solution=solution, fields=(), missing=(), plans=())

    monkeypatch.setattr(open_run, "run_open", replace(open_run.run_open, sample=sample, draw=refuse))
    with pytest.raises(RuntimeError, match="no pen"):
        run_scene(open_scene(), out=Path("results/circle"))
    assert not Path("results").exists()


def test_bad_input_ends_with_2_and_one_message(scene_file: Path) -> None:
    result = CliRunner().invoke(main, ["run", str(scene_file), "--set", "analysis.1.omega=[-1]"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "entry 1 = -1: it is too small" in result.stderr


@pytest.mark.parametrize("command", ["compare", "study"])
def test_what_is_for_closed_tanks_is_refused(scene_file: Path, command: str) -> None:
    result = CliRunner().invoke(main, [command, str(scene_file)])
    assert (result.exit_code, result.stdout) == (2, "")
    assert '[tank], key "ends" = "open"' in result.stderr
    assert "closed tanks" in result.stderr


def test_python_refuses_the_same() -> None:
    for refused in (compare_tank, study_scene):
        with pytest.raises(SceneError, match="closed tanks"):
            refused(open_scene())  # type: ignore[operator]


def test_a_spectrum_of_a_beam_without_points_is_written_and_printed(tmp_path: Path) -> None:
    """No response has a column, and the mean drift force is told with the loads."""
    sea = {"kind": "spectrum", "significant_height": 1.0, "peak_period": 6.0, "highest_omega": 1.5}
    scene = open_scene(
        {"length": 20.0, "flexural_rigidity": 1e8, "mass_per_length": 500.0, "start": 0.0},
        liquids=({"density": 1000.0, "depth": 5.0},),
        length=20.0,
        analyses=[sea],
        accuracy={"tolerance": 0.05},
    )
    solution = solve_open(scene, MPI.COMM_WORLD, lambda _message: None)
    write_open_csv(solution, tmp_path)
    assert len(rows_of(tmp_path / "spectrum.csv")) == len(solution.spectrum[0].omega)
    assert "Mean drift force" in printed_open(solution, summary_of(solution))
