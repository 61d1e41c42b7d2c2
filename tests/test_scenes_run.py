"""Runs from the scene to the folder: complete, readable, and consistent with the physics."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import xarray
from command import run_command

import hydroelastic as he

REFERENCE = json.loads((Path(__file__).parent / "reference" / "aquarium.json").read_text(encoding="utf-8"))
CASE = next(case for case in REFERENCE["cases"] if case["name"] == "base_s0")
MODES = 6
NUMBERS = range(1, MODES + 1)


@pytest.fixture(scope="module")
def result() -> he.Result:
    return he.solve(he.read("aquarium", {"accuracy.modes": MODES, "accuracy.tolerance": 1e-8}))


@pytest.fixture(scope="module")
def folder(result: he.Result, tmp_path_factory: pytest.TempPathFactory) -> Path:
    saved = tmp_path_factory.mktemp("run") / "result"
    result.save(saved, images=None)
    return saved


@pytest.fixture(scope="module")
def fields(folder: Path) -> meshio.Mesh:
    return meshio.read(folder / "fields" / "modes.vtu")


@pytest.fixture(scope="module")
def dataset(folder: Path) -> xarray.Dataset:
    return xarray.load_dataset(folder / "dataset.nc")


def read_summary(folder: Path) -> dict[str, Any]:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    content: dict[str, Any] = json.loads((folder / "summary.json").read_text("utf-8"), parse_constant=refuse)
    return content


def test_the_folder_holds_what_was_asked_and_no_more(folder: Path) -> None:
    files = {"summary.json", "summary.md", "modes.csv", "dataset.nc", "fields"}
    assert {path.name for path in folder.iterdir()} == files
    assert [path.name for path in folder.parent.iterdir()] == ["result"]


def test_the_summary_has_every_key_of_the_contract(result: he.Result, folder: Path) -> None:
    summary = read_summary(folder)
    assert summary.keys() >= {"scene", "versions", "size", "seconds", "modes", "first_elastic", "estimates", "status"}
    for mode in summary["modes"]:
        assert mode.keys() >= {"omega", "frequency_hz", "relative_error", "kind", "elastic_energy_fraction"}
    tone = {"omega", "relative_error", "index", "participation", "runner_up", "added_mass_per_length", "dry_omega"}
    assert summary["first_elastic"].keys() >= tone | {"pressure_release_omega"}
    assert summary["estimates"].keys() >= {"grammel_1", "grammel_n", "rayleigh", "deep_water"}
    assert (summary["status"], summary["reasons"]) == ("ok", [])
    assert summary["scene"] == result.scene.model_dump(mode="json")


def test_the_summary_is_the_reference_solution(folder: Path) -> None:
    summary = read_summary(folder)
    omega = np.array([mode["omega"] for mode in summary["modes"]])
    # The tolerance asked is 1e-8.
    assert omega == pytest.approx(CASE["omega"][:MODES], rel=1e-8)
    assert [mode["frequency_hz"] for mode in summary["modes"]] == pytest.approx(omega / (2 * np.pi), rel=1e-15)
    # An energy share errs like the product of the amplitude errors in and beside the beam; measured 2e-9.
    fractions = [mode["elastic_energy_fraction"] for mode in summary["modes"]]
    assert fractions == pytest.approx(CASE["f_strain"][:MODES], abs=1e-8)
    tone, expected = summary["first_elastic"], CASE["elastic1"]
    assert tone["index"] == expected["index"]
    assert tone["dry_omega"] == pytest.approx(CASE["omega_dry"][0], rel=1e-13)
    assert tone["added_mass_per_length"] == pytest.approx(expected["added_mass_hs"], rel=4e-8)
    assert tone["pressure_release_omega"] == pytest.approx(CASE["psi0"]["elastic_omega"], rel=1e-8)
    assert summary["zero_modes"] == 1
    # Strain energies of the reference are 0.48 at most: the water holds more in each.
    assert {mode["kind"] for mode in summary["modes"]} == {"sloshing"}


def test_a_soft_beams_tone_is_called_elastic() -> None:
    (mode,) = he.solve(he.read("soft_beam", {"accuracy.modes": 1, "accuracy.tolerance": 1e-4})).summary["modes"]
    assert mode["kind"] == "elastic"


def test_the_table_has_all_modes_at_full_precision(folder: Path) -> None:
    rows = list(csv.DictReader((folder / "modes.csv").read_text("utf-8").splitlines()))
    modes = read_summary(folder)["modes"]
    assert [int(row["mode"]) for row in rows] == list(NUMBERS)
    for row, mode in zip(rows, modes, strict=True):
        for name in set(row) & set(mode):
            if isinstance(mode[name], float):
                assert float(row[name]) == mode[name], name
        assert {"omega", "frequency_hz", "relative_error", "elastic_energy_fraction"} <= set(row)


def test_the_readable_summary_names_the_tone_and_every_estimate(folder: Path) -> None:
    text = (folder / "summary.md").read_text("utf-8")
    assert "ω = 4.2305239" in text
    assert "First elastic tone: mode 5" in text
    assert all(f"| {name} |" in text for name in read_summary(folder)["estimates"])
    assert "NOT CONVERGED" not in text


def test_nothing_is_written_where_no_folder_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    he.solve(he.read("sloshing", {"accuracy.modes": 1, "accuracy.tolerance": 1e-3}))
    assert list(tmp_path.iterdir()) == []


def test_a_run_prints_its_table_and_writes_the_folder(tmp_path: Path) -> None:
    given = ("--set", "title=A small run", "--set", "accuracy.modes=2", "--set", "accuracy.tolerance=1e-4")
    result = run_command("run", "sloshing", *given, "--out", str(tmp_path / "result"), "--no-images")
    assert result.exit_code == 0, result.output
    assert "A small run" in result.output
    assert "rad/s" in result.output
    # The frequencies, to the digits that are certain.
    for mode in read_summary(tmp_path / "result")["modes"]:
        assert f"{mode['omega']:.3f}" in result.output
        assert f"{mode['relative_error']:.1e}" in result.output
    assert f"Results written to {tmp_path / 'result'}/" in " ".join(result.output.split())


def test_any_title_reaches_every_file(tmp_path: Path) -> None:
    """Signs of Markdown, of HTML and of formulas, from the scene to the last file."""
    from html import unescape
    from re import findall, sub

    from markdown_it import MarkdownIt

    title = r"*a* | <b> # [x](y) $\\frac{1}$ and $2 [red]no colour[/red] :smile:"
    result = he.solve(he.read("swell", {"title": title}))
    result.save(tmp_path / "result")
    html = MarkdownIt("commonmark").render((tmp_path / "result" / "summary.md").read_text(encoding="utf-8"))
    assert unescape(sub("<[^>]*>", "", findall("<h1>(.*)</h1>", html)[0])) == title
    assert title in " ".join(str(result).split())


# --- the fields


def on_the_top(fields: meshio.Mesh, start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Which points lie on y = 0 between two abscissae, and their x."""
    x, y, _ = fields.points.T
    (chosen,) = np.nonzero((np.abs(y) < 1e-12) & (x > start) & (x < end))
    assert len(chosen) > 10
    return chosen, x[chosen]


@pytest.mark.parametrize("number", NUMBERS)
def test_the_water_rises_by_its_potential_and_by_its_gradient(folder: Path, fields: meshio.Mesh, number: int) -> None:
    """∂ψ/∂y = ω²ψ/g on the free surface, away from the tips where both become singular."""
    omega = read_summary(folder)["modes"][number - 1]["omega"]
    for start, end in ((0.0, 2.5), (7.5, 10.0)):
        chosen, _ = on_the_top(fields, start, end)
        rise = fields.point_data[f"displacement_{number:03d}"][chosen, 1]
        elevation = omega**2 / 9.81 * fields.point_data[f"potential_{number:03d}"][chosen]
        # A gradient errs like the square root of its energy's relative error, 1e-8: 1e-4, as measured.
        assert np.abs(rise - elevation).max() <= 3e-4 * np.abs(elevation).max()


@pytest.mark.parametrize("number", NUMBERS)
def test_the_liquid_follows_the_beam(fields: meshio.Mesh, dataset: xarray.Dataset, number: int) -> None:
    """∂ψ/∂y = w on the body, its middle nine tenths."""
    chosen, x = on_the_top(fields, 3.2, 6.8)
    rise = fields.point_data[f"displacement_{number:03d}"][chosen, 1]
    deflection = dataset.deflection_of_body_1.sel(mode=number).values
    # Gradients again, and linear interpolation between 201 points, (κ·4/200)²/8: 7e-5. Measured 3e-4 and below.
    expected = np.interp(x, dataset.position_on_body_1, deflection)
    assert np.abs(rise - expected).max() <= 1e-3 * np.abs(deflection).max()
    # Both ends of an antisymmetric mode move as far, but for rounding: the largest displacement is upwards.
    assert deflection.max() == pytest.approx(np.abs(deflection).max(), rel=1e-9)


def test_walls_and_bottom_let_nothing_through(fields: meshio.Mesh) -> None:
    x, y, _ = fields.points.T
    for number in NUMBERS:
        moved = fields.point_data[f"displacement_{number:03d}"]
        largest = np.abs(moved).max()
        # ψ is smooth there, and the largest gradient is at a tip: measured 1e-7.
        assert np.abs(moved[y <= -5.0 + 1e-9, 1]).max() <= 1e-5 * largest
        assert np.abs(moved[(x <= 1e-9) | (x >= 10.0 - 1e-9), 0]).max() <= 1e-5 * largest


def test_shapes_have_a_generalized_mass_of_one_kilogram(folder: Path, dataset: xarray.Dataset) -> None:
    """Unit mass means a potential energy form of ω²; ρg∫η² is what bending leaves of it."""
    for number, mode in enumerate(read_summary(folder)["modes"], 1):
        potential = 0.0
        for side in (1, 2):
            wave = dataset[f"elevation_of_free_surface_{side}"].sel(mode=number).values
            potential += 1000.0 * 9.81 * np.trapezoid(wave**2, dataset[f"position_on_free_surface_{side}"].values)
        # The trapezoidal rule on 201 points.
        assert potential == pytest.approx((1.0 - mode["elastic_energy_fraction"]) * mode["omega"] ** 2, rel=3e-4)


@pytest.mark.parametrize("top", ["free", "rigid"])
def test_the_field_of_a_symmetric_tank_is_mirrored(top: str, tmp_path: Path) -> None:
    """Solved as halves: a mode and its mirror image are the same up to sign, on both sides of the middle."""
    changes = {"accuracy.modes": 3, "accuracy.tolerance": 1e-5, "tank.top": top}
    result = he.solve(he.read("aquarium", changes))
    data = result.dataset
    for mode in data.mode.values:
        shape, x = data.deflection_of_body_1.sel(mode=mode).values, data.position_on_body_1.values
        mirrored = np.interp(10.0 - x, x, shape)
        # Samples are linear between their points.
        sign = np.sign(np.dot(mirrored, shape))
        assert sign * mirrored == pytest.approx(shape, abs=1e-3 * np.abs(shape).max())
        symmetry = result.modes.symmetry[list(data.mode.values).index(mode)]
        assert sign == {"symmetric": 1.0, "antisymmetric": -1.0}[symmetry]
    result.save(tmp_path / "out", images=None)
    mesh = meshio.read(tmp_path / "out" / "fields" / "modes.vtu")
    left = mesh.points[:, 0] < 4.9
    for number in range(1, 4):
        flow = np.abs(mesh.point_data[f"displacement_{number:03d}"][:, 0])
        assert flow[left].max() == pytest.approx(flow[~left].max(), rel=0.05)


@pytest.mark.parametrize(("event", "written"), [("write_text", "summary.json"), ("mkdir", "fields")])
def test_ctrl_c_while_writing_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, event: str, written: str
) -> None:
    whole: Callable[..., Any] = getattr(Path, event)

    def interrupted(self: Path, *arguments: Any, **settings: Any) -> Any:
        if self.name == written:
            raise KeyboardInterrupt
        return whole(self, *arguments, **settings)

    result = he.solve(he.read("sloshing", {"accuracy.modes": 1, "accuracy.tolerance": 1e-3}))
    monkeypatch.setattr(Path, event, interrupted)
    with pytest.raises(KeyboardInterrupt):
        result.save(tmp_path / "made" / "result", images=None)
    assert list(tmp_path.iterdir()) == []
