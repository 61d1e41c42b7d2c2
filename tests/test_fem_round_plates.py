"""Circular and ring-shaped plates in the sea against references by other methods, closed forms and identities."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from open_cases import SLOW, answer, complex_of, curves, sea, stored
from scipy.interpolate import CubicSpline

from hydroelastic.modal.plate.line_modes import PlateLine, dry_modes

CASES = {case["name"]: case for case in stored("axisymmetric_sea.json")["cases"]}


def solved(
    body: dict[str, Any], depth: float, tolerance: float, *analyses: dict[str, Any], **more: Any
) -> SimpleNamespace:
    """Solve for one plate."""
    return answer(sea({"kind": "plate", "outline": "disc"} | body, depth=depth, tolerance=tolerance, **more), *analyses)


def radiation(*omega: float, **asked: Any) -> dict[str, Any]:
    return {"kind": "radiation", "omega": list(omega)} | asked


def response(*omega: float, **asked: Any) -> dict[str, Any]:
    return {"kind": "response", "omega": list(omega)} | asked


REFERENCES = [
    pytest.param("p6 soft disc, no mass T=2.5", 1e-4),
    *(pytest.param(name, 1e-6, marks=SLOW) for name, case in CASES.items() if case["group"] == "plate"),
    pytest.param("p1 ice floe 50 m, deep T=11.0", 1e-8, marks=SLOW),
    pytest.param("p3 wave-tank disc 0.72 m, 10 mm T=0.8", 1e-8, marks=SLOW),
]

# Moment and shear force at x = −a/2 and 0, by this program at a tolerance of 3e-8 with 72 further dry modes.
LOADS = {
    "p6 soft disc, no mass T=2.5": {
        25: (-0.96501187 + 0.68864002j, -0.68710096 - 1.34919390j),
        50: (-1.13862025 + 0.00008059j, -0.00002148 - 1.34595492j),
    }
}


@pytest.mark.mpi
@pytest.mark.parametrize(("name", "tolerance"), REFERENCES)
def test_deflection_and_scattered_waves_agree_with_the_references(name: str, tolerance: float) -> None:
    """A wrong term of bending, Poisson's ratio, phase of an order or factor of the restoring is an error of order 1."""
    case = CASES[name]
    given, values = case["inputs"], case["values"]
    body = {
        "radius": given["radius"],
        "youngs_modulus": given["E"],
        "thickness": given["thickness"],
        "poisson_ratio": given["poisson"],
        "mass_per_area": given["density_plate"] * given["thickness"],
    }
    solution = solved(body, float(given["depth"]), tolerance, response(values["omega"]), density=given["density"])
    (table,) = solution.response
    assert solution.status == "ok"
    count = min(table.partial_waves.shape[-1], len(values["scattered"]))
    scattered = np.array([complex_of(value) for value in values["scattered"]])
    edge = np.array([complex_of(value) for value in values["edge_by_order"]])
    along = table.plates[0].deflection[0, 0]
    error = np.abs(table.partial_waves[0, 0, 0, :count] - scattered[:count]).max()
    assert error < table.relative_error[0] < tolerance
    # Sums over the orders lack those that are left out.
    places = {"edge_0": -1, "edge_180": 0, "centre": len(along) // 2}
    whole = max(abs(along[place] - complex_of(values[key])) for key, place in places.items())
    told = table.plates[0].deflection_error[0, 0]
    assert told / 100.0 < max(whole, error) < told < 3.0 * tolerance
    for place, loads in LOADS.get(name, {}).items():
        for found, exact in zip(("bending_moment", "shear_force"), loads, strict=True):
            told = getattr(table.plates[0], f"{found}_error")[0, 0]
            assert abs(getattr(table.plates[0], found)[0, 0, place] - exact) < told < 3e-3 * abs(loads[1])
    # What the orders that are left out bend and scatter is below the tolerance.
    assert np.abs(scattered[count:]).max(initial=0.0) < tolerance > np.abs(edge[count:]).max(initial=0.0)
    assert abs(table.energy_residual[0, 0]) < 10.0 * tolerance


def test_a_rigid_disc_has_the_added_mass_of_the_closed_forms() -> None:
    """Below a disc among ψ = 0 heave has 4/3 ρa³, pitch 8/45 ρa⁵; below one among a lid 8/3 and 4/15."""
    body = {"radius": 2.0, "rigid": True, "mass_per_area": 10.0}
    (table,) = solved(body, math.inf, 1e-4, radiation(math.inf, 0.0)).radiation
    units = 1000.0 * np.array([2.0**3, 2.0**5])
    for mass, known, error in zip(
        table.added_mass, ([4 / 3, 8 / 45], [8 / 3, 4 / 15]), table.relative_error, strict=True
    ):
        np.testing.assert_allclose(np.diag(mass) / units, known, rtol=error)
    np.testing.assert_allclose(np.diag(table.inertia), 10.0 * math.pi * np.array([4.0, 4.0]), rtol=1e-12)


def test_a_rigid_disc_moves_in_waves_as_its_forces_say() -> None:
    """[C − ω²(M + a) − iωb] ξ = X; orders above 1 scatter waves from a plate that has no shape of theirs."""
    omega, body = 2.0, {"radius": 1.0, "rigid": True, "mass_per_area": 10.0}
    requests = radiation(omega), response(omega)
    solution = solved(body, math.inf, 1e-4, *requests)
    (forces,), (moved,) = solution.radiation, solution.response
    dynamic = forces.stiffness - omega**2 * (forces.inertia + forces.added_mass[0])
    dynamic = dynamic - 1j * omega * forces.radiation_damping[0]
    known = np.linalg.solve(dynamic, forces.excitation_force[0, 0, 0])
    np.testing.assert_allclose(moved.amplitudes[0, 0], known, rtol=1e-3)
    assert moved.partial_waves.shape[-1] > 2
    np.testing.assert_allclose(np.abs(1.0 + 2.0 * moved.partial_waves), 1.0, atol=1e-4)
    np.testing.assert_array_equal(moved.plates[0].bending_moment, 0.0)


@pytest.mark.parametrize(("order", "zero"), [(0, 3.83170597), (1, 1.84118378), (3, 4.20118894)])
def test_a_dry_membrane_vibrates_at_the_zeros_of_bessel_functions(order: int, zero: float) -> None:
    """T Δw = −ω²m w with ∂w/∂r = 0 at the edge: ω a √(m/T) = j′."""
    line = PlateLine(
        start=0.0,
        end=1.0,
        round=True,
        transverse=order,
        poisson_ratio=0.3,
        edges=("free",) * 2,
        rigidity=0.0,
        tension=2.0,
    )
    modes = dry_modes(line, 14)
    assert modes.rigid == (order == 0)
    assert math.sqrt(modes.eigenvalues[modes.rigid] / 2.0) == pytest.approx(zero, rel=1e-8)


def test_moments_are_those_of_the_deflection() -> None:
    """M = D ∂²w/∂x² along the waves where ν = 0; below and at the free edges it vanishes."""
    body = {"radius": 1.0, "flexural_rigidity": 50.0, "poisson_ratio": 0.0, "mass_per_area": 5.0}
    (table,) = solved(body, 2.0, 1e-2, response(3.0, positions=201)).response
    (plate,) = table.plates
    x = plate.positions
    w, moment = CubicSpline(x, plate.deflection[0, 0]), plate.bending_moment[0, 0]
    # Both come from the modes, by two ways: shapes, and the loads on them.
    inner = slice(10, -10)
    np.testing.assert_allclose(moment[inner], 50.0 * w(x[inner], 2), atol=0.05 * np.abs(moment).max())
    assert np.abs(moment[[0, -1]]).max() < 0.02 * np.abs(moment).max()


@SLOW
@pytest.mark.parametrize(
    ("body", "depth", "omega"),
    [
        ({"radius": 1.0, "youngs_modulus": 1e6, "thickness": 0.02, "mass_per_area": 5.0}, 0.5, 2.5),
        ({"radius": 1.0, "flexural_rigidity": 3e3, "mass_per_area": 50.0}, math.inf, 3.0),
        (
            {"outline": "ring", "radius": 2.0, "inner_radius": 1.0, "flexural_rigidity": 300.0, "mass_per_area": 10.0},
            3.0,
            3.0,
        ),
        ({"radius": 1.0, "flexural_rigidity": 50.0, "tension": 1e3, "mass_per_area": 5.0}, 2.0, 4.0),
    ],
    ids=["soft", "stiff", "ring", "tension"],
)
def test_errors_of_moments_and_shear_forces_are_told(body: dict[str, Any], depth: float, omega: float) -> None:
    """By the scattered waves, by the polynomials and by the orders that are left out."""
    fine, *plates = (solved(body, depth, one, response(omega)).response[0].plates[0] for one in (1e-6, 1e-2, 1e-3))
    for plate in plates:
        for name in ("bending_moment", "shear_force"):
            off = np.abs(getattr(plate, name) - getattr(fine, name)).max()
            assert off < getattr(plate, f"{name}_error")[0, 0] < 30.0 * off


@pytest.mark.slow
def test_bending_modes_radiate_as_much_as_they_are_damped() -> None:
    """The four lowest shapes of a disc are of the orders 2, 0, 3 and 1; energy and Haskind hold for each."""
    body = {"radius": 1.0, "flexural_rigidity": 100.0, "mass_per_area": 10.0}
    (table,) = solved(body, 2.0, 1e-6, radiation(3.0, math.inf)).radiation
    assert table.dofs == ["heave", "pitch", "elastic 0-1", "elastic 1-1", "elastic 2-1", "elastic 3-1"]
    assert max(table.energy_residual[0], table.haskind_residual[0]) < 1e-8
    # Orders do not couple, and the shapes of one do.
    coupled = np.abs(table.added_mass[0]) > 0.0
    np.testing.assert_array_equal(coupled[0], [True, False, True, False, False, False])
    np.testing.assert_array_equal(coupled[1], [False, True, False, True, False, False])


@pytest.mark.slow
def test_a_thin_ring_of_large_radius_heaves_as_a_strip() -> None:
    """Per metre of its circumference, with an error of order 1/R."""
    section = {"kind": "beam", "length": 2.0, "flexural_rigidity": 1e6, "mass_per_length": 50.0}
    request = radiation(math.inf, elastic_modes=0)
    (plane,) = answer(sea(section, depth=3.0, tolerance=1e-5), request).radiation
    differences = []
    for radius in (10.0, 20.0):
        body = {"outline": "ring", "radius": radius + 1.0, "inner_radius": radius - 1.0, "rigid": True}
        (ring,) = solved(body | {"mass_per_area": 50.0}, 3.0, 1e-5, request).radiation
        per_metre = ring.added_mass[0, 0, 0] / (2.0 * math.pi * radius)
        differences.append(abs(per_metre / plane.added_mass[0, 0, 0] - 1.0))
    assert differences[1] < 0.02
    assert differences[1] < 0.6 * differences[0]


@pytest.mark.slow
def test_bending_resonances_are_found_and_counted() -> None:
    """The lowest ones of a soft disc are of several orders; none is missing."""
    body = {"radius": 1.0, "flexural_rigidity": 400.0, "mass_per_area": 10.0}
    solution = solved(body, math.inf, 1e-4, {"kind": "resonance", "count": 3, "largest_damping": 0.3})
    (table,) = solution.resonance
    assert solution.status == "ok"
    assert any("elastic" in label for label in table.labels)
    assert np.all(table.omega.imag < 0.0)


@pytest.mark.slow
def test_irregular_waves_are_regular_ones_summed() -> None:
    """Transfer functions at points on both sides of the axis, of all orders together, against regular waves."""
    body = {"radius": 1.0, "youngs_modulus": 1e7, "thickness": 0.02, "poisson_ratio": 0.4, "mass_per_area": 5.0}
    # Nothing is beyond a table.
    waves = {"kind": "spectrum", "waves": "table", "omega": [1.0, 1.5, 2.0, 2.5], "density": [0.0, 1e-3, 8e-4, 0.0]}
    points = {"points": [{"at": [0.5, 0.0]}, {"at": [-0.7, 0.0]}], "positions": 11}
    solution = solved(body, 2.0, 1e-2, waves | points)
    assert solution.status == "ok"
    found = curves(solution.result)
    omegas = (1.1, 1.8, 2.4)
    (regular,) = solved(body, 2.0, 1e-4, response(*omegas, positions=21)).response
    (plate,) = regular.plates
    for quantity, known in (
        ("heave", regular.amplitudes[:, 0, 0]),
        ("point 1 up", plate.deflection[:, 0, 15]),
        ("point 2 up", plate.deflection[:, 0, 3]),
        ("point 1 bending moment", plate.bending_moment[:, 0, 15]),
    ):
        between = CubicSpline(found.omega, found.transfer[quantity])(omegas)
        # The tolerance of the spectrum is 1e-2, errors that are told are several times the true ones.
        np.testing.assert_allclose(between, known, atol=2e-3 * np.abs(known).max())


@pytest.mark.slow
def test_loads_in_a_sea_state_keep_the_tolerance() -> None:
    """Of an ice floe in waves up to ka = 9, against a tolerance ten times smaller."""
    body = {"radius": 10.0, "youngs_modulus": 6e9, "thickness": 0.3, "poisson_ratio": 0.3, "mass_per_area": 277.0}
    waves = {"kind": "spectrum", "waves": "table", "omega": [1.0, 1.5, 2.0, 3.0], "density": [0.0, 1e-2, 6e-3, 0.0]}
    solutions = [solved(body, math.inf, one, waves | {"positions": 21}) for one in (1e-2, 1e-3)]
    assert solutions[0].status == "ok"
    found, known = (one.spectrum[0] for one in solutions)
    for name in ("deflection", "bending_moment", "shear_force"):
        one, other = (getattr(table.plates[0], f"significant_{name}") for table in (found, known))
        assert abs(one / other - 1.0) < getattr(found.plates[0], f"{name}_error") < 1e-2, name
    off = abs(found.mean_drift_force - known.mean_drift_force)
    assert off < found.mean_drift_error < 1e-2 * known.mean_drift_force


@pytest.mark.slow
def test_motions_of_shapes_settle_to_those_in_regular_waves() -> None:
    """Of several orders, with impulse responses whose a∞ is that of the limit of infinite frequency."""
    body = {"radius": 1.0, "flexural_rigidity": 700.0, "mass_per_area": 5.0}
    omega, times = 2.5, [40.0, 40.7, 41.9]
    wave = {"omega": omega, "amplitude": 0.1, "phase": 0.4}
    solution = solved(
        body,
        2.0,
        1e-3,
        {"kind": "impulse_response", "times": [0.0, 0.5], "elastic_modes": 2},
        {"kind": "motion", "times": times, "waves": [wave], "ramp": 5.0, "elastic_modes": 2},
        radiation(omega, math.inf, elastic_modes=2),
    )
    # The damping of bending shapes falls too slowly for K itself, and the motion does not need it.
    assert all("impulse_response" in reason for reason in solution.summary["reasons"])
    (impulse,), (motion,), (forces,) = solution.impulse_response, solution.motion, solution.radiation
    assert impulse.dofs == motion.dofs == forces.dofs == ["heave", "pitch", "elastic 0-1", "elastic 2-1"]
    size = forces.added_mass[1].max()
    # Both keep the tolerance.
    np.testing.assert_allclose(impulse.infinite_frequency_added_mass, forces.added_mass[1], atol=1e-3 * size)
    (table,) = solved(body, 2.0, 1e-4, response(omega)).response
    known = table.amplitudes[0, 0, [table.dofs.index(dof) for dof in motion.dofs]]
    turned = (np.exp(-1j * omega * np.array(times))[:, None] * 0.1 * np.exp(0.4j) * known).real
    # The further shapes, which the motion leaves out, change these by 1e-3 of the largest.
    np.testing.assert_allclose(motion.displacement, turned, atol=3e-3 * np.abs(turned).max())


@pytest.mark.slow
def test_a_resonance_of_the_water_that_bends_a_plate_a_little_is_not_missed() -> None:
    """Its −Im ω/Re ω is 0.4985, within the default range; the water beside a fixed disc has its own at 0.5056, outside.

    Eigenvalues of the scaled problem on meshes for 1e-3 to 1e-7 tend to it; they do not depend on α.
    """
    body = {"radius": 1.0, "flexural_rigidity": 400.0, "mass_per_area": 10.0}
    solution = solved(body, math.inf, 1e-3, {"kind": "resonance", "count": 3})
    (table,) = solution.resonance
    assert solution.status == "ok"
    assert np.abs(table.omega - (4.1121 - 2.0499j)).min() < 1e-3 * 4.6
