"""Added mass, damping and excitation in open water: against other methods, closed forms, limits, and identities."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import open_circle
import pytest
from open_cases import (
    DENSITY,
    DISPLACED,
    RADIUS,
    SLOW,
    THIN_LIQUIDS,
    TOO_SMALL,
    circle,
    circle_omega,
    complex_of,
    hydrodynamic,
    numbered,
    radiation,
    sea,
    section,
    slender,
    stored,
    thin_omega,
    two_liquids,
)
from open_plates import rigid_radiation
from open_two_liquids import TwoLiquids
from scipy.interpolate import CubicSpline

from hydroelastic.modal.floats.thin_float_radiation import thin_float_radiation
from hydroelastic.physics.profiles import float_profile

CIRCLE = stored("open_circle.json")["radiation"]
SECTIONS = stored("open_sections.json")["cases"]
TWO_LIQUIDS = stored("open_two_liquids.json")["cases"]

# Measured, at most: 26 on circles, 32 on plates between two liquids.
TOO_LARGE = 60.0


def circle_matrix(table: SimpleNamespace) -> np.ndarray:
    """a' + ib' of heave and sway, shape (frequencies, 2, 2)."""
    order = [table.dofs.index(motion) for motion in ("heave", "sway")]
    return hydrodynamic(table)[:, order][:, :, order] / DISPLACED


def exact_circle(row: dict[str, Any]) -> np.ndarray:
    return np.array([complex(row["heave_a"], row["heave_b"]), complex(row["sway_a"], row["sway_b"])])


@pytest.mark.slow_but("Ka=1.8-1e-06")
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("row", CIRCLE, ids=lambda row: f"Ka={row['Ka']}")
def test_circle(row: dict[str, Any], tolerance: float) -> None:
    table = radiation(circle(tolerance), circle_omega(row["Ka"]))
    found, exact = circle_matrix(table)[0], exact_circle(row)
    errors = np.abs(np.diag(found) - exact) / np.abs(exact)
    assert errors.max() <= tolerance
    estimate = float(table.relative_error[0])
    assert estimate <= tolerance
    # The reference is right to 3e-12.
    assert errors.max() <= TOO_SMALL * estimate + 3e-12
    assert estimate <= TOO_LARGE * errors.max()
    # Heave and sway of what is its own mirror image do not know each other.
    assert abs(found[0, 1]) <= tolerance * np.abs(exact).max()


@pytest.mark.slow
def test_circle_in_the_limits() -> None:
    table = radiation(circle(1e-6), 0.0, math.inf, circle_omega(1.0))
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


def test_a_flat_plate_in_the_limit_of_high_frequency() -> None:
    """π/8 ρl² in heave, and 3π/64 ρl² in a pitch of mean square 1: of half a plate in unbounded water."""
    plate = {"length": 2.0, "flexural_rigidity": 1e6, "mass_per_length": 50.0}
    table = radiation(sea(plate, tolerance=1e-8), math.inf)
    exact = DENSITY * 4.0 * np.diag([math.pi / 8.0, 3.0 * math.pi / 64.0])
    # Measured 4e-9 and 1e-8.
    np.testing.assert_allclose(table.added_mass[0], exact, rtol=0, atol=2e-8 * exact[0, 0])


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


def section_matrix(table: SimpleNamespace) -> tuple[np.ndarray, np.ndarray]:
    """H and the excitation from the left in the order of the stored rows."""
    order = [table.dofs.index(motion) for motion in ("sway", "heave", "roll")]
    return hydrodynamic(table)[0][np.ix_(order, order)], table.excitation_force[0, 0, 0][order]


@pytest.mark.slow_but("5-1e-06")
@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
@pytest.mark.parametrize("row", numbered(SECTIONS))
def test_sections(row: dict[str, Any], tolerance: float) -> None:
    position = 4.0
    table = radiation(section(row, tolerance, position), row["omega"])
    found, force = section_matrix(table)
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
    table = radiation(section(row, 1e-4), 0.7 * row["omega"], row["omega"])
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
    table = radiation(two_liquids(row, 1e-6), row["omega"])
    assert table.dofs == ["heave", "pitch"]
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
    table = radiation(scene, omega)
    found = np.diag(hydrodynamic(table)[0]) * [1.0, length**2 / 12.0]
    errors = np.abs(found / np.diag(exact) - 1.0)
    assert errors.max() <= min(1e-6, TOO_SMALL * table.relative_error.max())
    assert table.energy_residual[0] <= 3e-7


@pytest.mark.slow_but("wedge-water")
@pytest.mark.parametrize("liquids", THIN_LIQUIDS)
@pytest.mark.parametrize("shape", ["wedge", "parabola", "ellipse"])
def test_thin_floats(shape: Any, liquids: str) -> None:
    omegas = np.array([thin_omega(liquids, kappa) for kappa in (0.05, 0.5, 2.0)])
    scene = slender(shape, liquids, 1e-6)
    table = radiation(scene, *omegas)
    closed = thin_float_radiation(float_profile(shape, 0.1 * RADIUS, RADIUS), THIN_LIQUIDS[liquids], omegas)
    exact = closed.added_mass + 1j * closed.damping / omegas
    errors = np.abs(hydrodynamic(table)[:, 0, 0] / exact - 1.0)
    assert errors.max() <= 1e-6
    # The estimate does not know what is cut off far away: measured 6e-8.
    assert errors.max() <= TOO_SMALL * table.relative_error.max() + 1e-7
    assert np.all(table.radiation_damping >= 0.0)
    limit = radiation(scene, math.inf).added_mass[0, 0, 0]
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
    far = radiation(section(row, 1e-4) | {"tank": {"length": 40.0, "ends": "open"}}, row["omega"])
    # Nodes of the mesh at 7.3 and 4 differ by rounding.
    for other in (there, far):
        np.testing.assert_allclose(hydrodynamic(other), hydrodynamic(here), rtol=1e-9, atol=1e-8)
    k = here.wavenumbers[0, 0]
    turned = here.excitation_force[0, 0] * np.exp(1j * k * 3.3 * np.array([1.0, -1.0]))[:, None]
    np.testing.assert_allclose(there.excitation_force[0, 0], turned, rtol=1e-9, atol=1e-7)


@pytest.mark.slow
def test_millimetres_are_as_good_as_metres() -> None:
    omega, part = circle_omega(0.7), 1e-3
    metres = radiation(circle(1e-6), omega)
    body = {"half_width": part * RADIUS, "half_height": part * RADIUS, "position": part * 5.0}
    small = radiation(circle(1e-6, body=body, length=part * 10.0), omega / math.sqrt(part))
    # The same dimensionless problem up to rounding of its numbers.
    np.testing.assert_allclose(hydrodynamic(small) / part**2, hydrodynamic(metres), rtol=0, atol=1e-9 * DISPLACED)
    forces = [table.excitation_force for table in (small, metres)]
    np.testing.assert_allclose(forces[0] / part, forces[1], rtol=0, atol=1e-9 * np.abs(forces[1]).max())


@pytest.fixture(scope="module")
def swept() -> SimpleNamespace:
    """64 frequencies of the circle on a reduced basis, equal ratios of Ka."""
    return radiation(circle(1e-6), *map(float, np.geomspace(circle_omega(0.01), circle_omega(10.0), 64)), math.inf)


@SLOW
def test_sweep_is_as_accurate_as_it_says(swept: SimpleNamespace) -> None:
    table = swept
    omegas = table.omega[:-1]
    matrices = (table.added_mass + 1j * table.radiation_damping / table.omega[:, None, None])[:-1] / DISPLACED
    order = [table.dofs.index(motion) for motion in ("heave", "sway")]
    found = np.diagonal(matrices, axis1=1, axis2=2)[:, order]
    exact = np.array(
        [
            [
                open_circle.radiation(float(omega) ** 2 * RADIUS / 9.81, motion, 80).impedance
                for motion in ("heave", "sway")
            ]
            for omega in omegas
        ]
    )
    errors = np.abs(found / exact - 1.0).max(axis=1)
    assert errors.max() <= 1e-6
    # Measured: 1.05.
    assert np.all(errors <= TOO_SMALL * table.relative_error[:-1])
    assert table.factorizations < 40


@SLOW
def test_added_mass_is_the_hilbert_transform_of_damping(swept: SimpleNamespace) -> None:
    table = swept
    omegas = table.omega[:-1]
    for motion in (0, 1):
        limit = table.added_mass[-1, motion, motion]
        damping = table.radiation_damping[:-1, motion, motion]
        for place in range(16, 48, 6):
            own = omegas[place]
            # PV∫dω'/(ω'² − ω²) = 0 takes the pole away; b = 0 at ω = 0, and above it falls by a power.
            rest = hilbert_rest(omegas, damping, place, 4.0 * DENSITY * RADIUS**2 if motion == 0 else 0.0)
            # Both tails: measured 6e-4 of the displaced mass.
            assert table.added_mass[place, motion, motion] - limit == pytest.approx(rest, abs=1e-3 * DISPLACED), own


def hilbert_rest(omegas: np.ndarray, damping: np.ndarray, place: int, limit: float) -> float:
    """(2/π)∫₀^∞ (b(ω') − b(ω))/(ω'² − ω²) dω' from b at some frequencies, and from the limit of b/ω at ω = 0."""
    own, value = omegas[place], damping[place]
    spline = CubicSpline(np.log(omegas), damping)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.log(omegas)
    half = np.diff(edges)[:, None] / 2.0
    u = (edges[:-1, None] + half * (1.0 + nodes)).ravel()
    x = np.exp(u)
    inner = (half * weights).ravel() * x @ ((spline(u) - value) / (x**2 - own**2))
    low, high = omegas[0], omegas[-1]
    # Below: b/ω goes to its limit like ω². Above: b ~ b(high) (ω/high)^(−p).
    t, w = (nodes + 1.0) / 2.0, weights / 2.0
    slope = limit + (damping[0] / low - limit) * t**2
    below = low * (w @ ((slope * low * t - value) / ((low * t) ** 2 - own**2)))
    power = -math.log(damping[-1] / damping[-2]) / math.log(omegas[-1] / omegas[-2])
    above = high * (w @ ((damping[-1] * t**power - value) / (high**2 - (own * t) ** 2)))
    return float(2.0 / math.pi * (inner + below + above))
