"""Two liquids in one tank: waves and beams on their interface and top against closed forms, and identities."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from answers import answer, assert_alike, kept
from section_tanks import GRAVITY, REFERENCES, layered, rigid

import hydroelastic as he
from hydroelastic.modal.liquid.two_layer import InterfacePlate, LayerTop, TwoLayers, tank_modes

ROWS: dict[str, dict[str, Any]] = {
    row["case"]: row for row in json.loads((REFERENCES / "two_liquid_beam.json").read_text(encoding="utf-8"))["rows"]
}
BEAMS: dict[str, Any] = json.loads((REFERENCES / "two_liquid_beams.json").read_text(encoding="utf-8"))["cases"]
TOPS: tuple[LayerTop, ...] = ("rigid", "free", "pressure_release")
COVER = {"start": 0.0, "length": 1.0, "ends": "guided"}


def interface_beam(**changes: Any) -> he.Beam:
    """The beam of the public reference."""
    given = {"start": 0.3, "length": 0.4, "mass_per_length": 4.0, "flexural_rigidity": 50.0}
    return he.Beam(**(given | changes))


def exact(scene: he.TankScene, plate: InterfacePlate | None = None) -> list[float]:
    """ω of a tank without floats whose interface is bare, or wholly covered."""
    below, above = scene.liquid
    layers = TwoLayers(
        density_below=below.density,
        density_above=above.density,
        depth_below=below.depth,
        depth_above=above.depth,
        gravity=GRAVITY,
        top=scene.tank.top,
    )
    return [mode.omega for mode in tank_modes(layers, scene.tank.length, scene.accuracy.modes, plate)]


def check(scene: he.TankScene, omega: Any, bound: float) -> None:
    """The tolerance asked is kept, and no error exceeds its estimate, nor the bound."""
    found = kept(scene)
    errors = np.abs(found.errors(omega))
    assert errors.max() <= bound
    assert np.all(errors <= found.estimates)


# Thin layers leave a tolerance of 5e-10 to rounding.
DEPTHS = [((0.3, 0.2), 1e-10), ((1.0, 0.01), 1e-9), ((0.01, 1.0), 1e-9)]


@pytest.mark.slow_but("alike-850.0-*", "1 to 100-999.9-free")
@pytest.mark.slow_on_ranks_but("alike-850.0-free")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("density", [990.0, 999.9, 850.0])
@pytest.mark.parametrize(("depths", "tolerance"), DEPTHS, ids=["alike", "1 to 100", "100 to 1"])
def test_waves_of_two_layers_keep_a_tolerance(
    top: LayerTop, density: float, depths: tuple[float, float], tolerance: float
) -> None:
    """With a free top and alike layers both branches are among fourteen modes."""
    scene = layered(densities=(1000.0, density), depths=depths, top=top, tolerance=tolerance, modes=14)
    # Measured: 6e-12 in layers that are alike, 1e-10 in thin ones.
    check(scene, exact(scene), tolerance)


def test_a_light_upper_liquid_has_both_branches() -> None:
    scene = layered(densities=(1000.0, 100.0), top="free", tolerance=1e-9, modes=14)
    check(scene, exact(scene), 1e-9)


@pytest.mark.slow_but("True-*", "False-free")
@pytest.mark.slow_on_ranks_but("True-rigid")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("hydrostatic", [True, False])
def test_a_guided_plate_on_the_interface_keeps_a_tolerance(top: LayerTop, hydrostatic: bool) -> None:
    scene = layered(interface_beam(**COVER, hydrostatic=hydrostatic), top=top, tolerance=1e-9)
    plate = InterfacePlate(flexural_rigidity=50.0, mass_per_length=4.0, hydrostatic=hydrostatic)
    check(scene, exact(scene, plate), 1e-9)
    if top == "free":
        # Far above the waves a free top has ψ = 0; liquids that a cover parts do not move as one.
        released = exact(layered(top="pressure_release", modes=1), plate)[0]
        tone = answer(scene).summary["first_elastic"]
        assert tone["pressure_release_omega"] == pytest.approx(released, rel=1e-9)


@pytest.mark.parametrize("name", ROWS)
def test_a_beam_on_the_interface_has_the_public_reference(name: str) -> None:
    row = ROWS[name]
    scene = layered(
        *((interface_beam(start=row["x0"], length=row["l"]),) if row["m"] else ()),
        densities=(row["rho2"], row["rho1"]),
        depths=(row["h2_bottom"], row["h1_top"]),
        length=row["L"],
        tolerance=1e-9,
        modes=8,
    )
    # Eight digits are printed, 2e-8 of the last place of 1.2657389 at the least; its two resolutions differ by 1.2e-8.
    assert kept(scene).omega == pytest.approx([row[f"w{number}"] for number in range(1, 9)], rel=4e-8)


@pytest.mark.slow_but("open_beams_on_both", "beam_at_the_wall")
@pytest.mark.parametrize("name", BEAMS)
def test_beams_on_both_levels_have_the_references_of_harmonic_functions(name: str) -> None:
    case = BEAMS[name]
    omega = [float(text) for text in case["omega"]]
    scene = he.TankScene(**case["scene"], accuracy={"tolerance": 1e-7, "modes": len(omega)})
    # The references have eleven digits.
    check(scene, omega, 1e-7)


THIN_AIR = {
    "waves": (),
    "beam": (interface_beam(start=0.2),),
    "circle": (rigid("ellipse", 0.4, "heave sway roll", half_width=0.1, half_height=0.1, centre_of_mass=-0.02),),
    "rectangle": (rigid("rectangle", 0.4, "heave sway roll", half_width=0.15, half_height=0.1),),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", THIN_AIR)
def test_a_lighter_and_lighter_upper_liquid_becomes_air(kind: str) -> None:
    """ω is a smooth function of ρ₁ up to ρ₁ = 0; the least that is modelled is ρ₁ = 10⁻⁶ ρ₂."""

    def omega(*densities: float) -> np.ndarray:
        return kept(layered(*THIN_AIR[kind], densities=densities, top="free" if len(densities) == 1 else "rigid")).omega

    air = omega(1000.0)
    once, twice = omega(1000.0, 1e-3), omega(1000.0, 2e-3)
    # A liquid of 10⁻⁶ is felt by as much, 1e-6 … 4e-6.
    assert np.abs(once / air - 1.0).max() > 1e-7
    # What is left is of second order, 1e-11, beside errors that are alike on alike meshes but 1e-10 at corners.
    assert 2.0 * once - twice == pytest.approx(air, rel=1e-9)


@pytest.mark.slow_but("free-beam")
@pytest.mark.parametrize("kind", THIN_AIR)
@pytest.mark.parametrize("top", TOPS)
def test_an_upper_liquid_without_density_is_air(kind: str, top: LayerTop) -> None:
    bodies = THIN_AIR[kind]
    with_air = answer(layered(*bodies, densities=(1000.0, 0.0), top=top)).omega
    # The same matrices.
    assert with_air == pytest.approx(answer(layered(*bodies, densities=(1000.0,), top="free")).omega, rel=1e-13)


@pytest.mark.slow_on_ranks_but
@pytest.mark.slow_but("free")
@pytest.mark.mpi
@pytest.mark.parametrize("top", TOPS)
def test_halves_give_the_modes_of_the_whole_tank(top: LayerTop) -> None:
    halves, whole = (answer(layered(interface_beam(start=0.3 + shift), top=top, modes=8)) for shift in (0.0, 1e-9))
    assert [one.summary["modes"][0]["symmetry"] is not None for one in (halves, whole)] == [True, False]
    # The shift is felt in its square, as the middle is a place of symmetry.
    assert_alike(halves, whole)


@pytest.mark.parametrize("top", ["rigid", "free"])
def test_both_liquids_keep_their_volume_and_move_with_their_surfaces(top: LayerTop) -> None:
    """∫η over each level and its bodies is zero; w of a float of width 2b takes 2b per unit of heave."""
    bodies = (interface_beam(start=0.1, length=0.3), rigid("rectangle", 0.7, half_width=0.1, half_height=0.05))
    data = he.solve(layered(*bodies, top=top, tolerance=1e-6, modes=4)).dataset
    names = [str(name) for name in data if str(name).startswith(("deflection_of", "elevation_of"))]
    volumes = {}
    for name in names:
        curve, (place,) = data[name], [dim for dim in data[name].dims if str(dim).startswith("position")]
        level = "top" if "free_surface" in name else "interface"
        volumes[level] = volumes.get(level, 0.0) + np.trapezoid(curve.values, data[place].values, axis=1)
    volumes["interface"] = volumes["interface"] + 0.2 * data.displacement_of_body_2.values[:, 0, 1]
    largest = max(np.abs(data[name].values).max() for name in names)
    assert volumes.keys() == ({"interface", "top"} if top == "free" else {"interface"})
    for moved in volumes.values():
        # Trapezoids between samples 0.004 m apart of waves with k of some 20/m: (kh)²/12 is 5e-4.
        assert np.abs(moved).max() <= 1e-3 * largest
