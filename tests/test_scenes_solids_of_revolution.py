"""Scenes of solids of revolution, in the sea and in round tanks: what is read, refused and told."""

from __future__ import annotations

import json
from math import inf, pi, sqrt, tanh
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from pydantic import ValidationError

from hydroelastic.output.open_water.quantities import RESPONSE
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.canal import CanalScene
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.round_tank import RoundTankScene
from hydroelastic.scenes.models.sea import SeaScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_kinds import is_canal, is_round_tank
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.open_water.solve import solve_open
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.round_tank.run import run_round_tank
from hydroelastic.scenes.tank.check_tables import hydrostatics_table
from hydroelastic.scenes.tank.run import run_tank

SHIPPED = Path(__file__).parent.parent / "results" / "shipped"
CYLINDER: dict[str, Any] = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 1.0}
WATER: list[dict[str, Any]] = [{"density": 1000.0, "depth": 10.0}]


def sea(*bodies: dict[str, Any], **more: Any) -> SeaScene:
    """Return a scene of the sea."""
    return SeaScene.model_validate({"liquid": WATER, "body": list(bodies), **more})


def refusal(**given: Any) -> str:
    """Return why a solid is refused."""
    with pytest.raises(ValidationError) as caught:
        RevolvedFloat.model_validate(given)
    return str(caught.value)


def test_the_shape_tells_a_solid_from_a_section() -> None:
    section = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0}
    assert sea(CYLINDER).is_revolved
    assert not sea(section).is_revolved
    with pytest.raises(ValidationError, match="other bodies of the scene are solids of revolution"):
        sea(CYLINDER, section)


def test_keys_that_do_not_fit_are_refused() -> None:
    assert "needs it" in refusal(shape="cylinder", radius=1.0)
    assert "does not belong" in refusal(shape="cone", radius=1.0, draught=1.0, inner_radius=0.5)
    assert "inside the ring" in refusal(shape="cylinder", radius=1.0, inner_radius=1.0, draught=1.0)
    assert "under water" in refusal(shape="sphere", radius=1.0, draught=2.0)
    assert "one side of a section" in refusal(shape="revolved", outline=[[0, -1], [1, -1], [0, 0], [1, 1]])
    with pytest.raises(ValidationError, match="sections only"):
        sea(CYLINDER, analysis=[{"kind": "resonance", "largest_damping": 1.0}], liquid=[{**WATER[0]}])
    with pytest.raises(ValidationError, match="only the response to waves from the left in one liquid is drawn"):
        sea(CYLINDER, analysis=[{"kind": "radiation", "omega": [1.0], "fields_at": [1.0]}])
    with pytest.raises(ValidationError, match="the response is not solved for there"):
        sea(CYLINDER, analysis=[{"kind": "response", "omega": [1.0], "fields_at": [1.1]}])


def test_the_capture_width_is_the_power_of_the_damper_over_that_of_a_metre_of_crest() -> None:
    """½Bω²|ξ|² over ½ρg c_g of deep water, c_g = g/(2ω)."""
    omega, damping = 2.0, 4e3
    scene = sea(
        CYLINDER | {"motions": ["heave"]},
        liquid=[{"density": 1000.0, "depth": inf}],
        attachment=[{"damping": [damping, 0.0, 0.0]}],
        analysis=[{"kind": "response", "omega": [omega]}],
        accuracy={"tolerance": 1e-2},
    )
    (table,) = RESPONSE.of(solve_open(scene, MPI.COMM_WORLD, lambda _message: None))
    taken = damping * omega**2 * abs(table.amplitudes[0, 0, 0]) ** 2
    # The same motion, so that rounding is left.
    assert RESPONSE.evaluated(table)["capture_width"][0][0] == pytest.approx(
        taken / (1000.0 * 9.81**2 / (2.0 * omega)), rel=1e-9
    )


def test_results_of_solids_are_whole_and_named_as_theirs() -> None:
    """Units, degrees of freedom, partial waves; a floating body without damping absorbs nothing."""
    scene = sea(
        CYLINDER | {"motions": ["heave", "surge"]},
        analysis=[{"kind": "radiation", "omega": [1.0]}, {"kind": "response", "omega": [1.0]}],
        accuracy={"tolerance": 1e-3},
    )
    outcome = run_open(scene)
    summary = outcome.summary
    assert summary["radiation"][0]["dofs"] == ["heave", "surge"]
    response = summary["response"][0]
    assert response["reflection"] is None
    assert len(response["partial_waves"][0][0][0]) >= 2
    assert response["scattering_width"][0][0] > 0.0
    assert response["capture_width"] == [[0.0]]
    headings = {heading for section in outcome.sections for heading in section.headings}
    assert {"a, kg", "b, kg/s", "|f|, N/m"} <= headings
    # ρgπ of long waves, the displaced mass, MacCamy and Fuchs' force over the draught: at Ka = 0.1 too large, so that
    # their squares, the dampings, are 1.42 and 1.59 times those of the field.
    rows = summary["estimates"]["round_body"]["rows"]
    assert [row["quantity"].split(",")[0] for row in rows] == [
        "|X| of heave in long waves",
        "b of heave by Haskind from long waves",
        "a of surge by strips",
        "|X| of surge by MacCamy and Fuchs",
        "b of surge by Haskind from that",
    ]
    assert rows[0]["theory"] == pytest.approx(9810.0 * pi)
    assert rows[2]["theory"] == pytest.approx(1000.0 * pi)
    np.testing.assert_allclose([row["difference"] for row in rows], [0.193, 0.424, 0.631, 0.262, 0.592], atol=2e-3)
    at_rest = next(section for section in outcome.sections if section.title == "Bodies at rest")
    # m = ρπ; c33 = ρgπ; c55 = ρgπ(1/4 − 1/2), of a homogeneous cylinder as high above the water as below it.
    assert [*at_rest.rows[-1]] == ["hydrostatic stiffness of pitch c55, N·m", f"{-9810.0 * pi / 4:.6g}"]
    assert hydrostatics_table(scene).rows == at_rest.rows


@pytest.mark.slow
def test_results_of_round_plates_have_strain_and_every_order() -> None:
    body = {"kind": "plate", "outline": "ring", "radius": 2.0, "inner_radius": 0.5, "youngs_modulus": 1e7}
    outcome = run_open(
        sea(
            body | {"thickness": 0.05, "density": 500.0},
            analysis=[{"kind": "response", "omega": [2.0], "positions": 20}],
            accuracy={"tolerance": 1e-3},
        )
    )
    response = outcome.summary["response"][0]
    (plate,) = response["plates"]
    assert response["dofs"][:2] == ["heave", "pitch"]
    assert {"elastic 0-1", "elastic 1-1", "elastic 4-1"} <= set(response["dofs"])
    assert plate["positions"][0] == -2.0
    assert plate["positions"][-1] == 2.0
    # σ = E ε/(1 − ν) at most, where both principal strains are alike, and E ε/(1 + ν) at least.
    ratio = plate["largest_stress"][0][0] / plate["largest_strain"][0][0]
    assert 1e7 / 1.3 < ratio < 1e7 / 0.7
    titles = [section.title for section in outcome.sections]
    assert "Largest strain and stress at the faces of body 1, per unit elevation" in titles


def test_a_round_tank_with_a_float_or_a_bed_is_solved_by_order() -> None:
    tank = {"radius": 3.0, "outline": [[0.0, -3.0], [3.0, -1.0]]}
    document = {"tank": tank, "liquid": [{"density": 1000.0, "depth": 3.0}], "body": [CYLINDER]}
    assert is_round_tank(document)
    assert not is_round_tank({"tank": {"radius": 3.0}})
    scene = RoundTankScene.model_validate(document | {"accuracy": {"modes": 4, "tolerance": 1e-3}})
    modes = run_round_tank(scene).summary["modes"]
    assert [mode["order"] for mode in modes] == [1, 0, 2, 3]
    assert [mode["multiplicity"] for mode in modes] == [2, 1, 2, 2]
    assert modes[1]["kind"] == "heave"


@pytest.mark.parametrize(
    ("outline", "wrong"),
    [
        ([[0.0, -3.0], [2.0, -1.0]], "from the axis to the wall"),
        ([[0.0, -2.0], [3.0, -1.0]], "lowest corner"),
    ],
)
def test_a_bed_that_does_not_fit_is_refused(outline: list[list[float]], wrong: str) -> None:
    with pytest.raises(ValidationError, match=wrong):
        RoundTankScene.model_validate(
            {"tank": {"radius": 3.0, "outline": outline}, "liquid": [{"density": 1000.0, "depth": 3.0}]}
        )


def test_a_tank_of_one_section_over_a_width_is_solved_by_order() -> None:
    """A V canal of 45 degrees: ω² = g/H across, (gk/√2) tanh(kH/√2) along; a float heaves in order 0 alone."""
    bed = [[0.0, 0.0], [2.0, -2.0], [4.0, 0.0]]
    document = {"tank": {"length": 4.0, "width": 7.0, "outline": bed}, "liquid": [{"density": 1000.0, "depth": 2.0}]}
    assert is_canal(document)
    assert not is_canal({"tank": {"length": 4.0, "width": 7.0}})
    assert not is_canal({"tank": {"length": 4.0, "width": 7.0}, "body": [{"kind": "float", "shape": "box"}]})
    scene = CanalScene.model_validate(document | {"accuracy": {"modes": 3, "tolerance": 1e-4}})
    summary = run_round_tank(scene).summary
    modes, (exact,) = summary["modes"], summary["exact"]
    assert exact["order"] == 1
    assert abs(exact["difference"]) < 1e-6
    k = pi / 7.0 / 2.0**0.5
    assert [mode["order"] for mode in modes] == [1, 0, 2]
    assert {mode["multiplicity"] for mode in modes} == {1}
    # Both ψ are smooth.
    assert modes[0]["omega"] == pytest.approx((9.81 * k * tanh(2.0 * k)) ** 0.5, rel=1e-6)
    assert modes[1]["omega"] == pytest.approx((9.81 / 2.0) ** 0.5, rel=1e-6)


@pytest.mark.parametrize("top", ["free", "rigid"])
def test_two_liquids_in_a_box_are_solved_by_order(top: str) -> None:
    """Lamb, Hydrodynamics, § 231: with b = ω²/gk, (ρ₂c₁c₂ + ρ₁)b² − ρ₂(c₁ + c₂)b + ρ₂ − ρ₁ = 0, or
    (ρ₂c₂ + ρ₁c₁)b = ρ₂ − ρ₁ under a lid, cᵢ = coth khᵢ."""
    two = [{"density": 1000.0, "depth": 0.7}, {"density": 800.0, "depth": 0.5}]
    document = {"tank": {"length": 2.0, "width": 1.0, "top": top}, "liquid": two}
    assert is_canal(document)
    scene = CanalScene.model_validate(document | {"accuracy": {"modes": 5, "tolerance": 1e-6}})
    exact = []
    for along, across in ((1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (3, 0), (0, 2)):
        k = pi * np.hypot(along / 2.0, across)
        above, below = 1.0 / np.tanh(0.5 * k), 1.0 / np.tanh(0.7 * k)
        free = [1000.0 * above * below + 800.0, -1000.0 * (above + below), 200.0]
        covered = [1000.0 * below + 800.0 * above, -200.0]
        exact += [(9.81 * k * ratio) ** 0.5 for ratio in np.roots(free if top == "free" else covered)]
    found = [mode["omega"] for mode in run_round_tank(scene).summary["modes"]]
    np.testing.assert_allclose(found, np.sort(exact)[:5], rtol=1e-6)


@pytest.mark.slow
def test_without_waves_across_a_section_of_finite_width_is_the_plane() -> None:
    body = {"kind": "float", "shape": "rectangle", "half_width": 0.5, "half_height": 0.4, "position": 1.2}
    shared = {"liquid": [{"density": 1000.0, "depth": 2.0}], "accuracy": {"modes": 5, "tolerance": 1e-6}}
    wide = CanalScene.model_validate(shared | {"tank": {"length": 4.0, "width": 2.5}, "body": [body]})
    plane = TankScene.model_validate(shared | {"tank": {"length": 4.0}, "body": [body]})
    found = [mode["omega"] for mode in run_round_tank(wide).summary["modes"] if mode["order"] == 0]
    known = [mode["omega"] for mode in run_tank(plane).summary["modes"]]
    assert len(found) >= 2
    # Both to 1e-6.
    np.testing.assert_allclose(found, known[: len(found)], rtol=2e-6)


@pytest.mark.parametrize(
    ("body", "wrong"),
    [
        ('outline = "ring", radius = 2.0, flexural_rigidity = 1e3, mass_per_area = 1.0', "a ring needs it"),
        ('outline = "disc", radius = 2.0, mass_per_area = 1.0', "the stiffness of the plate is missing"),
        ('outline = "disc", radius = 2.0, rigid = true, tension = 1.0, mass_per_area = 1.0', "a rigid plate has none"),
        ('outline = "disc", radius = 2.0, tension = 1e-20, mass_per_area = 1.0', "beyond the resolution"),
        ('outline = "rectangle", radius = 2.0, rigid = true, mass_per_area = 1.0', '"disc" or "ring"'),
    ],
)
def test_round_plates_that_do_not_fit_are_refused(tmp_path: Path, body: str, wrong: str) -> None:
    assert wrong in said(tmp_path, f'kind = "plate", {body}')


def test_round_plates_that_overlap_are_refused(tmp_path: Path) -> None:
    disc = 'kind = "plate", outline = "disc", radius = 2.0, rigid = true, mass_per_area = 1.0'
    ring = 'kind = "plate", outline = "ring", radius = 4.0, inner_radius = 1.5, rigid = true, mass_per_area = 1.0'
    assert "overlaps or touches [[body]] number 1" in said(tmp_path, f"{disc}}}, {{{ring}")


def test_a_misspelt_solid_shape_is_told(tmp_path: Path) -> None:
    assert 'Did you mean "cylinder"' in said(tmp_path, 'kind = "float", shape = "cylnder", radius = 1.0, draught = 1.0')
    assert 'Did you mean "ellipse"' in said(tmp_path, 'kind = "float", shape = "elipse", half_width = 1.0')


def said(tmp_path: Path, body: str) -> str:
    """Return the message about a body of the sea."""
    scene = tmp_path / "scene.toml"
    scene.write_text(f'kind = "sea"\nliquid = [{{density = 1000.0, depth = 10.0}}]\nbody = [{{{body}}}]\n')
    with pytest.raises(SceneError) as caught:
        read_scene(scene)
    return str(caught.value)


def test_messages_name_the_keys_of_the_body_at_hand(tmp_path: Path) -> None:
    """A section and a solid are both of kind "float"."""
    solid = 'kind = "float", shape = "cylinder", radius = 1.0'
    negative = said(tmp_path, f"{solid}, draught = -1.0")
    assert 'key "draught" = -1.0: it is too small. Allowed: a positive number' in negative
    misplaced = said(tmp_path, f"{solid}, draught = 1.0, half_width = 1.0")
    assert "inner_radius" in misplaced
    assert "belongs to kind" not in misplaced
    assert 'key "draught" = 12.0: the float reaches down' in said(tmp_path, f"{solid}, draught = 12.0")
    heavy = said(tmp_path, 'kind = "float", shape = "sphere", radius = 1.0, mass = 1e5')
    assert "with a volume of 4.18879 m³ it sinks. Allowed: between 0 and 4188.79 kg (Archimedes)" in heavy
    around = 'kind = "float", shape = "cylinder", radius = 2.0, inner_radius = 1.0, draught = 1.0'
    assert "[[body]] number 2: the body overlaps" in said(tmp_path, f"{solid}, draught = 1.0}}, {{{around}")
    section = 'kind = "float", shape = "ellipse", half_width = 1.0, half_height = 1.0'
    assert "half_width, half_height, tail" in said(tmp_path, f"{section}, colour = 1.0")
    assert '"beam" or "varying_beam" or "float" or "plate". ' in said(tmp_path, 'kind = "boat"')


def test_the_shipped_spar_heaves_with_the_water_of_its_plate() -> None:
    """Added mass of a disc with a column upon it, as naval architects estimate it: L. Tao et al., J. Sound Vib. 302."""
    stored = json.loads((SHIPPED / "spar" / "summary.json").read_text(encoding="utf-8"))
    disc, column, density = 20.0, 8.0, 1025.0
    z = sqrt(disc**2 - column**2) / pi
    added = density / 12.0 * (2.0 * disc**3 + 3.0 * pi * (disc**2 - column**2) * z - (pi * z) ** 3)
    heave = complex(*stored["resonance"][0]["omega"][0])
    mass = density * pi * (40.0 * 4.0**2 + 10.0**2)
    stiffness = density * 9.81 * pi * 4.0**2
    # The estimate is of a thin plate far from the surface; the radiated waves are weak, |ω| that of the undamped spar.
    assert abs(heave) == pytest.approx(sqrt(stiffness / (mass + added)), rel=0.03)


def test_a_float_on_the_axis_over_a_sloping_bed_is_of_three_dimensions() -> None:
    document = {"tank": {"radius": 3.0, "bed": {"slope": [0.1, 0.0]}}, "body": [CYLINDER]}
    assert not is_round_tank(document)
    upright = CYLINDER | {"vertical_centre_of_gravity": -0.5}
    assert LevelTankScene.model_validate(document | {"liquid": [{"density": 1000.0, "depth": 3.0}], "body": [upright]})
