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
from open_tables import ANALYSES, CIRCLE, DEEP, OIL, PLATE, arbitrary_solution, open_scene

from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.compare import compare_scene
from hydroelastic.scenes.dataset import open_dataset, write_dataset
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.model_analyses import Radiation, Response
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_csv import write_csv
from hydroelastic.scenes.open_figures import draw_open
from hydroelastic.scenes.open_radiation import solve_radiation
from hydroelastic.scenes.open_response import solve_response
from hydroelastic.scenes.open_results import OpenSolution
from hydroelastic.scenes.open_summary import json_ready, summarize_open
from hydroelastic.scenes.open_tables import MOST_ROWS, markdown_open, printed_open
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.stopwatch import Stopwatch
from hydroelastic.scenes.study import study_scene

FROM_BOTH_SIDES: list[dict[str, Any]] = [
    *ANALYSES,
    {"kind": "response", "omega": [2.0, 4.0], "waves_from": "right"},
]


def two_bodies(analyses: list[dict[str, Any]] = ANALYSES) -> OpenSolution:
    """A circle and a plate on two liquids with a free top: several dofs, two waves."""
    return arbitrary_solution(open_scene(CIRCLE, PLATE, liquids=(DEEP, OIL), analyses=analyses))


def summary_of(solution: OpenSolution) -> Summary:
    return summarize_open(solution, MPI.COMM_WORLD, import_seconds=1.0)


@pytest.fixture
def written(tmp_path: Path) -> xarray.Dataset:
    """The dataset of a circle in deep water, as a stranger opens it."""
    write_dataset(arbitrary_solution(open_scene()), tmp_path / "dataset.nc")
    return xarray.load_dataset(tmp_path / "dataset.nc")


def test_it_reads_like_a_dataset_of_capytaine(written: xarray.Dataset) -> None:
    table = arbitrary_solution(open_scene()).radiation[0]
    heave = written.added_mass.sel(radiating_dof="Heave", influenced_dof="Heave")
    assert heave.dims == ("omega",)
    np.testing.assert_array_equal(heave, table.added_mass[:, 0, 0])
    np.testing.assert_array_equal(
        written["radiation_damping"].sel(radiating_dof="Sway", influenced_dof="Heave"), table.radiation_damping[:, 0, 1]
    )
    real = written["excitation_force"].sel(complex="re")
    assert real.dims == ("omega", "wave_direction", "influenced_dof")
    np.testing.assert_array_equal(real, table.excitation_force[:, 0].real)
    np.testing.assert_array_equal(
        written["excitation_force"].sel(complex="im", wave_direction=np.pi, method=None, influenced_dof="Sway"),
        table.excitation_force[:, 0, 1, 1].imag,
    )
    assert written["wavenumber"].sel(omega=1.0) == pytest.approx(1.0 / 9.81, rel=1e-15)
    assert written["wavelength"].sel(omega=1.0) == pytest.approx(2.0 * np.pi * 9.81, rel=1e-15)
    assert (float(written["g"]), float(written["rho"]), float(written["water_depth"])) == (9.81, 1000.0, inf)
    assert str(written["body_name"].values) == "body_1"
    assert str(written["wave"].values) == "surface"


def test_capytaines_recipe_for_complex_numbers_and_motions_works(written: xarray.Dataset) -> None:
    """Its `merge_complex_values` and `rao`, in their own few lines: the equation of motion by labels."""
    force = written["excitation_force"].sel(complex="re") + 1j * written["excitation_force"].sel(complex="im")
    omega = written["omega"]
    impedance = (
        -(omega**2) * (written["inertia_matrix"] + written["added_mass"])
        - 1j * omega * written["radiation_damping"]
        + written["hydrostatic_stiffness"]
    ).transpose("omega", "radiating_dof", "influenced_dof")
    at = {"omega": 2.0, "wave_direction": 0.0}
    table = arbitrary_solution(open_scene()).radiation[0]
    expected = (
        -4.0 * (table.inertia + table.added_mass[2]) - 2.0j * table.radiation_damping[2] + table.stiffness
    ).T  # Capytaine puts the motion first
    np.testing.assert_allclose(impedance.sel(omega=2.0), expected, rtol=1e-15)
    np.testing.assert_allclose(
        force.sel(at)
        - (written["diffraction_force"].sel(complex="re") + 1j * written["diffraction_force"].sel(complex="im")).sel(
            at
        ),
        table.froude_krylov_force[2, 0, 0],
        rtol=0,
        atol=1e-15,
    )


def test_motions_in_waves_follow_from_the_dataset_of_radiation() -> None:
    """Radiation and response are solved apart, and meet in the equation of motion by the dataset's labels.

    An ellipse off the origin, with an off-centre mass to couple sway and roll; matrices and forces to 1e-6 each.
    """
    ellipse = CIRCLE | {"half_height": 0.4, "motions": ["heave", "sway", "roll"], "centre_of_mass": -0.1}
    analyses: list[dict[str, Any]] = [
        {"kind": "radiation", "omega": [3.0]},
        {"kind": "response", "omega": [3.0]},
        {"kind": "response", "omega": [3.0], "waves_from": "right"},
    ]
    scene = open_scene(ellipse, liquids=(DEEP, OIL), analyses=analyses)
    watch = Stopwatch()
    radiation, *responses = scene.analyses
    assert isinstance(radiation, Radiation)
    solution = replace(
        arbitrary_solution(scene),
        radiation=(solve_radiation(MPI.COMM_WORLD, scene, radiation, watch).table,),
        response=tuple(
            solve_response(MPI.COMM_WORLD, scene, response, watch).table
            for response in responses
            if isinstance(response, Response)
        ),
    )
    found = open_dataset(solution).sel(omega=3.0)
    impedance = (
        -9.0 * (found["inertia_matrix"] + found["added_mass"])
        - 3.0j * found["radiation_damping"]
        + found["hydrostatic_stiffness"]
    ).transpose("radiating_dof", "influenced_dof")
    for side in (0.0, np.pi):
        for wave in ("internal", "surface"):
            at = {"wave_direction": side, "wave": wave}
            force = found["excitation_force"].sel(at)
            expected = found["RAO"].sel(at).values
            # Rigid motions in SI: heave and sway in m, roll in rad, of like size here.
            motions = np.linalg.solve(impedance.values, force.values)
            np.testing.assert_allclose(motions, expected, rtol=0, atol=1e-5 * np.abs(expected).max())


def test_what_capytaine_has_no_name_for_is_there(written: xarray.Dataset) -> None:
    solution = arbitrary_solution(open_scene())
    response, resonance, decay = solution.response[0], solution.resonance[0], solution.decay[0]
    from_left = written.sel(omega=response.omega, wave_direction=0.0)
    np.testing.assert_array_equal(from_left["RAO"].sel(complex="im"), response.amplitudes[:, 0].imag)
    np.testing.assert_array_equal(
        from_left["transmission_coefficient"].sel(complex="re"), response.transmission[:, 0, 0].real
    )
    np.testing.assert_array_equal(
        from_left["reflection_coefficient"].sel(complex="im"), response.reflection[:, 0, 0].imag
    )
    assert np.isnan(written["RAO"].sel(omega=0.0)).all()
    np.testing.assert_array_equal(written["resonance_omega"].sel(complex="im"), resonance.omega.imag)
    assert list(written["resonance_motion"].values) == ["Heave", "Sway", "Heave", "Sway"]
    np.testing.assert_array_equal(written["decay_displacement"].sel(dof="Heave"), decay.displacement[:, 0])
    assert float(written["decay_tail"]) == decay.tail
    assert written.attrs["status"] == "ok"
    assert "exp(-i omega t)" in written.attrs["conventions"]


def test_several_bodies_waves_and_sides_have_their_labels(tmp_path: Path) -> None:
    solution = two_bodies(FROM_BOTH_SIDES)
    write_dataset(solution, tmp_path / "dataset.nc")
    found = xarray.load_dataset(tmp_path / "dataset.nc")
    radiation, (left, right) = solution.radiation[0], solution.response
    labels = ["body_1__Heave", "body_1__Sway", "body_2__Heave", "body_2__Pitch"]
    elastic = [f"body_2__Elastic {number}" for number in range(1, 5)]
    assert list(found.radiating_dof.values) == list(found.influenced_dof.values) == labels + elastic
    assert list(found.wave.values) == ["internal", "surface"]
    pair = found.added_mass.sel(radiating_dof="body_2__Pitch", influenced_dof="body_1__Sway")
    np.testing.assert_array_equal(pair.sel(omega=radiation.omega), radiation.added_mass[:, 1, 3])
    assert np.isnan(pair.sel(omega=4.0))
    rao = found["RAO"].sel(radiating_dof="body_1__Heave", wave="surface", complex="re")
    np.testing.assert_array_equal(rao.sel(omega=left.omega, wave_direction=0.0), left.amplitudes[:, 1, 0].real)
    np.testing.assert_array_equal(rao.sel(omega=right.omega, wave_direction=np.pi), right.amplitudes[:, 1, 0].real)
    into = found["reflection_coefficient"].sel(wave="surface", outgoing_wave="internal", complex="im")
    np.testing.assert_array_equal(into.sel(omega=left.omega, wave_direction=0.0), left.reflection[:, 1, 0].imag)
    bent = found["deflection_of_body_2"].sel(wave="internal", complex="re", wave_direction=np.pi)
    np.testing.assert_array_equal(bent.sel(omega=right.omega), right.plates[0].deflection[:, 0].real)
    np.testing.assert_array_equal(found["position_on_body_2"], np.linspace(1.0, 4.0, 101))
    assert (float(found["rho_above"]), float(found["depth_above"])) == (800.0, 1.0)
    np.testing.assert_array_equal(
        found["wavenumber"].sel(wave="internal", omega=radiation.omega), radiation.wavenumbers[:, 0]
    )


def test_several_resonance_analyses_are_numbered() -> None:
    analyses: list[dict[str, Any]] = [{"kind": "resonance"}, {"kind": "resonance", "count": 2}]
    found = open_dataset(arbitrary_solution(open_scene(analyses=analyses)))
    assert found["resonance_omega"].dims == ("analysis", "resonance")
    assert found["resonance_omega"].sel(analysis=2, resonance=2).item() == 2.0 - 0.2j
    assert np.isnan(found["resonance_omega"].sel(analysis=2, resonance=3).real)
    assert found["resonance_motion"].sel(analysis=2, resonance=3).item() == ""


@pytest.mark.parametrize("kind", range(4))
def test_each_analysis_may_stand_alone(tmp_path: Path, kind: int) -> None:
    solution = arbitrary_solution(open_scene(analyses=[ANALYSES[kind]]))
    write_dataset(solution, tmp_path / "dataset.nc")
    xarray.load_dataset(tmp_path / "dataset.nc")
    assert printed_open(solution, summary_of(solution))
    write_csv(solution, tmp_path)
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
    write_csv(solution, tmp_path)
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
    assert f"{MOST_ROWS} of 100 frequencies; all of them are in radiation.csv." in heave
    # Heading, rule, blank lines and what is said below; the ends of the sweep are always shown.
    assert sum(line.split()[-1:] == ["1.0e-07"] for line in heave.splitlines()) == MOST_ROWS
    shown = [line.split()[0] for line in heave.splitlines() if line.split()[-1:] == ["1.0e-07"]]
    assert (shown[0], shown[-1]) == ("0.1", "10")
    # Seven digits are certain to 1e-7.
    assert f"{solution.radiation[0].added_mass[0, 0, 0]:#.7g}" in heave
    assert "gives 4: as many as were found" in text
    assert "At last the motion let go is 0.002/t²" in text
    assert "20000 unknowns" in text


def test_tables_of_two_waves_fit_a_terminal() -> None:
    text = printed_open(two_bodies(), summary_of(two_bodies()), width=120)
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
    assert counts == {7}


def test_every_analysis_has_its_curves(tmp_path: Path) -> None:
    from PIL import Image

    draw_open(two_bodies(FROM_BOTH_SIDES), tmp_path)
    names = ["decay_1", "deflection_1_body_2", "deflection_2_body_2", "radiation_1", "resonance_1", "response_1"]
    assert sorted(path.stem for path in tmp_path.iterdir()) == [*names, "response_2"]
    for path in tmp_path.iterdir():
        with Image.open(path) as image:
            assert len(image.convert("L").resize((200, 100)).getcolors() or ()) > 10


SCENE = """
kind = "tank"
title = "Circle"
[tank]
length = 10.0
ends = "open"
[[liquid]]
density = 1000.0
depth = inf
[[body]]
kind = "float"
shape = "ellipse"
position = 5.0
half_width = 0.5
half_height = 0.5
[[analysis]]
kind = "radiation"
omega = [1.0, inf]
"""


@pytest.fixture
def scene_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene file in the current folder."""
    monkeypatch.chdir(tmp_path)
    for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "circle.toml").write_text(SCENE, encoding="utf-8")
    return tmp_path / "circle.toml"


def use_solver(monkeypatch: pytest.MonkeyPatch, *, reasons: tuple[str, ...] = ()) -> None:
    """Let arbitrary numbers stand for a solution."""

    def solve_open(scene: TankScene, comm: MPI.Comm, report: Any) -> OpenSolution:
        report("solving")
        return arbitrary_solution(scene, reasons=reasons)

    solver = types.ModuleType("hydroelastic.scenes.open_solve")
    solver.solve_open = solve_open  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, solver.__name__, solver)
    monkeypatch.delitem(sys.modules, "hydroelastic.scenes.open_run", raising=False)


def test_a_run_writes_its_folder(scene_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use_solver(monkeypatch)
    result = CliRunner().invoke(main, ["run", str(scene_file)])
    assert result.exit_code == 0, result.output
    assert "Radiation by heave" in result.stdout
    folder = Path("results/circle")
    files = ["dataset.nc", "images", "radiation.csv", "summary.json", "summary.md"]
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
    import hydroelastic.scenes.open_run as open_run

    def refuse(*_arguments: Any) -> None:
        raise RuntimeError("no pen")

    monkeypatch.setattr(open_run, "draw_open", refuse)
    with pytest.raises(RuntimeError, match="no pen"):
        run_scene(open_scene(), out=Path("results/circle"))
    assert not Path("results").exists()


def test_bad_input_ends_with_2_and_one_message(scene_file: Path) -> None:
    result = CliRunner().invoke(main, ["run", str(scene_file), "--set", "analysis.0.omega=[-1]"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "entry 1 = -1: it is too small" in result.stderr


@pytest.mark.parametrize("command", ["compare", "study"])
def test_what_is_for_closed_tanks_is_refused(scene_file: Path, command: str) -> None:
    result = CliRunner().invoke(main, [command, str(scene_file)])
    assert (result.exit_code, result.stdout) == (2, "")
    assert '[tank], key "ends" = "open"' in result.stderr
    assert "closed tanks" in result.stderr


def test_python_refuses_the_same() -> None:
    for refused in (compare_scene, study_scene):
        with pytest.raises(SceneError, match="closed tanks"):
            refused(open_scene())  # type: ignore[operator]
