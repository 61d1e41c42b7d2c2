"""Fields of open water: the conditions that they keep, what they say of waves beside the tables, their files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
from mpi4py import MPI
from open_cases import DENSITY, GRAVITY, RADIUS, circle, problem_of
from open_tables import open_scene
from PIL import Image

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_samples import SampledField, sample_field
from hydroelastic.fem.open_water.fields import OpenField, open_fields
from hydroelastic.fem.open_water.resonance_search import ResonanceSearch
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.output.pictures.gif import FRAMES
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.scenes.models.open_analyses import Radiation, Resonance
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.field_files import write_fields
from hydroelastic.scenes.open_water.field_pictures import draw_fields
from hydroelastic.scenes.open_water.physics import open_water_problem
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.open_water.solve import solve_open

# Fields are solved for to 1e-3 of their energies. Measured at nodes, elevations are off by 1e-6 here, gradients at the
# surface, where they are least accurate, by 3e-2 of the largest.
VALUES, SLOPES = 1e-4, 5e-2
DEPTH = 1.1


def fields_of(solution: OpenSolution, comm: MPI.Comm = MPI.COMM_WORLD) -> Iterator[OpenField]:
    for _, fields in open_fields(open_water_problem(solution.scene, comm, Stopwatch()), solution):
        yield from fields


def solved(scene: TankScene) -> tuple[OpenSolution, list[SampledField]]:
    """Return the tables of a scene, and its fields on rank 0."""
    comm = MPI.COMM_WORLD
    solution = solve_open(scene, comm, lambda _message: None)
    fields = [sample_field(field) for field in fields_of(solution, comm)]
    return solution, [field for field in fields if field is not None]


def floating_plate(waves_from: str, start: float = 4.0) -> TankScene:
    body = {"kind": "beam", "start": start, "length": 6.0, "flexural_rigidity": 471.0, "mass_per_length": 8.36}
    return open_scene(
        body,
        liquids=({"density": DENSITY, "depth": DEPTH},),
        length=20.0,
        analyses=[{"kind": "response", "omega": [2.0, 4.0], "waves_from": waves_from}],
        accuracy={"tolerance": 1e-4},
    )


@pytest.fixture(scope="module")
def radiated() -> tuple[OpenSolution, list[SampledField]]:
    scene = circle(1e-3, "heave", "sway", liquids=({"density": DENSITY, "depth": DEPTH},))
    return solved(scene.model_copy(update={"analysis": (Radiation(omega=(3.0, 4.43)),)}))


@pytest.fixture(scope="module")
def resonant() -> tuple[OpenSolution, list[SampledField]]:
    scene = circle(1e-3, "heave", "sway")
    return solved(scene.model_copy(update={"analysis": (Resonance(),)}))


def elevation(field: SampledField, near: float) -> tuple[float, complex]:
    """The drawn point of a free surface next to an abscissa of the scene, and the complex elevation there."""
    found = []
    for real, imaginary in zip(field.picture.real.surfaces, field.picture.imaginary.surfaces, strict=True):
        if real.kind != "body":
            x = real.x + field.picture.real.start
            place = int(np.argmin(np.abs(x - near)))
            value = complex(real.displacement[place], imaginary.displacement[place])
            found.append((abs(x[place] - near), float(x[place]), value))
    _, x, value = min(found)
    return x, value


def free_surface_residual(field: SampledField, body: tuple[float, float]) -> float:
    """Largest |∂ψ/∂y − ω²ψ/g| on the still level beside a body, as a part of the largest ∂ψ/∂y."""
    x, y = field.points.T
    there = (np.abs(y) < 1e-9) & ((x < body[0]) | (x > body[1]))
    upwards = field.displacement[there, 1]
    residual = upwards - field.omega**2 / GRAVITY * field.potential[there]
    return float(np.abs(residual).max() / np.abs(upwards).max())


@pytest.mark.slow_but("left")
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("waves_from", ["left", "right"])
def test_a_response_is_the_wave_that_comes_and_those_that_leave(waves_from: str) -> None:
    solution, fields = solved(floating_plate(waves_from))
    table = solution.response[0]
    for field in fields:
        row = int(np.argmax(np.abs(table.amplitudes[:, 0]).max(axis=1)))
        assert field.omega == pytest.approx(table.omega[row])
        sign = 1.0 if waves_from == "left" else -1.0
        wavenumber = sign * table.wavenumbers[row, 0]
        x, ahead = elevation(field, 19.7 if sign > 0 else 0.3)
        assert ahead == pytest.approx(table.transmission[row, 0, 0] * np.exp(1j * wavenumber * x), abs=VALUES)
        x, behind = elevation(field, 0.3 if sign > 0 else 19.7)
        reflected = table.reflection[row, 0, 0] * np.exp(-1j * wavenumber * x)
        assert behind == pytest.approx(np.exp(1j * wavenumber * x) + reflected, abs=VALUES)
        assert free_surface_residual(field, (3.9, 10.1)) < SLOPES
        bed = np.abs(field.points[:, 1] + DEPTH) < 1e-9
        assert np.abs(field.displacement[bed, 1]).max() < SLOPES
        (plate,) = (curve for curve in field.picture.real.surfaces if curve.kind == "body")
        deflection = np.interp(table.plates[0].positions, plate.x, plate.displacement)
        # Linear between drawn points: (kh)²/8 with h = 0.03 m.
        assert deflection == pytest.approx(table.plates[0].deflection[row, 0].real, abs=1e-3)


def test_phases_are_counted_from_the_origin_of_the_scene() -> None:
    """The picture of a plate that begins there begins before it."""
    solution, (field,) = solved(floating_plate("left", start=0.0))
    table = solution.response[0]
    row = int(np.argmax(np.abs(table.amplitudes[:, 0]).max(axis=1)))
    assert field.points[:, 0].min() < -0.1
    x, ahead = elevation(field, 19.7)
    wave = np.exp(1j * table.wavenumbers[row, 0] * x)
    assert ahead == pytest.approx(table.transmission[row, 0, 0] * wave, abs=VALUES)


def test_radiated_fields_are_those_of_the_frequencies_asked_for(
    radiated: tuple[OpenSolution, list[SampledField]],
) -> None:
    solution, ((first, *_), asked) = radiated[0], (radiated[1], 0.9)
    table = replace(solution.radiation[0], fields_at=(first.omega.real, asked * first.omega.real))
    fields = [sample_field(field) for field in fields_of(replace(solution, radiation=(table,)))]
    found = {field.name: field for field in fields if field is not None}
    assert list(found) == [f"radiation_1_{motion}_00{number}" for motion in ("heave", "sway") for number in (1, 2)]
    assert found["radiation_1_heave_002"].omega == pytest.approx(asked * first.omega)
    # The same field in a basin for other frequencies, and another one.
    same, other = (abs(elevation(found[f"radiation_1_heave_00{number}"], 9.0)[1]) for number in (1, 2))
    # Heights do not depend on which point is drawn next to a place.
    assert same == pytest.approx(abs(elevation(first, 9.0)[1]), rel=3e-3)
    assert abs(other / same - 1.0) > 0.02


def test_radiated_waves_carry_the_power_of_damping(radiated: tuple[OpenSolution, list[SampledField]]) -> None:
    solution, fields = radiated
    table = solution.radiation[0]
    assert [field.name for field in fields] == ["radiation_1_heave", "radiation_1_sway"]
    for motion, field in enumerate(fields):
        row = int(np.argmax(table.radiation_damping[:, motion, motion]))
        omega, damping, k = table.omega[row], table.radiation_damping[row, motion, motion], table.wavenumbers[row, 0]
        assert field.omega == pytest.approx(omega)
        group = 0.5 * omega / k * (1.0 + 2.0 * k * DEPTH / np.sinh(2.0 * k * DEPTH))
        amplitude = np.sqrt(damping * omega**2 / (2.0 * DENSITY * GRAVITY * group))
        (first, near), (second, far) = elevation(field, 8.5), elevation(field, 9.7)
        # Beside the wave there is e^{−πx/(2·1.1)} at the most, 1e-2 at 3 m and 1e-3 at 4.5 m from the circle.
        assert abs(far) == pytest.approx(amplitude, rel=3e-3)
        assert far / near == pytest.approx(np.exp(1j * k * (second - first)), abs=1e-2)
        assert free_surface_residual(field, (4.45, 5.55)) < SLOPES
        # A motion of 1 m: ∇ψ·n = n_y or n_x on the circle.
        arms = (field.points - [5.0, 0.0]) / RADIUS
        normals = arms[np.abs(np.hypot(*arms.T) - 1.0) < 1e-6]
        outwards = (field.displacement[np.abs(np.hypot(*arms.T) - 1.0) < 1e-6] * normals).sum(axis=1)
        assert outwards == pytest.approx(normals[:, 1 - motion], abs=SLOPES)


@pytest.mark.slow
def test_a_resonance_sends_out_waves_that_were_larger_once(resonant: tuple[OpenSolution, list[SampledField]]) -> None:
    solution, (field, *_) = resonant
    omega = complex(solution.resonance[0].omega[0])
    assert field.omega == pytest.approx(omega, rel=1e-3)
    assert omega.imag < 0.0
    assert free_surface_residual(field, (4.45, 5.55)) < SLOPES
    k = omega**2 / GRAVITY
    for near, far in ((9.0, 9.9), (1.0, 0.1)):
        (first, one), (second, other) = elevation(field, near), elevation(field, far)
        assert abs(other) > abs(one)
        # What is no wave falls off like 1/x² in deep water: measured, 3e-3 at nine radii.
        assert other / one == pytest.approx(np.exp(1j * k * abs(second - first)), abs=1e-2)
    # The circle heaves by 1 m.
    (section,) = field.picture.real.floats
    assert section.displacement[:, 1] == pytest.approx(1.0)


def test_fields_end_where_the_scene_says(radiated: tuple[OpenSolution, list[SampledField]]) -> None:
    for field in radiated[1]:
        assert field.points.min(axis=0) == pytest.approx([0.0, -DEPTH], abs=1e-9)
        assert field.points.max(axis=0) == pytest.approx([10.0, 0.0], abs=1e-9)
        assert field.picture.real.goes_on == {"sides"}


def test_files_hold_both_parts(radiated: tuple[OpenSolution, list[SampledField]], tmp_path: Path) -> None:
    field = radiated[1][0]
    write_fields((field,), tmp_path / "fields")
    mesh = meshio.read(tmp_path / "fields" / "radiation_1_heave.vtu")
    assert mesh.points[:, :2] == pytest.approx(field.points)
    data = mesh.point_data
    for name, values in (("potential", field.potential), ("pressure", field.pressure)):
        assert data[f"{name}_real"] + 1j * data[f"{name}_imaginary"] == pytest.approx(values)
        assert data[f"{name}_magnitude"] == pytest.approx(np.abs(values))
    assert data["displacement_real"][:, :2] == pytest.approx(field.displacement.real)
    assert data["displacement_magnitude"] == pytest.approx(np.hypot(*np.abs(field.displacement).T))
    assert field.pressure == pytest.approx(DENSITY * field.omega**2 * field.potential)
    write_fields((), tmp_path / "none")
    assert not (tmp_path / "none").exists()


@pytest.mark.slow
def test_pictures_and_animations(radiated: tuple[OpenSolution, list[SampledField]], tmp_path: Path) -> None:
    draw_fields(radiated[1][:1], tmp_path, PictureOptions(width=800, animate=True))
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "waves_radiation_1_heave.gif",
        "waves_radiation_1_heave.png",
    ]
    with Image.open(tmp_path / "waves_radiation_1_heave.gif") as gif:
        assert (gif.n_frames, gif.width) == (FRAMES, 400)


def test_a_wave_at_parts_of_its_period(radiated: tuple[OpenSolution, list[SampledField]]) -> None:
    wave = radiated[1][0].picture
    start, quarter, half = wave.at(0.0), wave.at(0.25), wave.at(0.5)
    assert start.potential == pytest.approx(wave.real.potential)
    # e^{−iωt}: a quarter of a period later the imaginary part is real.
    assert quarter.potential == pytest.approx(wave.imaginary.potential)
    assert half.potential == pytest.approx(-wave.real.potential)
    parts = np.linspace(0.0, 1.0, 64)
    reached = np.max([np.abs(wave.at(part).potential) for part in parts], axis=0)
    largest = wave.largest.potential
    assert np.all(reached <= largest * (1.0 + 1e-12))
    # The largest of 64 instants misses by 1 − cos(π/64) at the most.
    assert reached == pytest.approx(largest, rel=2e-3)


def test_what_is_drawn_of_short_waves_is_shorter_and_holds_the_bodies() -> None:
    water = problem_of(circle(1e-3, "heave")).tank
    long, short = open_basin(water, 1.0, drawn=75.0), open_basin(water, 100.0, drawn=75.0)
    assert (long.origin, long.units.length) == pytest.approx((0.0, 10.0))
    assert (short.origin, short.units.length) == pytest.approx((4.5 - 0.75, 2.5))
    wide = open_basin(replace(water, length=5.0), 1.0, drawn=75.0)
    assert wide.origin + wide.units.length > 5.5


@pytest.mark.slow
def test_waves_of_a_resonance_are_drawn_until_they_have_grown(
    resonant: tuple[OpenSolution, list[SampledField]],
) -> None:
    solution, _ = resonant
    tank = solution.scene.tank.model_copy(update={"length": 1000.0})
    far = replace(solution, scene=solution.scene.model_copy(update={"tank": tank}))
    for field in [sample_field(one) for one in fields_of(far)]:
        if field is not None:
            assert field.omega == pytest.approx(solution.resonance[0].omega[0], rel=1e-3)
            assert 8.0 < field.points[:, 0].max() < 12.0
            # By 12 from the body on, where it is smaller than beside it.
            assert abs(elevation(field, 12.0)[1]) < 12.0 * abs(elevation(field, 6.5)[1])


@pytest.mark.slow
def test_a_resonance_that_is_not_found_again_has_no_field(
    resonant: tuple[OpenSolution, list[SampledField]], monkeypatch: pytest.MonkeyPatch
) -> None:
    solution, _ = resonant
    table = replace(solution.resonance[0], omega=1.05 * solution.resonance[0].omega)
    assert list(fields_of(replace(solution, resonance=(table,)))) == []

    def fail(*_arguments: object) -> None:
        raise EigenSolverError("it does not settle")

    monkeypatch.setattr(ResonanceSearch, "refined", fail)
    assert list(fields_of(solution)) == []


@pytest.mark.slow
def test_a_field_that_fails_costs_no_numbers(
    resonant: tuple[OpenSolution, list[SampledField]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    solution, _ = resonant

    def failing(*_arguments: object) -> None:
        raise EigenSolverError("it does not converge")

    monkeypatch.setattr(ResonanceSearch, "__init__", failing)
    solved = replace(run_open, solve=lambda *_arguments: solution)
    outcome = solved(solution.scene, out=tmp_path / "result", images=None)
    assert outcome.warnings == ("no field of resonance 1: it does not converge",)
    assert (tmp_path / "result" / "summary.json").exists()
