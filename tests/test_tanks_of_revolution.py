"""Tanks of revolution and canals, order by order: closed forms, floating cylinders, round plates."""

from __future__ import annotations

from math import asin, hypot, pi, sqrt, tanh
from typing import Any

import numpy as np
import pytest
from level_tanks import CASES, plate, reference_tank, solved, tank
from scipy.special import jnp_zeros

import hydroelastic as he

GRAVITY = 9.81


def revolved(radius: float, depth: float, *bodies: dict[str, Any], **keys: Any) -> dict[str, Any]:
    """A tank whose bed is drawn, level unless said otherwise."""
    return tank({"radius": radius} | (keys or {"outline": [[0.0, -depth], [radius, -depth]]}), depth, *bodies)


def of_order(result: he.Result, order: int) -> np.ndarray:
    return result.modes.omega[result.modes.order == order]


@pytest.mark.mpi
def test_sloshing_of_every_order_in_a_cylinder() -> None:
    """ω² = gk tanh kH with Jₙ′(kR) = 0; a factor n in place of n² shows from order 2 on."""
    result = solved(revolved(5.0, 3.0), 1e-6, 8)
    assert result.modes.order.tolist() == [1, 2, 0, 3, 4, 1, 5, 2]
    for order in range(6):
        k = jnp_zeros(order, 2) / 5.0
        found = of_order(result, order)
        assert found == pytest.approx(np.sqrt(GRAVITY * k * np.tanh(3.0 * k))[: len(found)], rel=1e-8)
    assert result.modes.multiplicity.tolist() == [1 if order == 0 else 2 for order in result.modes.order]


def test_a_cone_of_45_degrees() -> None:
    """Order 1 sways as a whole, ψ = xz from the apex, ω² = g/H; the others are known to ten digits."""
    result = solved(revolved(2.0, 2.0, outline=[[0.0, -2.0], [2.0, 0.0]]), 1e-8, 8)
    assert of_order(result, 1)[0] == pytest.approx(sqrt(GRAVITY / 2.0), rel=1e-11)
    assert of_order(result, 0)[0] == pytest.approx(3.788779183, rel=3e-10)
    assert of_order(result, 1)[1] == pytest.approx(4.68926499, rel=2e-9)


def test_a_spherical_tank_half_full() -> None:
    """ω²R/g of the orders 1, 2 and 0 (P. McIver 1989, J. Fluid Mech. 201, 243, five digits)."""
    modes = solved(revolved(3.0, 3.0, shape="sphere"), 1e-4, 3).modes
    assert modes.order.tolist() == [1, 2, 0]
    assert modes.omega**2 * 3.0 / GRAVITY == pytest.approx([1.56016, 2.81969, 3.74517], abs=1e-5)


@pytest.mark.slow
def test_a_spherical_tank_is_the_limit_of_many_cones() -> None:
    """Less than half full: the difference falls like the square of the number of cones."""
    depth = 0.6
    surface = sqrt(2.0 * depth - depth**2)
    sphere = solved(revolved(surface, depth, shape="sphere"), 1e-6, 3).modes.omega
    differences = []
    for count in (12, 24):
        angles = np.linspace(0.0, asin(surface), count + 1)[1:-1]
        bed = [[float(np.sin(angle)), float(1.0 - depth - np.cos(angle))] for angle in angles]
        cones = solved(revolved(surface, depth, outline=[[0.0, -depth], *bed, [surface, 0.0]]), 1e-6, 3)
        differences.append(cones.modes.omega / sphere - 1.0)
    np.testing.assert_allclose(differences[0] / differences[1], 4.0, rtol=0.1)


def floating_cylinder(name: str, **keys: Any) -> dict[str, Any]:
    """Its inertia is that of its immersed part."""
    given = CASES[name]["inputs"]
    body = {"kind": "float", "shape": "cylinder", "radius": given["a"], "draught": given["T"]}
    return body | {"vertical_centre_of_gravity": given["zg"]} | keys


FLOATING = ["float_cylinder_base", "float_cylinder_shallow_draught"]


@pytest.mark.slow_but("float_cylinder_base")
@pytest.mark.parametrize("name", FLOATING)
def test_a_floating_cylinder_in_a_round_tank(name: str) -> None:
    """Heave couples with waves of order 0, surge and pitch with those of order 1; surge has no stiffness."""
    given = CASES[name]["inputs"]
    radius = sqrt(given["a"] ** 2 / 4.0 + given["T"] ** 2 / 12.0)
    body = floating_cylinder(name, radius_of_gyration=radius, motions=["heave", "surge", "pitch"])
    result = solved(revolved(given["R"], given["H"], body), 1e-6, 10)
    for order in (0, 1):
        found = of_order(result, order)
        errors = found / np.array(CASES[name]["by_class"][f"n{order}"])[: len(found)] - 1.0
        # Ritz values come from above.
        assert errors.min() > -1e-8
        assert errors.max() < 1e-7
    assert {(0, "heave"), (1, "pitch")} <= set(zip(result.modes.order.tolist(), result.modes.kind, strict=True))
    # Surge along x and along y.
    assert result.summary["zero_modes"] == 2


@pytest.mark.slow_but("float_cylinder_shallow_draught-0.003")
@pytest.mark.mpi
@pytest.mark.parametrize(("name", "tolerance"), [(FLOATING[1], 3e-3), (FLOATING[1], 1e-4), (FLOATING[0], 1e-3)])
def test_a_floating_cylinder_in_tetrahedra(name: str, tolerance: float) -> None:
    given = CASES[name]["inputs"]
    radius = sqrt(given["a"] ** 2 / 4.0 + given["T"] ** 2 / 12.0)
    motions = ["heave", "surge", "sway", "pitch", "roll"]
    body = floating_cylinder(name, radii_of_gyration=[radius, radius, 1.0], motions=motions)
    result = solved(tank({"radius": given["R"], "model": "volume"}, given["H"], body), tolerance, 10)
    assert result.summary["zero_modes"] == 2
    omega, estimates = result.modes.omega, result.modes.relative_error
    for expected, twice in list(zip(CASES[name]["omega"], CASES[name]["multiplicity"], strict=True))[:3]:
        places = np.argsort(np.abs(omega - expected))[:twice]
        errors = omega[places] / expected - 1.0
        assert np.all((errors > 0.0) & (errors <= tolerance))
        # Measured at the float's corner: 1.2 to 1.4; of low waves more.
        assert np.all(estimates[places] >= errors)


def test_a_v_canal_of_45_degrees() -> None:
    """ω² = (gk/√2) tanh(kH/√2) with ψ = cosh(kx/√2) cosh(kz/√2) cos ky of Kelvin, and without waves across g/H."""
    depth, width = 2.0, 7.0
    bed = [[0.0, 0.0], [depth, -depth], [2.0 * depth, 0.0]]
    result = solved(tank({"length": 2.0 * depth, "width": width, "outline": bed}, depth), 1e-6, 10)
    assert of_order(result, 0)[0] == pytest.approx(sqrt(GRAVITY / depth), rel=1e-9)
    for order in (1, 2, 3):
        k = order * pi / width / sqrt(2.0)
        assert of_order(result, order)[0] == pytest.approx(sqrt(GRAVITY * k * tanh(k * depth)), rel=1e-9)
    assert set(result.modes.multiplicity) == {1}


def test_a_canal_with_a_level_bed_is_a_box() -> None:
    """Without waves across k = iπ/L; with them k² = (iπ/L)² + (jπ/B)²."""
    length, width = 4.0, 3.0
    bed = [[0.0, -1.0], [length, -1.0]]
    result = solved(tank({"length": length, "width": width, "outline": bed}, 1.0), 1e-6, 6)
    for across in (0, 1):
        k = np.array([hypot(i * pi / length, across * pi / width) for i in range(4)][1 - across :])
        found = of_order(result, across)
        assert found == pytest.approx(np.sqrt(GRAVITY * k * np.tanh(k))[: len(found)], rel=1e-9)
        assert len(found) >= 2


def over_a_drawn_bed(name: str) -> dict[str, Any]:
    document, depth = reference_tank(name), CASES[name]["inputs"]["H"]
    document["tank"]["outline"] = [[0.0, -depth], [document["tank"]["radius"], -depth]]
    return document


PLATES = [name for name, case in CASES.items() if case["family"] == "cylinder_plate"]


@pytest.mark.mpi
@pytest.mark.slow_but("annulus_s0", "disc_heavy_s1")
@pytest.mark.parametrize("name", PLATES)
def test_plates_in_the_half_plane_have_the_frequencies_of_the_radial_problem(name: str) -> None:
    """Bounds of estimates as for all tanks, with 1e-12 of rounding in the references."""
    result = solved(over_a_drawn_bed(name), 1e-6, 8)
    assert result.modes.multiplicity.tolist() == CASES[name]["multiplicity"][:8]
    errors = np.abs(result.modes.omega / np.array(CASES[name]["omega"][:8]) - 1.0)
    assert np.all(errors < result.modes.relative_error + 1e-12)
    assert np.all(result.modes.relative_error < 30.0 * errors + 1e-10)


def test_a_covered_cone_pitches_as_a_whole() -> None:
    """ψ = xz from the apex of a cone of 45 degrees and w = x, which bends no plate: ω² = ρg/(ρH + m)."""
    depth, mass = 2.0, 300.0
    cone = revolved(depth, depth, plate("disc", 5e3, mass, radius=depth), outline=[[0.0, -depth], [depth, 0.0]])
    modes = solved(cone, 1e-6, 3).modes
    (pitch,) = [mode for mode in modes if mode.order == 1][:1]
    assert pitch.omega == pytest.approx(sqrt(1000.0 * GRAVITY / (1000.0 * depth + mass)), rel=1e-10)
    assert pitch.kind == "pitch"


def test_the_first_elastic_tone_is_that_of_the_radial_problem() -> None:
    """Both models are independent in depth and radius; the tolerance is the sum of their estimates."""
    found, known = (
        solved(document, 1e-5, 3).summary["first_elastic"]
        for document in (over_a_drawn_bed("disc_base_s0"), reference_tank("disc_base_s0"))
    )
    assert found["order"] == known["order"] == 2
    assert found["participation"] == pytest.approx(known["participation"], rel=1e-4)
    for key in ("omega", "pressure_release_omega"):
        error = key.replace("omega", "relative_error")
        assert abs(found[key] / known[key] - 1.0) < found[error] + known[error] + 1e-10
    for key in ("dry_omega", "added_mass_per_area"):
        assert found[key] == pytest.approx(known[key], rel=1e-5)


DISHED = {"outline": [[0.0, -10.0], [6.0, -6.0], [10.0, -4.0]]}
TWO_PLATES = (plate("disc", 1e4, 5.0, radius=3.0), plate("ring", 1e5, 5.0, radius=6.0, inner_radius=4.0))


def test_estimates_of_plates_take_a_shaped_bed_as_level() -> None:
    """A bed of flat rings is the level one; a sphere's mean depth below a disc of radius a is a closed form."""
    disc = plate("disc", 5e3, 50.0, radius=2.0)
    radius = (25.0 + 9.0) / 6.0
    mean = 2.0 * (radius**3 - (radius**2 - 4.0) ** 1.5) / (3.0 * 4.0) - radius + 3.0
    flat = {"outline": [[0.0, -3.0], [4.0, -3.0], [5.0, -3.0]]}
    for bed, depth in ((flat, 3.0), ({"shape": "sphere"}, mean)):
        shaped, level = (
            solved(document, 1e-2, 1).summary["estimates"]
            for document in (revolved(5.0, 3.0, disc, **bed), tank({"radius": 5.0}, depth, disc))
        )
        assert set(shaped) == set(level)
        for name, estimate in shaped.items():
            # A thousand circles leave 1e-7 of the mean depth.
            assert estimate["omega"] == pytest.approx(level[name]["omega"], rel=1e-6)
            assert "the bed as if level at " in estimate["note"]
    dished = solved(revolved(10.0, 10.0, *TWO_PLATES, **DISHED), 1e-4, 3)
    # Under a lid the water between the plates cannot rise: measured.
    found = {name: one["difference"] for name, one in dished.summary["estimates"].items() if "rayleigh" in name}
    assert found == {"rayleigh_lid": pytest.approx(-0.154, abs=2e-3), "rayleigh_lid_2": pytest.approx(0.129, abs=2e-3)}
    # Each is drawn to its edges: rings of an axisymmetric mode are level, and the outermost belong to the plate.
    assert [tone["body"] for tone in dished.summary["first_elastic_by_body"]] == [1, 2]
    place = dished.modes.order.tolist().index(0)
    name = next(one for one in dished.dataset["shape"].values if one.startswith(f"{place + 1:03}"))
    data = dished.dataset.sel(shape=name)
    for number in (1, 2):
        radii = np.hypot(data.x.values, data.y.values)
        circles = np.unique(np.round(radii[data.plate.values == number], 9))[-4:]
        heights = []
        for circle in circles:
            on = data.elevation.values[(np.abs(radii - circle) < 1e-8) & (data.plate.values == number)]
            assert np.ptp(on) < 1e-8 * np.abs(data.elevation.values).max()
            heights.append(on.mean())
        steps = np.abs(np.diff(heights))
        assert steps[-1] < 2.0 * np.median(steps)


@pytest.mark.parametrize(
    ("number", "change", "said"),
    [
        (1, {"radius": 11.0}, 'key "radius" = 11.0: the plate is wider than the tank'),
        (1, {"inner_radius": 3.0}, r"the plate overlaps or touches \[\[body\]\] number 1"),
        (0, {"edge": "clamped"}, 'key "edge" = "clamped": it is not known here'),
    ],
)
def test_plates_that_are_refused(number: int, change: dict[str, Any], said: str) -> None:
    bodies = [body | (change if index == number else {}) for index, body in enumerate(TWO_PLATES)]
    with pytest.raises(he.SceneError, match=said):
        solved(revolved(10.0, 10.0, *bodies, **DISHED), 1e-4, 3)
