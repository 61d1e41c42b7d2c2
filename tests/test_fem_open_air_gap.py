"""The elevation of the water at points, less the motion of these: against waves far away, and a closed form."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from scipy.special import h1vp, hankel1, jvp

from hydroelastic.fem.open_water.surface_elevation import incident_elevations
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.solve import solve_open

GRAVITY, TOLERANCE = 9.81, 1e-2
SECTION: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 2.0, "half_height": 1.0, "draught": 1.0}
FAR, EDGE = 14.0, 2.0


def solved(body: dict[str, Any], depth: float, waves: dict[str, Any], *further: dict[str, Any]) -> Any:
    scene = SeaScene(
        sea={"drawn": [-15.0, 15.0]},
        liquid=[{"density": 1000.0, "depth": depth}],
        body=[body],
        analysis=[{"kind": "spectrum"} | waves, *further],
        accuracy={"tolerance": TOLERANCE},
    )
    solution = solve_open(scene, MPI.COMM_WORLD, lambda _message: None)
    assert solution.status == "ok", solution.reasons
    return solution


def band(omega: float, *points: dict[str, Any]) -> dict[str, Any]:
    """Waves of unit variance about a frequency."""
    frequencies = [omega - 0.02, omega, omega + 0.02]
    return {"waves": "table", "omega": frequencies, "density": [0.0, 50.0, 0.0], "air_gaps": list(points)}


@pytest.mark.mpi
def test_water_rises_as_far_waves_and_the_motion_of_the_point_say() -> None:
    """Far from a section over a bed waves are e^{ikx} + R e^{−ikx} and T e^{ikx}; at its edge it moves with them."""
    # The middle of frequencies in a geometric series.
    omega, depth = math.sqrt(1.98 * 2.02), 4.0
    body = SECTION | {"motions": ["heave", "roll"], "vertical_centre_of_gravity": 0.0, "radius_of_gyration": 1.2}
    points = [{"at": [-FAR, 2.0]}, {"at": [FAR, 2.0]}, {"at": [EDGE, 1.0]}, {"at": [EDGE, 1.0], "body": 1}]
    solution = solved(body, depth, band(2.0, *points), {"kind": "response", "omega": [omega]})
    (table,), (regular,) = solution.spectrum, solution.response
    place = int(np.argmin(np.abs(table.omega - omega)))
    assert table.omega[place] == pytest.approx(omega, abs=1e-9)
    found = dict(zip(table.quantities, table.transfer[place], strict=True))
    phase = np.exp(1j * regular.wavenumbers[0, 0] * FAR)
    reflected, passed = regular.reflection[0, 0, 0], regular.transmission[0, 0, 0]
    assert 0.2 < abs(reflected) < 0.98
    # Evanescent waves have decayed to e^{−9}; R, T and the elevation have errors of their own.
    assert found["relative elevation 1"] == pytest.approx(1.0 / phase + reflected * phase, abs=TOLERANCE)
    assert found["relative elevation 2"] == pytest.approx(passed * phase, abs=TOLERANCE)
    edge = found["heave"] + EDGE * found["roll"]
    assert abs(edge) > 0.3
    assert found["relative elevation 4"] == pytest.approx(found["relative elevation 3"] - edge, abs=1e-9)
    gap = table.air_gaps[1]
    assert gap.smallest_air_gap == pytest.approx(2.0 - gap.relative_elevation.largest_amplitude)
    # m₀ of the waves is 1, and hardly any of T changes in the band.
    assert gap.relative_elevation.significant_amplitude == pytest.approx(2.0 * abs(passed), rel=3e-2)


@pytest.mark.parametrize(("waves_from", "towards"), [("left", 1.0), ("right", -1.0)])
def test_the_free_top_of_two_liquids_rises_less_than_the_interface(waves_from: str, towards: float) -> None:
    """η/ζ = ω²/(ω² cosh kh − gk sinh kh) of the top at h above an interface on which a wave ζ travels."""
    omega, height, crest, x = 1.0, 1.0, 0.5, 2.0
    layers = TwoLayers(
        density_below=1000.0, density_above=800.0, depth_below=4.0, depth_above=height, gravity=GRAVITY, top="free"
    )
    wave = travelling_waves(layers, omega)[0]
    k = wave.wavenumber
    basin = SimpleNamespace(phase_at=crest, units=SimpleNamespace(length=1.0))
    response = SimpleNamespace(incidence=SimpleNamespace(planes=[SimpleNamespace(wave=wave)]), incident=[0])
    curves: Any = SimpleNamespace(solver=SimpleNamespace(model=SimpleNamespace(basin=basin)), responses=[response])
    request: Any = SimpleNamespace(waves_from=waves_from, air_gaps=[SimpleNamespace(at=(x, 3.0))])
    ((found,),), _ = incident_elevations(curves, request)
    ratio = omega**2 / (omega**2 * math.cosh(k * height) - GRAVITY * k * math.sinh(k * height))
    assert -0.2 < ratio < 0.0
    # The slope at the top is a difference of two exponentials that nearly cancel.
    assert found == pytest.approx(ratio * np.exp(1j * towards * k * (x - crest)), rel=1e-10)


def test_the_edge_of_a_limp_plate_stays_on_the_water() -> None:
    plate = {"kind": "plate", "outline": "disc", "radius": 1.0, "mass_per_area": 1.0, "flexural_rigidity": 10.0}
    edge = {"at": [1.0, 1.0]}
    waves = band(2.0, edge, edge | {"body": 1}) | {"points": [edge | {"at": [1.0, 0.0]}]}
    (table,) = solved(plate | {"poisson_ratio": 0.3}, math.inf, waves).spectrum
    # At a free edge there is no moment, whose relative error would be infinite.
    assert {one for one in table.quantities if "point" in one} == {"point 1 up", "point 1 acceleration up"}
    fixed, moving = (
        np.abs(table.transfer[:, table.quantities.index(f"relative elevation {number}")]) for number in (1, 2)
    )
    # Its mass and its bending are a hundredth of the water's; it follows a wave of nearly unit height.
    assert np.abs(fixed - 1.0).max() < 2e-2
    assert moving.max() < 2e-2


@pytest.mark.slow
def test_water_around_a_deep_cylinder_rises_as_around_one_on_the_bed() -> None:
    """e^{ikx} − Σ εₙ iⁿ Jₙ′(ka)/Hₙ′(ka) Hₙ(kr) cos nθ of MacCamy and Fuchs, up to e^{−kd} = 6e-6."""
    wavenumber = 2.0
    omega = math.sqrt(GRAVITY * wavenumber)
    places = [(-1.0, 0.0), (1.0, 0.0), (0.0, 1.5), (-0.5, -1.5)]
    points = [{"at": [x, 4.0], "across": y} for x, y in places]
    body = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 6.0, "motions": ["heave"]}
    (table,) = solved(body | {"vertical_centre_of_gravity": -4.0}, math.inf, band(omega, *points)).spectrum
    place = int(np.argmin(np.abs(table.omega - omega)))
    orders = np.arange(30)
    parts = np.where(orders, 2.0, 1.0) * 1j**orders * jvp(orders, wavenumber) / h1vp(orders, wavenumber)
    names = [table.quantities.index(f"relative elevation {number + 1}") for number in range(len(places))]
    for (x, y), found in zip(places, table.transfer[place, names], strict=True):
        around = hankel1(orders, wavenumber * math.hypot(x, y)) * np.cos(orders * math.atan2(y, x))
        assert found == pytest.approx(np.exp(1j * wavenumber * x) - parts @ around, abs=TOLERANCE)


@pytest.mark.parametrize(
    ("gap", "message"),
    [
        ({"at": [0.5, 2.0]}, "below it there is .*body.* number 1, which reaches from -2 to 2 m"),
        ({"at": [3.0, -0.5]}, "is not above the still water"),
        ({"at": [16.0, 2.0]}, "outside what is drawn"),
        ({"at": [3.0, 2.0], "across": 1.0}, "a section is the same at any distance across"),
        ({"at": [3.0, 2.0], "body": 2}, "there is no body of that number"),
    ],
)
def test_points_without_water_below_are_refused(gap: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        solved(SECTION | {"motions": ["heave"]}, 4.0, band(2.0, gap))
