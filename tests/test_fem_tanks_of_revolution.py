"""Tanks of revolution against closed forms and floating cylinders in round tanks."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from open_cases import stored
from scipy.special import jnp_zeros

from hydroelastic.fem.tank.orders import OrderedSolution, solve_by_order
from hydroelastic.fem.tank.solve import solve_tank
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.geometry import PLANE, Geometry
from hydroelastic.physics.hulls import Hull
from hydroelastic.physics.hydrostatics import hydrostatics
from hydroelastic.physics.solids import solid_of_revolution
from hydroelastic.physics.tank import Tank, tank

GRAVITY = 9.81
FLOATS = [case for case in stored("three_dimensions.json")["cases"] if case["family"] == "cylinder_float"]


def round_tank(radius: float, depth: float, *bodies: RigidFloat) -> Tank:
    """Return a tank with one liquid."""
    return tank(
        length=radius,
        gravity=GRAVITY,
        is_open=False,
        liquids=((1000.0, depth),),
        top="free",
        bodies=bodies,
        geometry=Geometry(kind="revolved"),
    )


def cylinder(radius: float, draught: float, centre_of_mass: float) -> RigidFloat:
    """Return a floating cylinder whose inertia is that of its immersed part."""
    solid = solid_of_revolution("cylinder", radius=radius, draught=draught)
    rest = hydrostatics(
        solid,
        immersion=0.0,
        densities=(1000.0, 0.0),
        gravity=GRAVITY,
        centre_of_mass=centre_of_mass,
        radius_of_gyration=float(np.sqrt(radius**2 / 4.0 + draught**2 / 12.0)),
    )
    hull = Hull(
        contour=solid.contour,
        profile=None,
        is_thin=False,
        height=0.0,
        reference_level=0.0,
        wet_above=False,
        waterplane=rest.waterplane,
    )
    return RigidFloat(hull=hull, hydrostatics=rest, level="surface", motions=("heave", "surge", "pitch"))


def of_order(solution: OrderedSolution, order: int) -> np.ndarray:
    """Return ω of the modes of an order."""
    return np.array([mode.omega for mode in solution.modes if mode.order == order])


@pytest.mark.mpi
def test_sloshing_of_every_order_in_a_cylinder() -> None:
    """ω² = gk tanh kH with Jₙ′(kR) = 0; a factor n in place of n² shows from order 2 on."""
    radius, depth = 5.0, 3.0
    solution = solve_by_order(round_tank(radius, depth), tolerance=1e-6, modes=8)
    assert [mode.order for mode in solution.modes] == [1, 2, 0, 3, 4, 1, 5, 2]
    assert not solution.reasons
    for mode in solution.modes:
        zeros = jnp_zeros(mode.order, 3) / radius
        known = np.sqrt(GRAVITY * zeros * np.tanh(zeros * depth))
        assert np.abs(mode.omega / known - 1.0).min() < 1e-9
        assert mode.multiplicity == (1 if mode.order == 0 else 2)


def test_a_cone_of_45_degrees() -> None:
    """Order 1 sways as a whole, ψ = xz from the apex, ω² = g/H; the others are known to ten digits."""
    depth = 2.0
    cone = replace(round_tank(depth, depth), bed=((0.0, -depth), (depth, 0.0)))
    solution = solve_by_order(cone, tolerance=1e-8, modes=8)
    assert of_order(solution, 1)[0] == pytest.approx(np.sqrt(GRAVITY / depth), rel=1e-11)
    assert of_order(solution, 0)[0] == pytest.approx(3.788779183, rel=3e-10)
    assert of_order(solution, 1)[1] == pytest.approx(4.68926499, rel=2e-9)


def test_a_spherical_tank_half_full() -> None:
    """ω²R/g of the orders 1, 2 and 0 (P. McIver 1989, J. Fluid Mech. 201, 243, five digits)."""
    solution = solve_by_order(replace(round_tank(3.0, 3.0), bed="sphere"), tolerance=1e-4, modes=3)
    found = [(mode.order, mode.omega**2 * 3.0 / GRAVITY) for mode in solution.modes]
    assert found == [
        (1, pytest.approx(1.56016, abs=1e-5)),
        (2, pytest.approx(2.81969, abs=1e-5)),
        (0, pytest.approx(3.74517, abs=1e-5)),
    ]


@pytest.mark.slow
def test_a_spherical_tank_is_the_limit_of_many_cones() -> None:
    """Less than half full: the difference falls like the square of the number of cones."""
    radius, depth = 1.0, 0.6
    surface = float(np.sqrt(2.0 * depth - depth**2))
    sphere = solve_by_order(replace(round_tank(surface, depth), bed="sphere"), tolerance=1e-6, modes=3)
    differences = []
    for count in (12, 24):
        angles = np.linspace(0.0, np.arcsin(surface), count + 1)
        bed = [(float(np.sin(angle)), radius - depth - float(np.cos(angle))) for angle in angles]
        bed = [(0.0, -depth), *bed[1:-1], (surface, 0.0)]
        cones = solve_by_order(replace(round_tank(surface, depth), bed=tuple(bed)), tolerance=1e-6, modes=3)
        differences.append(
            [one.omega / other.omega - 1.0 for one, other in zip(cones.modes, sphere.modes, strict=True)]
        )
    ratios = np.array(differences[0]) / np.array(differences[1])
    np.testing.assert_allclose(ratios, 4.0, rtol=0.1)


@pytest.mark.parametrize("case", FLOATS[:1] + [pytest.param(case, marks=pytest.mark.slow) for case in FLOATS[1:]])
def test_a_floating_cylinder_in_a_round_tank(case: dict[str, Any]) -> None:
    """Heave couples with waves of order 0, surge and pitch with those of order 1; surge has no stiffness."""
    given = case["inputs"]
    if given["inertia"] or given["mass"] or not given["s"]:
        pytest.skip("it does not float by its own displacement")
    body = cylinder(given["a"], given["T"], given["zg"])
    solution = solve_by_order(round_tank(given["R"], given["H"], body), tolerance=1e-6, modes=10)
    assert not solution.reasons
    for order in (0, 1):
        found, known = of_order(solution, order), np.array(case["by_class"][f"n{order}"])
        errors = found / known[: len(found)] - 1.0
        # Ritz values come from above.
        assert errors.min() > -1e-8
        assert errors.max() < 1e-7
    kinds = {(mode.order, mode.kind) for mode in solution.modes}
    assert {(0, "heave"), (1, "pitch")} <= kinds
    assert solution.orders[1].modes.zero_modes == 1


def test_a_v_canal_of_45_degrees() -> None:
    """ω² = (gk/√2) tanh(kH/√2) with ψ = cosh(kx/√2) cosh(kz/√2) cos ky of Kelvin, and without waves across g/H."""
    depth, width = 2.0, 7.0
    canal = replace(
        tank(
            length=2.0 * depth,
            gravity=GRAVITY,
            is_open=False,
            liquids=((1000.0, depth),),
            top="free",
            bodies=(),
            geometry=Geometry(kind="extruded", width=width),
        ),
        bed=((0.0, 0.0), (depth, -depth), (2.0 * depth, 0.0)),
    )
    solution = solve_by_order(canal, tolerance=1e-6, modes=10)
    assert of_order(solution, 0)[0] == pytest.approx(np.sqrt(GRAVITY / depth), rel=1e-9)
    for order in (1, 2, 3):
        k = order * np.pi / width / np.sqrt(2.0)
        assert of_order(solution, order)[0] == pytest.approx(np.sqrt(GRAVITY * k * np.tanh(k * depth)), rel=1e-9)
    assert all(mode.multiplicity == 1 for mode in solution.modes)


def test_a_box_of_finite_width() -> None:
    """Without waves across it is the section per metre of width; with them k² = (mπ/L)² + (jπ/B)²."""
    length, width = 4.0, 3.0
    section = tank(
        length=length,
        gravity=GRAVITY,
        is_open=False,
        liquids=((1000.0, 1.0),),
        top="free",
        bodies=(),
        geometry=Geometry(kind="extruded", width=width),
    )
    solution = solve_by_order(section, tolerance=1e-6, modes=6)
    plane = solve_tank(replace(section, geometry=PLANE), tolerance=1e-6, modes=3)
    count = len(of_order(solution, 0))
    np.testing.assert_allclose(of_order(solution, 0), [plane.omega(one.eigenvalue) for one in plane.asked][:count])
    along, across = np.pi / length, np.pi / width
    k = np.hypot(along, across)
    assert of_order(solution, 1)[0] == pytest.approx(np.sqrt(GRAVITY * across * np.tanh(across)), rel=1e-9)
    assert of_order(solution, 1)[1] == pytest.approx(np.sqrt(GRAVITY * k * np.tanh(k)), rel=1e-9)
