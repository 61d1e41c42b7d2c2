"""Plates and floats that move freely in waves of open water: against other methods, energy, and reciprocity."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from open_cases import (
    SLOW,
    answer,
    beam,
    complex_of,
    numbered,
    open_scene,
    plate,
    radiation,
    response,
    sea,
    section,
    slender,
    stored,
    thin_omega,
    two_liquids,
)
from open_levels import one_liquid
from open_plates import plate_of, scattering

PLATES = stored("open_plates.json")["plates"]
TWO_LIQUIDS = stored("open_two_liquids.json")["cases"]
SECTIONS = stored("open_sections.json")["cases"]
PUBLISHED = stored("open_water.json")

# Measured: estimates are 1.7 to 11 times the error where the mesh leaves it. They count omitted dry modes in full, the
# deflection of which the loads bring back: below a tenth of the tolerance this costs nothing.
TOO_LARGE = 40.0


@pytest.mark.slow_but("1-1e-06", "7-1e-06")
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("row", numbered(PLATES))
def test_plates(row: dict[str, Any], tolerance: float) -> None:
    table = response(plate(row, tolerance), row["omega"])
    shape = table.plates[0].deflection[0, 0]
    differences = [
        table.reflection[0, 0, 0] - complex_of(row["reflected"]),
        table.transmission[0, 0, 0] - complex_of(row["transmitted"]),
        *(shape - complex_of(row["deflection"])),
    ]
    error = np.abs(differences).max()
    assert error <= max(np.abs(shape).max(), 1.0) * tolerance
    assert error <= table.relative_error[0] * max(np.abs(shape).max(), 1.0)
    assert table.relative_error[0] <= min(tolerance, max(TOO_LARGE * error, 0.1 * tolerance))
    # |R|² + |T|² = 1: measured 1e-7 at the tolerance 1e-6.
    assert abs(table.energy_residual[0, 0]) <= 0.3 * tolerance
    outgoing = abs(table.reflection[0, 0, 0]) ** 2 + abs(table.transmission[0, 0, 0]) ** 2
    assert table.energy_residual[0, 0] == pytest.approx(outgoing - 1.0, abs=1e-13)


@SLOW
@pytest.mark.parametrize("row", PUBLISHED["compound_plate"]["rows"], ids=lambda row: f"xi={row['xi']}")
def test_compound_plate_as_published(row: dict[str, Any]) -> None:
    segments = [{"length": x, "rigidity": ei, "mass": 8.36} for x, ei in ((2.5, 47100.0), (10.0, 471.0))]
    given = {"depth": 1.1, "density": 1025.0, "segments": segments, "joints": [row["xi"] * 47100 / 12.5]}
    # 26 points of equal distance, as published.
    table = response(plate(given, 3e-6), 4.397971190, positions=26)
    waves = np.abs([table.reflection[0, 0, 0], table.transmission[0, 0, 0]])
    # The rows have an error of about 1e-5.
    np.testing.assert_allclose(waves, [row["R"], row["T"]], rtol=0, atol=1e-5)
    column = {0: "abs_w_xi0", 625: "abs_w_xi625"}.get(row["xi"], "abs_w_rigid_joint")
    published = [point[column] for point in PUBLISHED["compound_plate"]["deflection"]]
    np.testing.assert_allclose(np.abs(table.plates[0].deflection[0, 0]), published, rtol=0, atol=1e-5)


def elevations_over_level(row: dict[str, Any]) -> np.ndarray:
    """Elevation of each stored wave at the surface on which it travels, over that at the plate's level."""
    if row["interface_over_surface"] is None:
        return np.ones(1)
    surface, internal = row["interface_over_surface"]
    return np.array([1.0, internal] if row["level"] == "surface" else [1.0 / surface, 1.0])


@pytest.mark.slow_but("1-1e-06")
@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
@pytest.mark.parametrize("row", numbered(TWO_LIQUIDS))
def test_plates_on_two_liquids(row: dict[str, Any], tolerance: float) -> None:
    table = response(two_liquids(row, tolerance), row["omega"])
    order = np.argsort(table.wavenumbers[0])
    np.testing.assert_allclose(table.wavenumbers[0][order], row["wave_numbers"], rtol=1e-12)
    elevations = elevations_over_level(row)
    for place, stored_row in zip(order, row["waves_in"], strict=True):
        incident = elevations[list(order).index(place)]
        for found, key in ((table.reflection, "reflected"), (table.transmission, "transmitted")):
            expected = complex_of(stored_row[key]) * elevations / incident
            np.testing.assert_allclose(found[0, place][order], expected, rtol=0, atol=tolerance)
        shape = complex_of(stored_row["deflection"]) / incident
        atol = tolerance * max(np.abs(shape).max(), 1.0)
        np.testing.assert_allclose(table.plates[0].deflection[0, place], shape, rtol=0, atol=atol)
        # Energy is split between surface and interface waves on both sides.
        flux = np.array(row["flux"]) / elevations**2
        outgoing = sum(np.abs(ratio[0, place][order]) ** 2 for ratio in (table.reflection, table.transmission))
        assert flux @ outgoing * incident**2 / row["flux"][list(order).index(place)] == pytest.approx(
            1.0, abs=0.3 * tolerance
        )
    assert np.abs(table.energy_residual).max() <= 0.3 * tolerance
    for load in (table.plates[0].shear_force[0], table.plates[0].bending_moment[0]):
        # Heave and pitch are in equilibrium, so that nothing is left at the right end but rounding, measured 1.4e-10.
        assert np.abs(load[:, -1]).max() <= 1e-9 * np.abs(load).max()


@pytest.mark.parametrize("number", [14, pytest.param(17, marks=SLOW)])
def test_transmission_is_the_same_from_either_side(number: int) -> None:
    row = PLATES[number - 1]
    start = 3.0
    left, right = (response(plate(row, 1e-6, start), row["omega"], waves_from=side) for side in ("left", "right"))
    # Phases are counted from x = 0: those of the transmitted wave are the same, those of the reflected ones are not.
    # On one mesh by Green's theorem, to 3e-10; loads ask for a finer one from one side: measured 7e-8.
    assert left.transmission[0, 0, 0] == pytest.approx(right.transmission[0, 0, 0], abs=2e-7)
    assert abs(left.reflection[0, 0, 0]) == pytest.approx(abs(right.reflection[0, 0, 0]), abs=2e-4)
    # From the right is from the left for the plate that is turned.
    turned = response(plate(row, 1e-4, turned=True), row["omega"])
    length = sum(segment["length"] for segment in row["segments"])
    phase = np.exp(-2j * left.wavenumbers[0, 0] * (start + length))
    assert right.reflection[0, 0, 0] == pytest.approx(turned.reflection[0, 0, 0] * phase, abs=2e-4)


@pytest.mark.slow
def test_two_waves_are_reciprocal() -> None:
    row = TWO_LIQUIDS[1]
    scene = two_liquids(row, 1e-6, start=2.0)
    left, right = (response(scene, row["omega"], waves_from=side) for side in ("left", "right"))
    elevations, flux = elevations_over_level(row), np.array(row["flux"])
    order = np.argsort(left.wavenumbers[0])
    power = flux / elevations**2
    # With the root of its power each wave has a symmetric scattering matrix.
    root = np.sqrt(power[:, None] / power)
    there = left.transmission[0][np.ix_(order, order)] / root
    back = right.transmission[0][np.ix_(order, order)] / root
    np.testing.assert_allclose(there, back.T, rtol=0, atol=1e-9)
    reflected = left.reflection[0][np.ix_(order, order)] / root
    np.testing.assert_allclose(reflected, reflected.T, rtol=0, atol=1e-9)
    # One wave becomes the other: the matrix is not diagonal.
    assert abs(there[0, 1]) > 1e-3


@pytest.mark.slow
def test_place_of_the_plate_changes_phases_alone() -> None:
    row, start = PLATES[10], 4.0
    here, there = (response(plate(row, 1e-6, place), row["omega"]) for place in (0.0, start))
    k = here.wavenumbers[0, 0]
    np.testing.assert_allclose(there.transmission, here.transmission, rtol=0, atol=1e-8)
    np.testing.assert_allclose(there.reflection, here.reflection * np.exp(2j * k * start), rtol=0, atol=1e-8)
    shapes = [table.plates[0] for table in (here, there)]
    np.testing.assert_allclose(shapes[1].positions, shapes[0].positions + start, rtol=1e-14)
    np.testing.assert_allclose(shapes[1].deflection, shapes[0].deflection * np.exp(1j * k * start), rtol=0, atol=1e-8)


def test_free_float_moves_as_its_coefficients_say() -> None:
    row = SECTIONS[6]
    scene = section(row, 1e-4)
    moving, coefficients = response(scene, row["omega"]), radiation(scene, row["omega"])
    omega = row["omega"]
    inertia = coefficients.inertia + coefficients.added_mass[0] + 1j * coefficients.radiation_damping[0] / omega
    motions = np.linalg.solve(coefficients.stiffness - omega**2 * inertia, coefficients.excitation_force[0, 0, 0])
    # Both keep 1e-4, and are on the same mesh up to the resolution that they end with.
    np.testing.assert_allclose(moving.amplitudes[0, 0], motions, rtol=0, atol=3e-4 * np.abs(motions).max())
    assert abs(moving.energy_residual[0, 0]) <= 1e-4


def test_a_long_wave_lifts_a_thin_float_by_its_height() -> None:
    kappa = 1e-3
    table = response(slender("parabola", "water", 1e-4), thin_omega("water", kappa))
    # Its middle is at x = 5. The float differs from the water by κ = ω²h/g times a number of order 1, measured 0.4.
    carried = np.exp(5j * table.wavenumbers[0, 0])
    assert abs(table.amplitudes[0, 0, 0] / carried - 1.0) < kappa


@SLOW
def test_sweep_of_a_plate_is_as_accurate_as_it_says() -> None:
    row = PLATES[0]
    omegas = np.linspace(1.0, 4.0, 61)
    table = response(plate(row, 1e-6), *map(float, omegas))
    for place in range(0, 61, 6):
        level = one_liquid(float(omegas[place]), density=row["density"], depth=row["depth"])
        exact = scattering(plate_of(row), level, np.linspace(0, 1, 11) * plate_of(row).length)
        differences = [
            table.reflection[place, 0, 0] - exact.reflected[0],
            table.transmission[place, 0, 0] - exact.transmitted[0],
            *(table.plates[0].deflection[place, 0] - exact.deflection),
        ]
        scale = max(np.abs(exact.deflection).max(), 1.0)
        assert np.abs(differences).max() <= 1e-6 * scale
        assert np.abs(differences).max() <= 3.0 * table.relative_error[place] * scale
    assert np.abs(table.energy_residual).max() <= 1e-7


@pytest.mark.slow
def test_what_does_not_disturb_the_water_sends_no_waves() -> None:
    # A beam that weighs and bends next to nothing moves with the water.
    light = beam([{"length": 2.0, "rigidity": 1e-6, "mass": 1e-6}], []) | {"start": 1.0}
    scene = open_scene(light, liquids=[{"density": 1000.0, "depth": 1.0}], tolerance=1e-4)
    table = response(scene, 3.0)
    assert abs(table.reflection[0, 0, 0]) < 1e-6
    assert table.transmission[0, 0, 0] == pytest.approx(1.0, abs=1e-6)
    waves = np.exp(1j * table.wavenumbers[0, 0] * table.plates[0].positions)
    np.testing.assert_allclose(table.plates[0].deflection[0, 0], waves, rtol=0, atol=1e-3)


@pytest.mark.parametrize(
    ("body", "omega", "tolerance"),
    [
        # A spar on a plate pitches with next to no damping, between two of these frequencies.
        pytest.param(
            {"shape": "cylinder", "radius": 1.0, "draught": 4.0, "vertical_centre_of_gravity": -2.5}
            | {"radius_of_gyration": 2.0, "motions": ["heave", "surge", "pitch"]},
            (0.6, 2.4, 7),
            1e-3,
            marks=SLOW,
            id="solid",
        ),
        pytest.param(
            {"shape": "rectangle", "half_width": 10.0, "half_height": 4.0, "draught": 4.0}
            | {"vertical_centre_of_gravity": 1.0, "radius_of_gyration": 7.0, "motions": ["heave", "roll"]},
            (0.5, 1.2, 8),
            1e-2,
            id="section",
        ),
    ],
)
def test_curves_have_the_peaks_that_few_frequencies_miss(
    body: dict[str, Any], omega: tuple[float, float, int], tolerance: float, tmp_path: Path
) -> None:
    """At the frequencies asked for the curve is the table; at its peak it is a solution there, on another mesh."""
    asked = np.linspace(*omega).tolist()
    scene = sea({"kind": "float"} | body, depth=30.0, tolerance=tolerance)
    found = answer(scene, {"kind": "response", "omega": asked})
    (table,), motion = found.response, 1 if body["shape"] == "rectangle" else 2
    name = table.dofs[motion]
    found.result.save(tmp_path / "result", images=None)
    with (tmp_path / "result" / "response_curve.csv").open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    places, error = (np.array([float(row[key]) for row in rows]) for key in ("omega", "basis_error"))
    dense = np.array([complex(float(row[f"re_{name}"]), float(row[f"im_{name}"])) for row in rows])
    few = table.amplitudes[:, 0, motion]
    np.testing.assert_allclose(dense[np.searchsorted(places, asked)], few, atol=tolerance * np.abs(few).max())
    peak = int(np.abs(dense).argmax())
    assert abs(dense[peak]) > 1.5 * np.abs(few).max()
    assert error.max() < tolerance
    there = response(scene, float(places[peak])).amplitudes[0, 0, motion]
    # Each has the tolerance; the resonance of the solid, off by 6e-6 and 2e-4 wide, turns the phase by 0.03.
    assert abs(dense[peak]) == pytest.approx(abs(there), rel=2.0 * tolerance)
    assert abs(dense[peak] - there) < (2.0 * tolerance if motion == 1 else 0.05) * abs(there)
    # The peak between two frequencies is told, where nothing that is drawn shows it.
    (told,) = {round(one.omega, 6): one for one in table.missed_peaks if one.quantity == name}.values()
    assert told.below < told.omega < told.above
    assert told.omega == pytest.approx(places[peak], rel=2e-2)
    assert told.value == pytest.approx(abs(dense[peak]), rel=0.05)
    assert told.drawn < 0.7 * told.value
    assert "NOT SHOWN" in str(found.result)


def test_few_frequencies_are_no_curve() -> None:
    scene = sea({"kind": "float", "shape": "rectangle", "half_width": 10.0, "half_height": 4.0}, tolerance=1e-2)
    assert not len(response(scene, 0.7, 0.8).missed_peaks)


BOX: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 0.5, "half_height": 0.5}
BOX |= {"motions": ["heave", "sway", "roll"], "centre_of_mass": -0.1}


@pytest.mark.slow_but("left")
@pytest.mark.parametrize("waves_from", ["left", "right"])
def test_a_body_that_is_moved_keeps_its_phases_beside_the_crest_at_it(waves_from: str) -> None:
    # Deep water, k = ω²/g.
    wavelength = 2.0 * np.pi * 9.81 / 3.0**2
    first, second = (
        response(open_scene(BOX | {"position": x}, tolerance=1e-3), 3.0, waves_from=waves_from)
        for x in (3.0, 3.0 + 0.3 * wavelength)
    )
    # Each time the error is 1e-3 of the larger of heave and sway, which differ by 2.4; of roll of itself.
    assert first.phase_at_body == pytest.approx(second.phase_at_body, abs=5.0 * np.degrees(1e-3))
    turned = np.degrees(np.angle(second.amplitudes / first.amplitudes))
    assert turned == pytest.approx(108.0 if waves_from == "left" else -108.0, abs=5.0 * np.degrees(1e-3))


@pytest.mark.parametrize(("waves_from", "sway"), [("left", 90.0), ("right", -90.0)])
def test_in_long_waves_a_body_moves_with_the_water(waves_from: str, sway: float) -> None:
    """The water at a crest is at its highest, and where it was carried from a quarter of a period later."""
    table = response(open_scene(BOX | {"position": 4.0}, tolerance=1e-3), 0.5, waves_from=waves_from)
    assert table.phase_at_body[0, 0, :2] == pytest.approx([0.0, sway], abs=np.degrees(1e-3))


BARGE = {"kind": "float", "shape": "rectangle", "half_width": 1.0, "half_height": 0.5}
BARGE |= {"motions": ["heave", "sway", "roll"]}


def test_the_sea_is_open_water_whose_origin_is_at_the_body() -> None:
    liquids = [{"density": 1000.0, "depth": 3.0}]
    theirs = response(open_scene(BARGE | {"position": 4.0}, liquids=liquids, tolerance=1e-3, length=9.0), 2.0)
    ours = response(sea(BARGE, depth=3.0, tolerance=1e-3), 2.0)
    shift = np.exp(4j * ours.wavenumbers[0, 0])
    # The same mesh moved: rounding.
    assert ours.amplitudes * shift == pytest.approx(theirs.amplitudes, rel=1e-9)


def test_phases_are_told_about_any_point() -> None:
    at_body, elsewhere = (
        response(sea(BARGE, depth=3.0, tolerance=1e-3, sea={"phase_at": x}), 2.0) for x in (0.0, -7.0)
    )
    # A crest that was at x = −7 at t = 0 comes later at the body.
    shift = np.exp(7j * at_body.wavenumbers[0, 0])
    assert elsewhere.amplitudes == pytest.approx(at_body.amplitudes * shift, rel=1e-12)
    assert elsewhere.transmission == pytest.approx(at_body.transmission, rel=1e-12)
