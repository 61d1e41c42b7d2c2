"""Added mass, damping and excitation in open water: against other methods, closed forms, limits, and identities."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import (
    DENSITY,
    DISPLACED,
    RADIUS,
    THIN_LIQUIDS,
    TOO_SMALL,
    circle,
    circle_omega,
    complex_of,
    hydrodynamic,
    numbered,
    plate,
    radiation,
    section,
    slender,
    stored,
    thin_omega,
    two_liquids,
)
from open_plates import rigid_radiation
from open_two_liquids import TwoLiquids

from hydroelastic.fem.open_water import basin as open_basin
from hydroelastic.fem.open_water import model_building as open_model
from hydroelastic.fem.open_water.radiation import RadiationSolution
from hydroelastic.modal.floats.thin_float_radiation import thin_float_radiation
from hydroelastic.physics.profiles import float_profile

CIRCLE = stored("open_circle.json")["radiation"]
PUBLISHED = stored("open_water.json")["cylinder"]["rows"]
SECTIONS = stored("open_sections.json")["cases"]
TWO_LIQUIDS = stored("open_two_liquids.json")["cases"]
PLATES = stored("open_plates.json")["plates"]

# Measured, at most: 26 on circles, 32 on plates between two liquids.
TOO_LARGE = 60.0


def circle_matrix(solution: RadiationSolution) -> np.ndarray:
    """a' + ib' of heave and sway, shape (frequencies, 2, 2)."""
    order = [solution.table.dofs.index(motion) for motion in ("heave", "sway")]
    return hydrodynamic(solution)[:, order][:, :, order] / DISPLACED


def exact_circle(row: dict[str, Any]) -> np.ndarray:
    return np.array([complex(row["heave_a"], row["heave_b"]), complex(row["sway_a"], row["sway_b"])])


@pytest.mark.slow_but("Ka=1.8-1e-06")
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("row", CIRCLE, ids=lambda row: f"Ka={row['Ka']}")
def test_circle(row: dict[str, Any], tolerance: float) -> None:
    solution = radiation(circle(tolerance), circle_omega(row["Ka"]))
    found, exact = circle_matrix(solution)[0], exact_circle(row)
    errors = np.abs(np.diag(found) - exact) / np.abs(exact)
    assert errors.max() <= tolerance
    estimate = float(solution.table.relative_error[0])
    assert estimate <= tolerance
    # The reference is right to 3e-12.
    assert errors.max() <= TOO_SMALL * estimate + 3e-12
    assert estimate <= TOO_LARGE * errors.max()
    # Heave and sway of what is its own mirror image do not know each other.
    assert abs(found[0, 1]) <= tolerance * np.abs(exact).max()


@pytest.mark.slow
@pytest.mark.parametrize("row", PUBLISHED, ids=lambda row: f"Ka={row['Ka']}")
def test_circle_as_published(row: dict[str, Any]) -> None:
    found = np.diag(circle_matrix(radiation(circle(1e-6), circle_omega(row["Ka"])))[0])
    # The rows are right to 1e-6, absolutely; added mass and damping of heave are up to 4.
    np.testing.assert_allclose(found, exact_circle(row), rtol=1e-6, atol=2e-6)


@pytest.mark.slow
def test_circle_in_the_limits() -> None:
    table = radiation(circle(1e-6), 0.0, math.inf, circle_omega(1.0)).table
    heave, sway = (table.dofs.index(motion) for motion in ("heave", "sway"))
    limit = table.added_mass[1] / DISPLACED
    # ψ = 0 on the water: of a doubled circle in unbounded water, and 4/π².
    assert limit[heave, heave] == pytest.approx(1.0, abs=1e-6)
    assert limit[sway, sway] == pytest.approx(4.0 / math.pi**2, abs=1e-6)
    assert table.infinite_frequency_added_mass is not None
    np.testing.assert_array_equal(table.infinite_frequency_added_mass, table.added_mass[1])
    # A rigid lid: heave has no limit, sway is that of the doubled circle; it tends to it like Ka ln Ka, Ka = 5e-8 here.
    assert table.added_mass[0, heave, heave] == math.inf
    assert table.added_mass[0, sway, sway] / DISPLACED == pytest.approx(1.0, abs=1e-5)
    assert not table.radiation_damping[:2].any()
    assert not table.excitation_force[1].any()
    # Very long waves lift the float with the water: ρg 2a; the rest is of the order √(Ka) for sway, Ka ln Ka for heave.
    still = table.excitation_force[0, 0] / (DENSITY * 9.81 * 2.0 * RADIUS)
    np.testing.assert_allclose(still[:, heave], 1.0, rtol=0, atol=1e-4)
    assert np.abs(still[:, sway]).max() < 1e-4


@pytest.mark.slow
def test_added_mass_of_long_waves_grows_like_their_logarithm() -> None:
    numbers = np.array([1e-4, 1e-3])
    matrices = circle_matrix(radiation(circle(1e-6), *map(circle_omega, numbers)))
    sums = matrices[:, 0, 0].real + 8.0 / math.pi**2 * np.log(numbers)
    # Rows of the reference differ by as much from each other: the next term is Ka ln Ka.
    expected = [row["heave_a"] + 8.0 / math.pi**2 * math.log(row["Ka"]) for row in CIRCLE[:2]]
    np.testing.assert_allclose(sums, expected, rtol=0, atol=1e-5)
    assert sums[0] == pytest.approx(sums[1], abs=0.03)
    # b/ω of a source on the surface of deep water: (2a)²ρ.
    assert matrices[0, 0, 0].imag * DISPLACED == pytest.approx(4.0 * DENSITY * RADIUS**2, rel=2e-3)


def section_matrix(solution: RadiationSolution) -> tuple[np.ndarray, np.ndarray]:
    """H and the excitation from the left in the order of the stored rows."""
    order = [solution.table.dofs.index(motion) for motion in ("sway", "heave", "roll")]
    return hydrodynamic(solution)[0][np.ix_(order, order)], solution.table.excitation_force[0, 0, 0][order]


@pytest.mark.slow_but("5-1e-06")
@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
@pytest.mark.parametrize("row", numbered(SECTIONS))
def test_sections(row: dict[str, Any], tolerance: float) -> None:
    position = 4.0
    solution = radiation(section(row, tolerance, position), row["omega"])
    table = solution.table
    found, force = section_matrix(solution)
    exact = np.array(row["added_mass"]) + 1j * np.array(row["damping"]) / row["omega"]
    scale = np.sqrt(np.abs(np.outer(np.diag(exact), np.diag(exact))))
    error = np.abs((found - exact) / scale).max()
    assert error <= tolerance
    assert table.relative_error[0] <= tolerance
    assert error <= TOO_SMALL * table.relative_error[0] + row["error"]
    # The wave of the reference is e^{ikx} from the middle of the float, that of the scene from x = 0.
    expected = complex_of(row["excitation"]) * np.exp(1j * table.wavenumbers[0, 0] * position)
    np.testing.assert_allclose(force, expected, rtol=2.0 * tolerance)
    # Waves that leave carry what the motions lose; the far field is less accurate than the forces, but not by much.
    assert table.energy_residual[0] <= tolerance
    # Both sides are integrals over the same discrete field.
    assert table.haskind_residual[0] <= 1e-10


@pytest.mark.slow_but("8")
@pytest.mark.parametrize("row", SECTIONS[6:], ids=(7, 8))
def test_matrices_of_radiation(row: dict[str, Any]) -> None:
    table = radiation(section(row, 1e-4), 0.7 * row["omega"], row["omega"]).table
    for added, damping in zip(table.added_mass, table.radiation_damping, strict=True):
        # The discrete operator is symmetric; rounding of its solution.
        np.testing.assert_allclose(added, added.T, rtol=0, atol=1e-10 * np.abs(added).max())
        np.testing.assert_allclose(damping, damping.T, rtol=0, atol=1e-10 * np.abs(damping).max())
        # Singular for a section whose sway and roll send the same wave; 1e-4 is the tolerance.
        assert np.linalg.eigvalsh(damping).min() >= -1e-4 * np.abs(damping).max()
    # Mirror images: waves from the other side push sideways with the other sign.
    waves = np.exp(-1j * table.wavenumbers * 4.0)[:, :, None]
    right, left = table.excitation_force[:, :, 0] * waves, table.excitation_force[:, :, 1] / waves
    mirrored = np.where([name == "heave" for name in table.dofs], 1.0, -1.0)
    np.testing.assert_allclose(left * mirrored, right, rtol=1e-3, atol=1e-4 * np.abs(right).max())
    np.testing.assert_allclose(
        table.froude_krylov_force + table.diffraction_force, table.excitation_force, rtol=0, atol=1e-9
    )


@pytest.mark.slow_but("1")
@pytest.mark.parametrize("row", numbered(TWO_LIQUIDS))
def test_rigid_plates_on_two_liquids(row: dict[str, Any]) -> None:
    table = radiation(two_liquids(row, 1e-6), row["omega"]).table
    assert table.dofs == ("heave", "pitch")
    found = np.diag(table.added_mass[0] + 1j * table.radiation_damping[0] / row["omega"])
    exact = np.array(row["rigid"]["added_mass"]) + 1j * np.array(row["rigid"]["damping"]) / row["omega"]
    # Pitch has ∫w² = l like heave: w = √12 (x/l − ½).
    exact = exact * [1.0, 12.0 / row["plate"]["length"] ** 2]
    assert np.abs(found / exact - 1.0).max() <= 1e-6
    assert table.relative_error[0] <= 1e-6
    # Both liquids and both waves: measured 5e-8 at the most.
    assert table.energy_residual[0] <= 3e-7
    assert table.haskind_residual[0] <= 1e-8


@pytest.mark.slow
@pytest.mark.parametrize(
    ("depths", "level", "omega", "ratio"),
    [((2.0, 1.5), "interface", 1.0, 0.8), ((1.5, 0.2), "interface", 2.0, 0.5), ((1.5, 2.0), "surface", 1.0, 0.99)],
)
def test_short_plates_far_from_bed_and_top(depths: Any, level: str, omega: float, ratio: float) -> None:
    densities, length = (DENSITY, ratio * DENSITY), 0.3
    liquids = TwoLiquids(densities=densities, depths=depths, lid=False)
    exact, _ = rigid_radiation(length, getattr(liquids, level)(omega), 12)
    row = {"densities": densities, "depths": depths, "top": "free", "level": level}
    scene = two_liquids(row | {"plate": {"length": length, "rigidity": 1.0, "mass": 5.0}}, 1e-6)
    solution = radiation(scene, omega)
    found = np.diag(hydrodynamic(solution)[0]) * [1.0, length**2 / 12.0]
    errors = np.abs(found / np.diag(exact) - 1.0)
    assert errors.max() <= min(1e-6, TOO_SMALL * solution.error)
    assert solution.table.energy_residual[0] <= 3e-7


@pytest.mark.slow_but("wedge-water")
@pytest.mark.parametrize("liquids", THIN_LIQUIDS)
@pytest.mark.parametrize("shape", ["wedge", "parabola", "ellipse"])
def test_thin_floats(shape: Any, liquids: str) -> None:
    omegas = np.array([thin_omega(liquids, kappa) for kappa in (0.05, 0.5, 2.0)])
    scene = slender(shape, liquids, 1e-6)
    solution = radiation(scene, *omegas)
    closed = thin_float_radiation(float_profile(shape, 0.1 * RADIUS, RADIUS), THIN_LIQUIDS[liquids], omegas)
    exact = closed.added_mass + 1j * closed.damping / omegas
    errors = np.abs(hydrodynamic(solution)[:, 0, 0] / exact - 1.0)
    assert errors.max() <= 1e-6
    # The estimate does not know what is cut off far away: measured 6e-8.
    assert errors.max() <= TOO_SMALL * solution.error + 1e-7
    assert np.all(solution.table.radiation_damping >= 0.0)
    limit = radiation(scene, math.inf).table.added_mass[0, 0, 0]
    assert limit == pytest.approx(closed.infinite_added_mass, rel=1e-6)


@pytest.mark.slow
def test_what_thickness_does_to_an_ellipse() -> None:
    omegas = [thin_omega("water", kappa) for kappa in (0.5, 1.0, 2.0)]
    exact, thin = (
        hydrodynamic(radiation(slender("ellipse", "water", 1e-4, boundary=boundary), *omegas))[:, 0, 0]
        for boundary in ("exact", "thin")
    )
    # From multipoles of the ellipse at τ = 0.1, which were rounded to three digits.
    np.testing.assert_allclose((exact.real / thin.real - 1.0) / 0.1, [0.303, 0.646, 0.267], rtol=0, atol=1.5e-3)
    np.testing.assert_allclose((exact.imag / thin.imag - 1.0) / 0.1, [-0.465, -0.398, -0.108], rtol=0, atol=1.5e-3)


@pytest.mark.slow
def test_place_in_the_scene_changes_phases_alone() -> None:
    row = SECTIONS[6]
    here, there = (radiation(section(row, 1e-4, position), row["omega"]) for position in (4.0, 7.3))
    far = radiation(section(row, 1e-4).model_copy(update={"tank": here_with_length(row, 40.0)}), row["omega"])
    # Nodes of the mesh at 7.3 and 4 differ by rounding.
    for other in (there, far):
        np.testing.assert_allclose(hydrodynamic(other), hydrodynamic(here), rtol=1e-9, atol=1e-8)
    k = here.table.wavenumbers[0, 0]
    turned = here.table.excitation_force[0, 0] * np.exp(1j * k * 3.3 * np.array([1.0, -1.0]))[:, None]
    np.testing.assert_allclose(there.table.excitation_force[0, 0], turned, rtol=1e-9, atol=1e-7)


def here_with_length(row: dict[str, Any], length: float) -> Any:
    return section(row, 1e-4).tank.model_copy(update={"length": length})


@pytest.mark.slow
def test_millimetres_are_as_good_as_metres() -> None:
    omega, part = circle_omega(0.7), 1e-3
    metres = radiation(circle(1e-6), omega)
    body = {"half_width": part * RADIUS, "half_height": part * RADIUS, "position": part * 5.0}
    small = radiation(circle(1e-6, body=body, length=part * 10.0), omega / math.sqrt(part))
    # The same dimensionless problem up to rounding of its numbers.
    np.testing.assert_allclose(hydrodynamic(small) / part**2, hydrodynamic(metres), rtol=0, atol=1e-9 * DISPLACED)
    forces = [solution.table.excitation_force for solution in (small, metres)]
    np.testing.assert_allclose(forces[0] / part, forces[1], rtol=0, atol=1e-9 * np.abs(forces[1]).max())


INVARIANCES = {
    "circle": (lambda tolerance: circle(tolerance), circle_omega(0.5)),
    "rectangle over a bed": (lambda tolerance: section(SECTIONS[2], tolerance), 2.5),
    "plate between equals": (lambda tolerance: two_liquids(TWO_LIQUIDS[8], tolerance), 0.3),
}


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
@pytest.mark.parametrize("change", ["less angle", "more angle", "growth", "margin"])
@pytest.mark.parametrize("name", INVARIANCES)
def test_how_the_sea_is_cut_changes_nothing(
    name: str, change: str, tolerance: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    make, omega = INVARIANCES[name]
    base = hydrodynamic(radiation(make(tolerance), omega))[0]
    if change == "margin":
        monkeypatch.setattr(open_basin, "_MARGIN", 0.8)
    elif change == "growth":
        monkeypatch.setattr(open_model, "GROWTH", 2.4)
        monkeypatch.setattr(open_model, "_GROWTH_OVER_A_BED", 1.7)
    else:
        factor = 0.8 if change == "less angle" else 1.15
        monkeypatch.setattr(open_model, "ANGLE", factor * open_model.ANGLE)
        monkeypatch.setattr(open_model, "ANGLE_OVER_A_BED", factor * open_model.ANGLE_OVER_A_BED)
    other = hydrodynamic(radiation(make(tolerance), omega))[0]
    # What the truncation reflects would turn with the angle.
    assert np.abs(other - base).max() <= tolerance * np.abs(base).max()
    # The change took place.
    assert np.abs(other - base).max() > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["trapezium", "plate under a lid"])
def test_ends_farther_away_change_nothing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # Far above the waves what decays by itself decays most slowly. With ends a quarter as far: 8e-4 and 2e-5.
    omega = 7.0 if name == "trapezium" else 1.2
    scene = section(SECTIONS[6], 1e-6) if name == "trapezium" else two_liquids(TWO_LIQUIDS[9], 1e-6)
    near = radiation(scene, omega)
    monkeypatch.setattr(open_basin, "CUT", 1e-4)
    far = radiation(scene, omega)
    assert near.model is not None
    assert far.model is not None
    assert far.model.absorbing_layer.farthest > 1.2 * near.model.absorbing_layer.farthest
    matrix = hydrodynamic(far)
    # Measured: 1e-9; the frames between are others, too.
    assert np.abs(hydrodynamic(near) - matrix).max() <= 1e-7 * np.abs(matrix).max()


@pytest.mark.slow_on_ranks_but("plate")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("name", ["section", "plate"])
def test_two_processes_find_what_one_finds(name: str) -> None:
    row = SECTIONS[6] if name == "section" else PLATES[4]
    scene = section(row, 1e-4) if name == "section" else plate(row, 1e-4)
    together, alone = (
        radiation(scene, row["omega"], elastic_modes=4, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    )
    exact = hydrodynamic(alone)[0]
    # The same mesh and matrices; only the order of sums and of elimination differs.
    np.testing.assert_allclose(hydrodynamic(together)[0], exact, rtol=0, atol=1e-12 * np.abs(exact).max())
    forces = alone.table.excitation_force
    np.testing.assert_allclose(together.table.excitation_force, forces, rtol=0, atol=1e-11 * np.abs(forces).max())
