"""Fields of open water: the conditions that they keep, what they say of waves beside the tables, as files hold them."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import meshio
import numpy as np
import pytest
from mpi4py import MPI
from open_cases import DENSITY, GRAVITY, RADIUS, answer, circle, open_scene

# Fields are solved for to 1e-3 of their energies. Measured at nodes, elevations of waves of 9 depths are off by 4e-6,
# gradients at the surface, where they are least accurate, by 3e-2 of the largest.
VALUES, SLOPES = 2e-5, 5e-2
DEPTH = 1.1


def fields_of(found: SimpleNamespace, folder: Path) -> dict[str, SimpleNamespace]:
    """Points, complex potential and displacement of each field that is written; of none on further ranks."""
    found.result.save(folder / "result", images=None)
    fields = {}
    for file in sorted((folder / "result" / "fields").glob("*.vtu")) if MPI.COMM_WORLD.rank == 0 else []:
        mesh = meshio.read(file)
        data = {key.removesuffix("_real"): mesh.point_data[key] for key in mesh.point_data if key.endswith("_real")}
        values = {key: real + 1j * mesh.point_data[f"{key}_imaginary"] for key, real in data.items()}
        if "potential" in values:
            values["displacement"] = values["displacement"][:, :2]
            fields[file.stem] = SimpleNamespace(points=mesh.points[:, :2], **values)
    return fields


def elevation(field: SimpleNamespace, omega: complex, near: float) -> tuple[float, complex]:
    """The point of the still level next to an abscissa, and the complex elevation ω²ψ/g there."""
    (level,) = np.nonzero(np.abs(field.points[:, 1]) < 1e-9)
    place = level[np.argmin(np.abs(field.points[level, 0] - near))]
    return float(field.points[place, 0]), complex(omega**2 / GRAVITY * field.potential[place])


def free_surface_residual(field: SimpleNamespace, omega: complex, body: tuple[float, float]) -> float:
    """Largest |∂ψ/∂y − ω²ψ/g| on the still level beside a body, as a part of the largest ∂ψ/∂y."""
    x, y = field.points.T
    there = (np.abs(y) < 1e-9) & ((x < body[0]) | (x > body[1]))
    upwards = field.displacement[there, 1]
    residual = upwards - omega**2 / GRAVITY * field.potential[there]
    return float(np.abs(residual).max() / np.abs(upwards).max())


def floating_plate(waves_from: str, start: float = 4.0) -> SimpleNamespace:
    body = {"kind": "beam", "start": start, "length": 6.0, "flexural_rigidity": 471.0, "mass_per_length": 8.36}
    scene = open_scene(body, liquids=[{"density": DENSITY, "depth": DEPTH}], length=20.0, tolerance=1e-4)
    return answer(scene, {"kind": "response", "omega": [2.0], "waves_from": waves_from})


@pytest.mark.slow_but("left-4.0")
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("start", [4.0, 0.0])
@pytest.mark.parametrize("waves_from", ["left", "right"])
def test_a_response_is_the_wave_that_comes_and_those_that_leave(waves_from: str, start: float, tmp_path: Path) -> None:
    """With phases from the origin of the scene, wherever the picture begins."""
    solution = floating_plate(waves_from, start)
    (table,) = solution.response
    for field in fields_of(solution, Path(MPI.COMM_WORLD.bcast(str(tmp_path)))).values():
        sign = 1.0 if waves_from == "left" else -1.0
        wavenumber = sign * table.wavenumbers[0, 0]
        # The picture of a plate at 0 ends 0.3 m before it, where 1e-3 of an evanescent wave is left (measured).
        right, left = (19.7, VALUES), (0.3, VALUES) if start else (-0.3, 1.5e-3)
        (place, left_over), (place_behind, left_behind) = (right, left) if sign > 0 else (left, right)
        x, ahead = elevation(field, table.omega[0], place)
        assert ahead == pytest.approx(table.transmission[0, 0, 0] * np.exp(1j * wavenumber * x), abs=left_over)
        x, behind = elevation(field, table.omega[0], place_behind)
        reflected = table.reflection[0, 0, 0] * np.exp(-1j * wavenumber * x)
        assert behind == pytest.approx(np.exp(1j * wavenumber * x) + reflected, abs=left_behind)
        assert free_surface_residual(field, table.omega[0], (start - 0.1, start + 6.1)) < SLOPES
        bed = np.abs(field.points[:, 1] + DEPTH) < 1e-9
        assert np.abs(field.displacement[bed, 1]).max() < SLOPES


def test_radiated_waves_carry_the_power_of_damping(tmp_path: Path) -> None:
    omega = 4.43
    scene = circle(1e-3, "heave", "sway", liquids=[{"density": DENSITY, "depth": DEPTH}])
    solution = answer(scene, {"kind": "radiation", "omega": [omega]})
    (table,), fields = solution.radiation, fields_of(solution, tmp_path)
    assert list(fields) == ["radiation_1_heave", "radiation_1_sway"]
    for motion, field in enumerate(fields.values()):
        damping, k = table.radiation_damping[0, motion, motion], table.wavenumbers[0, 0]
        group = 0.5 * omega / k * (1.0 + 2.0 * k * DEPTH / np.sinh(2.0 * k * DEPTH))
        amplitude = np.sqrt(damping * omega**2 / (2.0 * DENSITY * GRAVITY * group))
        (first, near), (second, far) = elevation(field, omega, 8.5), elevation(field, omega, 9.7)
        # Beside the wave there is e^{−πx/(2·1.1)} at the most, 1e-2 at 3 m and 1e-3 at 4.5 m from the circle.
        assert abs(far) == pytest.approx(amplitude, rel=3e-3)
        assert far / near == pytest.approx(np.exp(1j * k * (second - first)), abs=1e-2)
        assert free_surface_residual(field, omega, (4.45, 5.55)) < SLOPES
        # A motion of 1 m: ∇ψ·n = n_y or n_x on the circle.
        arms = (field.points - [5.0, 0.0]) / RADIUS
        on_body = np.abs(np.hypot(*arms.T) - 1.0) < 1e-6
        outwards = (field.displacement[on_body] * arms[on_body]).sum(axis=1)
        assert outwards == pytest.approx(arms[on_body, 1 - motion], abs=SLOPES)
        assert field.pressure == pytest.approx(DENSITY * omega**2 * field.potential)
        # Fields end where the scene says.
        assert field.points.min(axis=0) == pytest.approx([0.0, -DEPTH], abs=1e-9)
        assert field.points.max(axis=0) == pytest.approx([10.0, 0.0], abs=1e-9)


@pytest.mark.slow
def test_a_resonance_sends_out_waves_that_were_larger_once(tmp_path: Path) -> None:
    solution = answer(circle(1e-3, "heave", "sway"), {"kind": "resonance"})
    omega = complex(solution.resonance[0].omega[0])
    field = next(iter(fields_of(solution, tmp_path).values()))
    assert omega.imag < 0.0
    assert free_surface_residual(field, omega, (4.45, 5.55)) < SLOPES
    k = omega**2 / GRAVITY
    for near, far in ((9.0, 9.9), (1.0, 0.1)):
        (first, one), (second, other) = elevation(field, omega, near), elevation(field, omega, far)
        assert abs(other) > abs(one)
        # What is no wave falls off like 1/x² in deep water: measured, 3e-3 at nine radii.
        assert other / one == pytest.approx(np.exp(1j * k * abs(second - first)), abs=1e-2)


@pytest.mark.slow
def test_waves_of_a_resonance_are_drawn_until_they_have_grown(tmp_path: Path) -> None:
    solution = answer(circle(1e-3, "heave", "sway", length=1000.0), {"kind": "resonance"})
    for field, omega in zip(fields_of(solution, tmp_path).values(), solution.resonance[0].omega, strict=False):
        assert 8.0 < field.points[:, 0].max() < 12.0
        # By 12 from the body on, where it is smaller than beside it.
        assert abs(elevation(field, omega, 12.0)[1]) < 12.0 * abs(elevation(field, omega, 6.5)[1])
