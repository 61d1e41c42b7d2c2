"""Runs from the scene to the folder: complete, readable, consistent with the physics, and loud where not converged."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from click.testing import CliRunner, Result
from petsc4py import PETSc

from hydroelastic.fem import liquid_matrices
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.liquid_matrices import laplace_matrix
from hydroelastic.fem.tank.mode_shapes import ModeShapes, sample_shapes
from hydroelastic.output.outcome import Outcome
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.tank import shapes as shapes_module

SCENE = """
kind = "tank"
title = "A small run"
[tank]
length = 10.0
[[liquid]]
density = 1000.0
depth = 5.0
[accuracy]
"""
MODES = 6


@pytest.fixture(scope="module")
def outcome(tanks: Any, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """The case base_s0 without images."""
    scene = tanks.scene(tanks.beam(), modes=MODES, tolerance=1e-8)
    return run_scene(scene, out=tmp_path_factory.mktemp("run") / "result", images=None)


@pytest.fixture(scope="module")
def folder(outcome: Outcome) -> Path:
    assert outcome.folder is not None
    return outcome.folder


@pytest.fixture(scope="module")
def shapes(outcome: Outcome) -> ModeShapes:
    sampled = sample_shapes(outcome.solution.tank)
    assert sampled is not None
    return sampled


@pytest.fixture(scope="module")
def fields(folder: Path) -> meshio.Mesh:
    return meshio.read(folder / "fields" / "modes.vtu")


def read_summary(folder: Path) -> dict[str, Any]:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    content: dict[str, Any] = json.loads((folder / "summary.json").read_text("utf-8"), parse_constant=refuse)
    return content


def invoke(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


# --- the folder


def test_the_folder_holds_what_was_asked_and_no_more(folder: Path) -> None:
    assert {path.name for path in folder.iterdir()} == {
        "manifest.json",
        "summary.json",
        "summary.md",
        "modes.csv",
        "dataset.nc",
        "fields",
    }
    assert [path.name for path in folder.parent.iterdir()] == ["result"]


def test_the_summary_has_every_key_of_the_contract(folder: Path) -> None:
    summary = read_summary(folder)
    assert summary.keys() >= {"scene", "versions", "size", "timing", "memory_peak", "modes", "first_elastic"}
    assert summary.keys() >= {"estimates", "status"}
    assert summary["size"].keys() >= {"cells", "dofs", "degree"}
    for mode in summary["modes"]:
        assert mode.keys() >= {"omega", "frequency_hz", "relative_error", "kind", "elastic_energy_fraction"}
    tone = {"omega", "relative_error", "index", "participation", "runner_up", "added_mass_per_length", "dry_omega"}
    assert summary["first_elastic"].keys() >= tone | {"pressure_release_omega"}
    assert summary["estimates"].keys() >= {"grammel_1", "grammel_n", "rayleigh", "deep_water"}
    for estimate in summary["estimates"].values():
        assert estimate.keys() >= {"omega", "added_mass_per_length", "difference"}
    assert summary["status"] == "ok"
    assert summary["reasons"] == []


def test_the_summary_keeps_the_scene_with_its_defaults(outcome: Outcome, folder: Path) -> None:
    assert read_summary(folder)["scene"] == outcome.solution.scene.model_dump(mode="json")


def test_the_summary_is_the_reference_solution(tanks: Any, folder: Path) -> None:
    summary, case = read_summary(folder), tanks.cases["base_s0"]
    omega = [mode["omega"] for mode in summary["modes"]]
    # The tolerance asked is 1e-8.
    assert omega == pytest.approx(case["omega"][:MODES], rel=1e-8)
    assert [mode["frequency_hz"] for mode in summary["modes"]] == pytest.approx(
        np.array(omega) / (2 * np.pi), rel=1e-15
    )
    # An energy share errs like the product of the amplitude errors in and beside the beam; measured 2e-9.
    fractions = [mode["elastic_energy_fraction"] for mode in summary["modes"]]
    assert fractions == pytest.approx(case["f_strain"][:MODES], abs=1e-8)
    tone, expected = summary["first_elastic"], case["elastic1"]
    assert tone["index"] == expected["index"]
    assert tone["dry_omega"] == pytest.approx(case["omega_dry"][0], rel=1e-13)
    assert tone["added_mass_per_length"] == pytest.approx(expected["added_mass_hs"], rel=4e-8)
    assert tone["pressure_release_omega"] == pytest.approx(case["psi0"]["elastic_omega"], rel=1e-8)
    assert summary["zero_modes"] == 1


def test_modes_are_called_by_what_holds_their_energy(folder: Path) -> None:
    """The reference's strain energies are 0.02, 0.0004, 0.23, 0.002, 0.48 and 0.003: the water holds more in each."""
    assert {mode["kind"] for mode in read_summary(folder)["modes"]} == {"sloshing"}


def test_a_soft_beams_tone_is_called_elastic(tanks: Any) -> None:
    (mode,) = run_scene(tanks.case_scene("soft_s0", modes=1)).summary["modes"]
    assert mode["kind"] == "elastic"


def test_the_table_has_all_modes_at_full_precision(folder: Path) -> None:
    rows = list(csv.DictReader((folder / "modes.csv").read_text("utf-8").splitlines()))
    modes = read_summary(folder)["modes"]
    assert [int(row["mode"]) for row in rows] == list(range(1, MODES + 1))
    for row, mode in zip(rows, modes, strict=True):
        assert {name: float(row[name]) for name in ("omega", "relative_error")} == {
            name: mode[name] for name in ("omega", "relative_error")
        }


def test_the_readable_summary_names_the_tone_and_every_estimate(folder: Path) -> None:
    text = (folder / "summary.md").read_text("utf-8")
    assert "ω = 4.2305239" in text
    assert "First elastic tone: mode 5" in text
    for name in read_summary(folder)["estimates"]:
        assert f"| {name} |" in text
    assert "NOT CONVERGED" not in text


def test_nothing_is_written_where_no_folder_is_named(
    tanks: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run_scene(tanks.scene(modes=1, tolerance=1e-3)).folder is None
    assert list(tmp_path.iterdir()) == []


def test_images_are_drawn_when_asked(tanks: Any, tmp_path: Path) -> None:
    outcome = run_scene(tanks.scene(modes=1, tolerance=1e-3), out=tmp_path / "result")
    if outcome.warnings:
        pytest.skip(outcome.warnings[0])
    images = sorted((tmp_path / "result" / "images").iterdir())
    assert [path.name for path in images] == ["mode_001.png", "overview.png"]
    for path in images:
        assert path.read_bytes().startswith(b"\x89PNG")
        assert path.stat().st_size > 10_000


# --- the fields


def test_paraviews_reader_finds_every_mode(folder: Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    grid = pyvista.read(folder / "fields" / "modes.vtu")
    numbers = [f"{number:03d}" for number in range(1, MODES + 1)]
    assert set(grid.point_data) == {f"{kind}_{number}" for kind in ("potential", "displacement") for number in numbers}
    # Coordinates are in metres: a tank of 10 by 5.
    assert grid.bounds == pytest.approx((0, 10, -5, 0, 0, 0), abs=1e-12)
    assert grid.compute_cell_sizes()["Area"].sum() == pytest.approx(50.0, rel=1e-12)


def on_the_top(fields: meshio.Mesh, start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Which points lie on y = 0 between two abscissae, and their x."""
    x, y, _ = fields.points.T
    (chosen,) = np.nonzero((np.abs(y) < 1e-12) & (x > start) & (x < end))
    return chosen, x[chosen]


@pytest.mark.parametrize("number", range(1, MODES + 1))
def test_the_water_rises_by_its_potential_and_by_its_gradient(folder: Path, fields: meshio.Mesh, number: int) -> None:
    """∂ψ/∂y = ω²ψ/g on the free surface, away from the tips where both become singular."""
    omega = read_summary(folder)["modes"][number - 1]["omega"]
    for start, end in ((0.0, 2.5), (7.5, 10.0)):
        chosen, _ = on_the_top(fields, start, end)
        assert len(chosen) > 10
        rise = fields.point_data[f"displacement_{number:03d}"][chosen, 1]
        elevation = omega**2 / 9.81 * fields.point_data[f"potential_{number:03d}"][chosen]
        # A gradient errs like the square root of its energy's relative error, 1e-8: 1e-4, as measured.
        assert np.abs(rise - elevation).max() <= 3e-4 * np.abs(elevation).max()


@pytest.mark.parametrize("number", range(1, MODES + 1))
def test_the_liquid_follows_the_beam(fields: meshio.Mesh, shapes: ModeShapes, number: int) -> None:
    """∂ψ/∂y = w on the body, its middle nine tenths."""
    chosen, x = on_the_top(fields, 3.2, 6.8)
    assert len(chosen) > 10
    rise = fields.point_data[f"displacement_{number:03d}"][chosen, 1]
    (beam,) = [curve for curve in shapes.curves[number - 1] if curve.kind == "body"]
    expected = np.interp(x, beam.x, beam.displacement)
    # Gradients again, and linear interpolation between 201 points, (κ·4/200)²/8: 7e-5. Measured 3e-4 and below.
    assert np.abs(rise - expected).max() <= 1e-3 * np.abs(beam.displacement).max()


def test_walls_and_bottom_let_nothing_through(fields: meshio.Mesh) -> None:
    x, y, _ = fields.points.T
    for number in range(1, MODES + 1):
        moved = fields.point_data[f"displacement_{number:03d}"]
        largest = np.abs(moved).max()
        # ψ is smooth there, and the largest gradient is at a tip: measured 1e-7.
        assert np.abs(moved[y <= -5.0 + 1e-9, 1]).max() <= 1e-5 * largest
        assert np.abs(moved[(x <= 1e-9) | (x >= 10.0 - 1e-9), 0]).max() <= 1e-5 * largest


def test_every_mode_shows_its_largest_structural_displacement_upwards(shapes: ModeShapes) -> None:
    for curves in shapes.curves:
        (beam,) = [curve.displacement for curve in curves if curve.kind == "body"]
        # Both ends of an antisymmetric mode move as far, but for rounding.
        assert beam.max() == pytest.approx(np.abs(beam).max(), rel=1e-9)


def test_mirrored_surfaces_reach_from_end_to_end(tanks: Any) -> None:
    # Twins whose abscissae are no round numbers in binary.
    twins = [tanks.beam(start=start, length=0.57) for start in (0.46, 3.84)]
    scene = tanks.scene(*twins, length=4.87, depth=1.0, modes=3, tolerance=1e-4)
    whole = {(curve.kind, *curve.x[[0, -1]].round(9)) for curve in sample(tanks.solve(scene, halves=False)).curves[0]}
    halves = {(curve.kind, *curve.x[[0, -1]].round(9)) for curve in sample(tanks.solve(scene)).curves[0]}
    assert tanks.solve(scene).field.half
    assert halves == whole


@pytest.mark.parametrize("top", ["free", "rigid"])
def test_halves_give_the_fields_of_the_whole_tank(tanks: Any, top: str) -> None:
    scene = tanks.scene(tanks.beam(), top=top, modes=3)
    one, other = sample(tanks.solve(scene)), sample(tanks.solve(scene, halves=False))
    for number in range(3):
        for mine, theirs in zip(one.curves[number], other.curves[number], strict=True):
            expected = np.interp(mine.x, theirs.x, theirs.displacement)
            # Linear interpolation between samples; modes agree to 1e-6 and shapes to its root.
            assert mine.displacement == pytest.approx(expected, abs=5e-3 * np.abs(expected).max())
        # ∫|∇ψ|² by triangles: the same kinetic energy, and the same direction left and right of the middle.
        for sampled in (one.liquid, other.liquid):
            left = sampled.points[:, 0] < 4.9
            flow = sampled.displacement[number, :, 0]
            assert np.abs(flow[left]).max() == pytest.approx(np.abs(flow[~left]).max(), rel=0.05)


def sample(solution: Any) -> ModeShapes:
    shapes = sample_shapes(solution)
    assert shapes is not None
    return shapes


def test_mirrored_displacements_are_mirrored(tanks: Any) -> None:
    """∂ψ/∂x of the sampled points is that of the sampled ψ, on both sides of the middle."""
    liquid = sample(tanks.solve(tanks.scene(tanks.beam(), modes=2))).liquid
    corners = liquid.points[liquid.triangles]
    edges = corners[:, 1:] - corners[:, :1]
    large = np.abs(np.linalg.det(edges)) > 1e-4
    for number in range(2):
        rise = np.diff(liquid.potential[number][liquid.triangles[large]][:, [0, 1, 0, 2]], axis=1)[:, [0, 2]]
        slope = np.linalg.solve(edges[large], rise[:, :, None])[:, :, 0]
        mean = liquid.displacement[number][liquid.triangles[large]].mean(axis=1)
        # A plane through three points against the mean of three gradients: measured 0.07; a wrong sign gives 2.
        assert np.abs(slope - mean).max() <= 0.2 * np.abs(mean).max()


def test_without_a_body_the_largest_elevation_is_upwards(tanks: Any) -> None:
    sampled = sample_shapes(tanks.solve(tanks.scene()))
    assert sampled is not None
    for (water,) in sampled.curves:
        # Crests and troughs of an antisymmetric mode differ by rounding alone: the first of them counts.
        sizes = np.abs(water.displacement)
        assert water.displacement[np.argmax(sizes >= (1.0 - 1e-9) * sizes.max())] > 0.0


def test_shapes_have_a_generalized_mass_of_one_kilogram(folder: Path, shapes: ModeShapes) -> None:
    """Unit mass means a potential energy form of ω²; ρg∫η² is what bending leaves of it."""
    for curves, mode in zip(shapes.curves, read_summary(folder)["modes"], strict=True):
        waves = [curve for curve in curves if curve.kind == "free_surface"]
        assert len(waves) == 2
        potential = sum(1000.0 * 9.81 * np.trapezoid(curve.displacement**2, curve.x) for curve in waves)
        # The trapezoidal rule on 19 points an element; measured 5e-5.
        assert potential == pytest.approx((1.0 - mode["elastic_energy_fraction"]) * mode["omega"] ** 2, rel=3e-4)


# --- not converged


@pytest.fixture(scope="module")
def unconverged(tmp_path_factory: pytest.TempPathFactory) -> tuple[Result, Path]:
    """Sloshing to 1e-12, which the rounding of degree 10 does not allow."""
    folder = tmp_path_factory.mktemp("unconverged")
    scene = written(folder / "scene.toml", SCENE + "tolerance = 1e-12\nmodes = 4\n")
    return invoke("run", scene, "--out", folder / "result", "--no-images"), folder / "result"


def test_an_unconverged_run_ends_with_its_own_exit_code(unconverged: tuple[Result, Path]) -> None:
    assert unconverged[0].exit_code == 3, unconverged[0].output


def test_an_unconverged_run_says_so_everywhere(unconverged: tuple[Result, Path]) -> None:
    result, folder = unconverged
    summary = read_summary(folder)
    assert summary["status"] == "unconverged"
    assert any("above the tolerance 1e-12" in reason for reason in summary["reasons"])
    for text in (result.output, (folder / "summary.md").read_text("utf-8")):
        assert "NOT CONVERGED to the tolerance 1e-12" in text
        assert summary["reasons"][0] in " ".join(text.split())


def test_an_unconverged_run_still_gives_its_best_answer(unconverged: tuple[Result, Path]) -> None:
    for row, mode in zip(*(read_summary(unconverged[1])[name] for name in ("exact", "modes")), strict=True):
        assert abs(row["difference"]) <= mode["relative_error"] < 1e-9


# --- the command line


def test_a_run_prints_its_table_and_writes_the_folder(tmp_path: Path) -> None:
    scene = written(tmp_path / "scene.toml", SCENE + "tolerance = 1e-4\nmodes = 2\n")
    result = invoke("run", scene, "--out", tmp_path / "result", "--no-images")
    assert result.exit_code == 0, result.output
    assert "A small run" in result.output
    assert "sloshing" in result.output
    assert f"Results written to {tmp_path / 'result'}/" in " ".join(result.output.split())
    assert read_summary(tmp_path / "result")["status"] == "ok"


@pytest.mark.parametrize("broken", ["write_fields", "draw_all"])
def test_ctrl_c_while_writing_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, broken: str) -> None:
    def interrupted(*arguments: Any) -> None:
        folder = next(argument for argument in arguments if isinstance(argument, Path))
        folder.mkdir(exist_ok=True)
        (folder / "half").touch()
        raise KeyboardInterrupt

    monkeypatch.setattr(shapes_module, broken, interrupted)
    scene = written(tmp_path / "scene.toml", SCENE + "tolerance = 1e-3\nmodes = 1\n")
    with pytest.raises(KeyboardInterrupt):
        run_scene(read_scene(scene), out=tmp_path / "made" / "result")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


def test_a_matrix_that_is_not_positive_definite_ends_with_a_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(liquid: LiquidSpace) -> PETSc.Mat:
        matrix = laplace_matrix(liquid)
        matrix.zeroRowsColumns([matrix.size[0] // 2], diag=0.0)
        return matrix

    monkeypatch.setattr(liquid_matrices, "laplace_matrix", broken)
    result = invoke("run", written(tmp_path / "small.toml", SCENE), "--no-images", "--out", tmp_path / "out")
    assert result.exit_code == 3
    assert "the eigen-solver failed: a matrix of" in result.output
    assert "is not positive definite" in result.output
