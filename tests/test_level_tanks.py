"""Upright tanks with level beds: references, closed forms, and one model beside another.

Strips, discs and rings about the axis are solved order by order, all other plans on triangles. A ratio of estimate to
error of 1 to 30 is the promise of all estimates.
"""

from __future__ import annotations

from functools import cache
from math import inf, pi, sqrt, tanh
from typing import Any

import numpy as np
import pytest
from level_tanks import CASES, frequencies, plate, reference, reference_tank, solved, tank

import hydroelastic as he

ORDERS = [name for name, case in CASES.items() if case["family"] in ("cylinder_plate", "box_strip")]
RECTANGLES = [name for name, case in CASES.items() if case["family"] == "box_rectangle"]
BASE = "rectangle_base_s0"


@cache
def of_case(name: str, tolerance: float) -> he.Result:
    return solved(reference_tank(name), tolerance, 12)


@pytest.mark.slow_but("annulus_s0", "disc_full_s0", "disc_rigid_s0", "strip_at_wall", "strip_slats_s1", BASE)
@pytest.mark.parametrize("name", ORDERS + RECTANGLES)
def test_frequencies_keep_the_tolerance_and_its_estimate(name: str) -> None:
    result = of_case(name, 1e-6)
    exact = np.array(CASES[name]["omega"]) if name in ORDERS else reference(name)[:12]
    errors, estimates = result.modes.omega / exact - 1.0, result.modes.relative_error
    # Ritz values come from above; references have 9 digits at least, those of strips 11.
    certain = 10.0 ** (1 - CASES[name]["digits"])
    assert errors.min() > -certain
    assert errors.max() < 1e-6
    known = errors > 10.0 * certain
    if name in ORDERS:
        assert np.all((estimates >= errors)[known] & (estimates <= 30.0 * errors)[known])
        assert [f"n{order}" for order in result.modes.order] == CASES[name]["label"]
        assert result.modes.multiplicity.tolist() == CASES[name]["multiplicity"]
    elif known.any():
        assert errors.max() < estimates.max() < 30.0 * errors.max()
    if name == BASE:
        assert result.modes.symmetry.tolist() == CASES[name]["label"]


@pytest.mark.slow_but("disc_heavy_s1-1e-10")
@pytest.mark.parametrize(
    ("names", "tolerance"), [(name, 1e-10) for name in ORDERS] + [(one, 1e-8) for one in RECTANGLES]
)
def test_frequencies_keep_a_narrow_tolerance(names: str, tolerance: float) -> None:
    exact = CASES[names]["omega"] if names in ORDERS else reference(names)[:12]
    result = he.solve(reference_tank(names) | {"accuracy": {"tolerance": tolerance, "modes": 12}})
    # The tone of a plate alone may have fewer digits, and says so.
    assert all("pressure-release tone" in reason for reason in result.summary["reasons"])
    errors = result.modes.omega / exact - 1.0
    # Orders measured 6e-12, below the digits of the references of discs; rectangles come from above.
    assert errors.max() < (5e-11 if names in ORDERS else tolerance)
    assert errors.min() > -max(5e-11, 10.0 ** -CASES[names]["digits"])


@pytest.mark.parametrize("name", ["slosh_box", "slosh_cylinder", "cover_box_s0"])
def test_closed_forms_are_met(name: str) -> None:
    modes = of_case(name, 1e-8).modes
    errors = np.abs(modes.omega / CASES[name]["omega"] - 1.0)
    # Orders have rounding only; below the covered box the poles of the depth leave 2e-10, which the estimate tells.
    assert np.all(errors < (modes.relative_error if name == "cover_box_s0" else 1e-10))


def test_a_covered_cylinder_is_closed_for_order_zero() -> None:
    modes = of_case("cover_cylinder_s0", 1e-8).modes
    found = modes.omega[modes.order == 0]
    assert found == pytest.approx(CASES["cover_cylinder_s0"]["omega"][: len(found)], rel=1e-10)
    assert len(found) >= 2


def test_sloshing_in_a_triangle_has_its_closed_form_twice() -> None:
    result = solved(reference_tank("slosh_triangle"), 1e-6, 9)
    # Smooth ψ is better than the tolerance: measured 2e-9.
    errors = np.abs(result.modes.omega / reference("slosh_triangle")[:9] - 1.0)
    assert np.all(errors < 1e-8)
    assert np.all(errors < result.modes.relative_error)


def test_a_basin_with_a_reentrant_corner_has_the_known_wavenumber() -> None:
    """The lowest Neumann eigenvalue of the L-shaped domain, Dauge's benchmark of Maxwell eigenvalues, 11 digits."""
    corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]
    (mode,) = solved(tank({"plan": corners}, 0.5), 1e-5, 1).modes
    k = sqrt(1.47562182408)
    error = mode.omega / sqrt(9.81 * k * tanh(0.5 * k)) - 1.0
    assert 0.0 < error < mode.relative_error < 1e-5


def test_a_heavy_rigid_cover_tilts_and_does_not_heave() -> None:
    """The volume is kept; ψ of w = x is a sum over odd cosines."""
    cover = plate("rectangle", inf, 100.0, size=[2.0, 1.0])
    result = solved(tank({"length": 2.0, "width": 1.0}, 1.0, cover), 1e-8, 2)
    expected = []
    for length, width in ((2.0, 1.0), (1.0, 2.0)):
        k = pi * np.arange(1, 40001, 2) / length
        inertia = 1000.0 * width * (2.0 / length) * np.sum((2.0 / k**2) ** 2 / (k * np.tanh(k)))
        moment = width * length**3 / 12.0
        expected.append(sqrt(9810.0 * moment / (inertia + 100.0 * moment)))
    assert result.modes.omega == pytest.approx(sorted(expected), rel=1e-9)
    assert result.summary["zero_modes"] == 0
    assert len(solved(tank({"length": 2.0, "width": 1.0}, 1.0, cover), 1e-3, 3).modes) == 2


def test_a_rigid_disc_on_deep_wide_water_has_the_added_mass_of_lamb() -> None:
    """Heave 4/3 ρa³ and pitch 8/45 ρa⁵ with ψ = 0 beside the disc; stiffness ρgπa² and ρgπa⁴/4."""
    a, mass, density, g = 0.02, 2.0, 1000.0, 9.81
    disc = plate("disc", inf, mass, radius=a)
    modes = solved(tank({"radius": 1.0, "top": "pressure_release"}, 1.0, disc), 1e-5, 2).modes
    heave = density * g * pi * a**2 / (mass * pi * a**2 + density * 4.0 / 3.0 * a**3)
    pitch = density * g * pi / 4.0 * a**4 / (mass * pi / 4.0 * a**4 + density * 8.0 / 45.0 * a**5)
    # The walls change heave by about (a/R)³, measured 2e-5; the discretization 1e-5.
    assert dict(zip(modes.order.tolist(), modes.omega, strict=True)) == pytest.approx(
        {0: sqrt(heave), 1: sqrt(pitch)}, rel=1e-4
    )


@pytest.mark.slow
def test_a_rigid_strip_or_disc_on_deep_wide_water_has_the_estimated_frequencies() -> None:
    """With ψ = 0 beside them; of a strip both motions are of order 0."""
    strip, disc = plate("strip", inf, 1.0, start=0.49, length=0.02), plate("disc", inf, 1.0, radius=0.02)
    for plan, body in (({"radius": 1.0}, disc), ({"length": 1.0, "width": 0.1}, strip)):
        result = solved(tank(plan | {"top": "pressure_release"}, 1.0, body), 1e-5, 2)
        for name in ("rigid_heave", "rigid_pitch"):
            estimate = result.summary["estimates"][name]["omega"]
            # Walls and bed change the added mass by about (a/R)³ of a disc and (l/L)² of a strip, 4e-4 at most.
            assert np.abs(result.modes.omega / estimate - 1.0).min() < 2e-4


def test_a_rigid_plate_s_pitch_is_found_below_its_heave() -> None:
    """ω² of order 1 is below that of order 0, and that below the waves of order 1, k tanh kH ≥ tanh 1."""
    disc = plate("disc", inf, 2000.0, radius=0.5)
    document = tank({"radius": 1.0, "gravity": 1.0}, 1.0, disc)
    modes = solved(document, 1e-5, 2).modes
    assert modes.order.tolist() == [1, 0]
    assert modes.omega[0] ** 2 < modes.omega[1] ** 2 < tanh(1.0)
    assert solved(document, 1e-5, 1).modes.omega == pytest.approx(modes.omega[:1], rel=1e-9)


@pytest.mark.slow_but("False")
@pytest.mark.parametrize("slats", [False, True])
def test_a_strip_without_cross_waves_is_the_beam_of_the_section(slats: bool) -> None:
    """Two discretizations with nothing in common but the eigenproblem."""
    beam = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    body = beam | {"kind": "beam"} if slats else plate("strip", 5e3, 50.0, start=3.0, length=4.0)
    strip = solved(tank({"length": 10.0, "width": 0.5}, 5.0, body), 1e-9, 5).modes
    section = solved(tank({"length": 10.0}, 5.0, beam), 1e-9, 4).modes.omega
    along = strip.omega[strip.order == 0]
    assert along[:3] == pytest.approx(section[: len(along)][:3], rel=2e-9)


def test_frequencies_do_not_depend_on_units() -> None:
    small = reference_tank("disc_base_s0")
    small["tank"], small["liquid"][0]["depth"] = {"radius": 5e-3}, 3e-3
    small["body"][0] |= {"radius": 2e-3, "mass_per_area": 0.05, "flexural_rigidity": 5e3 * 1e-12}
    found = solved(small, 1e-6, 6).modes.omega
    assert found / sqrt(1000.0) == pytest.approx(solved(reference_tank("disc_base_s0"), 1e-6, 6).modes.omega, rel=1e-11)


def test_plates_as_soft_as_water_leave_the_waves_of_a_ring() -> None:
    """Two concentric rings about an inner cylinder."""
    plan = {"radius": 5.0, "inner_radius": 1.0}
    rings = [plate("ring", 1e-6, 1e-12, radius=r, inner_radius=r - 1.0) for r in (3.0, 4.5)]
    soft, bare = (solved(tank(plan, 3.0, *bodies), 1e-5, 3).modes.omega for bodies in (rings, ()))
    # Its bending of D/(ρgL⁴) = 2e-13 is not none.
    assert soft == pytest.approx(bare, rel=1e-6)


HARD: dict[str, dict[str, Any]] = {
    "shallow": {"depth": 0.05},
    "deep": {"depth": 50.0},
    "soft": {"flexural_rigidity": 1.0},
    "stiff": {"flexural_rigidity": 1e9},
    "narrow ring": {"outline": "ring", "radius": 4.9, "inner_radius": 4.8},
    "small hole": {"outline": "ring", "radius": 4.0, "inner_radius": 0.05},
    "nearly covered": {"radius": 4.999},
    "clamped": {"radius": 5.0, "edge": "clamped"},
    "hinged": {"radius": 5.0, "edge": "hinged"},
}


@pytest.mark.slow_but("clamped")
@pytest.mark.parametrize("case", HARD)
def test_hard_tanks_keep_their_tolerance(case: str) -> None:
    changes = dict(HARD[case])
    document = reference_tank("disc_base_s0")
    document["liquid"][0]["depth"] = changes.pop("depth", 3.0)
    document["body"][0] |= changes
    coarse, fine = (solved(document, tolerance, 8).modes.omega for tolerance in (1e-5, 1e-8))
    assert coarse == pytest.approx(fine, rel=1e-5)


# The same tank by another model: its changes, the tolerance, and how many modes are compared.
def as_polygon() -> dict[str, Any]:
    document = reference_tank(BASE)
    body = {key: value for key, value in document["body"][0].items() if key != "size"}
    points = [[3.0, 2.5], [7.0, 2.5], [7.0, 5.5], [3.0, 5.5]]
    return document | {"body": [body | {"outline": "polygon", "points": points}]}


def beside_the_axis() -> dict[str, Any]:
    document = reference_tank("disc_heavy_s1")
    document["body"][0]["position"] = [1e-6, 0.0]
    return document


def strip_as_rectangle() -> dict[str, Any]:
    document = reference_tank("strip_base_s1")
    body = {key: value for key, value in document["body"][0].items() if key not in ("start", "length")}
    return document | {"body": [body | {"outline": "rectangle", "size": [4.0, 4.0], "edge": "sliding"}]}


def without_symmetry() -> dict[str, Any]:
    document = reference_tank(BASE)
    document["body"][0]["position"] = [5.0 + 2e-8, 4.0 - 2e-8]
    return document


OTHER_MODELS: dict[str, tuple[Any, str, float, int]] = {
    "polygon": (as_polygon, BASE, 1e-3, 6),
    "disc beside the axis": (beside_the_axis, "disc_heavy_s1", 1e-3, 4),
    "strip as rectangle": (strip_as_rectangle, "strip_base_s1", 1e-6, 12),
    "without symmetry": (without_symmetry, BASE, 1e-3, 6),
}


@pytest.mark.slow_but("polygon", "strip as rectangle", "without symmetry")
@pytest.mark.parametrize("case", OTHER_MODELS)
def test_another_model_of_the_same_tank_has_its_frequencies(case: str) -> None:
    make, name, tolerance, count = OTHER_MODELS[case]
    result, plain = (solved(document, tolerance, count) for document in (make(), reference_tank(name)))
    differ = case in ("disc beside the axis", "strip as rectangle")
    assert (result.summary["solver"]["model"] != plain.summary["solver"]["model"]) == differ
    errors = result.modes.omega / reference(name)[:count] - 1.0
    # From above: poles do not exceed the depth's response.
    assert errors.min() > -1e-9
    assert np.all(errors < np.maximum(result.modes.relative_error, 1e-11))
    assert errors.max() < tolerance
    # Of a heavy disc no mode of the few that are solved for on triangles is its tone.
    if case != "disc beside the axis":
        tone, known = result.summary["first_elastic"], plain.summary["first_elastic"]
        for key in ("omega", "pressure_release_omega"):
            error = key.replace("omega", "relative_error")
            assert abs(tone[key] / known[key] - 1.0) <= tone[error] + known[error]
        assert tone["dry_omega"] == pytest.approx(known["dry_omega"], rel=1e-6)


STRIPS = [plate("strip", D, 50.0, start=0.7 + 3.2 * i, length=2.0) for i, D in enumerate((5e2, 5e4, 5e3))]


def as_rectangles(strips: list[dict[str, Any]], width: float) -> list[dict[str, Any]]:
    shared = [{key: value for key, value in one.items() if key not in ("start", "length")} for one in strips]
    return [
        body
        | {"outline": "rectangle", "size": [strip["length"], width], "edge": "sliding"}
        | {"position": [strip["start"] + strip["length"] / 2.0, width / 2.0]}
        for body, strip in zip(shared, strips, strict=True)
    ]


def test_first_elastic_tones_are_those_of_another_model() -> None:
    """Those of the stiffer ones lie above rigid motions and shorter waves of the softer ones."""
    plan = {"length": 10.0, "width": 1.5}
    exact, found = (
        solved(tank(plan, 2.0, *bodies), 1e-3, 1).summary["first_elastic_by_body"]
        for bodies in (STRIPS, as_rectangles(STRIPS, 1.5))
    )
    assert [tone["body"] for tone in found] == [1, 2, 3]
    for tone, known in zip(found, exact, strict=True):
        allowed = tone["pressure_release_relative_error"] + known["pressure_release_relative_error"]
        assert abs(tone["pressure_release_omega"] / known["pressure_release_omega"] - 1.0) < allowed < 2e-3
        assert tone["dry_omega"] == pytest.approx(known["dry_omega"], rel=1e-6)


def test_pressure_release_tones_are_limits_of_thin_layers() -> None:
    coarse, fine = (
        solved(reference_tank("disc_base_s0"), tolerance, 1).summary["first_elastic"] for tolerance in (1e-4, 1e-8)
    )
    # Without the limit three refinements leave 1e-6.
    assert fine["pressure_release_relative_error"] < 1e-8
    assert coarse["pressure_release_omega"] == pytest.approx(
        fine["pressure_release_omega"], rel=coarse["pressure_release_relative_error"]
    )


@pytest.mark.slow
@pytest.mark.parametrize(("hydrostatic", "round_"), [(True, False), (False, True), (True, True)])
def test_modes_with_a_released_surface_are_those_of_orders(*, hydrostatic: bool, round_: bool) -> None:
    if round_:
        plan: dict[str, Any] = {"radius": 5.0}
        bodies = [plate("disc", 5e3, 50.0, radius=2.0, hydrostatic=hydrostatic)]
        others = [bodies[0] | {"position": [1e-6, 0.0]}]
    else:
        plan = {"length": 10.0, "width": 1.5}
        bodies = [strip | {"hydrostatic": hydrostatic} for strip in STRIPS[:2]]
        others = as_rectangles(bodies, 1.5)
    plan = plan | {"top": "pressure_release"}
    exact = frequencies(solved(tank(plan, 2.0, *bodies), 1e-6, 4))[:4]
    result = solved(tank(plan, 2.0, *others), 1e-3, 4)
    errors = np.abs(result.modes.omega / exact - 1.0)
    # Measured: 1e-5 to 1e-4; an estimate is never below a third of the error.
    assert np.all(errors < 3.0 * result.modes.relative_error)
    assert result.modes.relative_error.max() < 1e-3
    assert result.summary["zero_modes"] == (0 if hydrostatic else 3 if round_ else 4)


def test_a_beam_in_a_box_is_a_cover_of_slats() -> None:
    """The tone is that of order 0, the beam of a tank per metre of width."""
    result = he.solve(he.read("aquarium", {"tank.width": 4.0, "accuracy.modes": 2, "accuracy.tolerance": 1e-4}))
    # The shipped result of aquarium; 1e-4 is asked for.
    assert result.summary["modes"][0]["omega"] == pytest.approx(1.64970432, rel=1e-4)
    assert result.summary["first_elastic"]["omega"] == pytest.approx(4.23052401, rel=1e-4)


def test_rigidity_and_mass_follow_from_the_material() -> None:
    """D = Eh³/(12 (1 − ν²)) and ρh."""
    material = {"youngs_modulus": 2.1e11, "thickness": 0.01, "density": 7850.0}
    discs = [{"kind": "plate", "outline": "disc", "radius": 2.0} | material]
    discs.append(plate("disc", 2.1e11 * 1e-6 / (12.0 * 0.91), 78.5, radius=2.0))
    found = [solved(tank({"radius": 5.0}, 3.0, disc), 1e-6, 3).modes.omega for disc in discs]
    assert found[0] == pytest.approx(found[1], rel=1e-12)


def test_an_ice_sheet_in_a_triangle_has_double_tones() -> None:
    modes = he.solve(he.read("ice_in_a_triangle", {"accuracy.tolerance": 1e-4, "accuracy.modes": 7})).modes
    # The group of the triangle: pairs of two-dimensional representations are equal to the tolerance.
    for first, second in ((0, 1), (3, 4), (5, 6)):
        assert modes.omega[first] == pytest.approx(modes.omega[second], rel=1e-4)
    # Tilting is slower than sloshing without ice only by the ice's mass.
    assert 0.99 < modes.omega[0] / reference("slosh_triangle")[0] < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_a_plate_with_a_reentrant_corner_keeps_its_tolerance(tolerance: float) -> None:
    """ω at a tolerance of 1e-7."""
    corners = [[2.0, 1.5], [8.0, 1.5], [8.0, 3.5], [5.0, 3.5], [5.0, 6.0], [2.0, 6.0]]
    document = tank({"length": 10.0, "width": 8.0}, 3.0, plate("polygon", 5e3, 50.0, points=corners))
    modes = solved(document, tolerance, 4).modes
    errors = modes.omega / np.array(REENTRANT) - 1.0
    assert errors.min() > -1e-7
    assert errors.max() < modes.relative_error.max() < min(tolerance, 30.0 * errors.max())


REENTRANT = [1.5054637109754132, 1.7830075777571273, 2.1181366146258154, 2.4299434962726894]


@pytest.mark.slow
def test_a_plate_a_millimetre_from_a_wall_keeps_its_tolerance() -> None:
    body = plate("rectangle", 5e3, 50.0, position=[1.501, 3.0], size=[3.0, 2.0])
    coarse, fine = (solved(tank({"length": 10.0, "width": 6.0}, 2.0, body), tol, 8).modes for tol in (1e-6, 1e-9))
    # The largest one: of the lowest mode, 4e-10, the estimate shows a quarter.
    assert (coarse.omega / fine.omega - 1.0).max() < coarse.relative_error.max() < 1e-6


@pytest.mark.slow
def test_a_study_asks_each_model_for_tolerances() -> None:
    study = he.study(he.read("cross_waves", {"accuracy.modes": 3}), tolerances=[1e-2])
    rows = study.measured.rows
    assert [(row.model, row.tolerance) for row in rows] == [("orders", 1e-2), ("plan", 1e-2)]
    for row in rows:
        assert max(map(abs, row.errors)) <= row.estimate <= row.tolerance


ROUND: dict[str, Any] = {"radius": 5.0}
DISC = plate("disc", 5e3, 50.0, radius=2.0)
SLATS = {"kind": "beam", "start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
CROSSING = [[2.0, 2.0], [6.0, 6.0], [6.0, 2.0], [2.0, 6.0]]
COVER = plate("rectangle", inf, 10.0, size=[10.0, 5.0], edge="sliding")
BAD: dict[str, tuple[dict[str, Any], str]] = {
    "two plans": (tank(ROUND | {"width": 2.0}, 3.0, DISC), r"\[tank\], key .*different plans"),
    "no plan": (tank({"length": 5.0}, 3.0, DISC), 'no plan. Did you mean "beam"'),
    "varying beam": (tank(ROUND, 3.0, {"kind": "varying_beam", "start": 0.0}), "bodies are plates"),
    "beams in a cylinder": (tank(ROUND, 3.0, SLATS), "side to side of a box"),
    "strip in a cylinder": (tank(ROUND, 3.0, plate("strip", inf, 1.0, start=1.0, length=2.0)), "side to side of a box"),
    "outside": (tank(ROUND, 3.0, DISC | {"radius": 6.0}), 'key "radius" = 6.0: .*does not lie inside'),
    "overlap": (tank(ROUND, 3.0, DISC, DISC | {"radius": 1.0}), "overlaps or touches"),
    "touching": (tank(ROUND, 3.0, DISC | {"position": [3.0, 0.0]}), "touches a wall"),
    "stiffness twice": (tank(ROUND, 3.0, DISC | {"rigid": True}), "given twice"),
    "key of another outline": (tank(ROUND, 3.0, DISC | {"size": [1.0, 1.0]}), "does not belong to outline"),
    "nothing moves": (tank(ROUND | {"top": "rigid"}, 3.0), "nothing moves"),
    "nothing oscillates": (tank({"length": 10.0, "width": 5.0}, 3.0, COVER), "nothing oscillates"),
    "too thin": (tank(ROUND, 1e-5, DISC), "too thin"),
    "crossing plan": (tank({"plan": CROSSING}, 3.0), r"folds back on itself near \(6, 6\)"),
    "crossing plate": (tank(ROUND, 3.0, plate("polygon", 5e3, 50.0, points=CROSSING)), "folds back on itself"),
    "vertex twice": (tank({"plan": [*CROSSING[::2], CROSSING[0]]}, 3.0), "first vertex is not repeated"),
    "held at a slanted wall": (
        tank(ROUND, 3.0, plate("polygon", inf, 1.0, points=[[0.0, 2.0], [3.0, 2.0], [0.0, 4.0]], edge="clamped")),
        "walls hold edges of rectangles and strips in a box",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_what_does_not_fit_is_refused(case: str) -> None:
    document, said = BAD[case]
    with pytest.raises(he.SceneError, match=said):
        solved(document, 1e-2, 1)
