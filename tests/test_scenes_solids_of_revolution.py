"""Scenes of solids of revolution, in the sea and in round tanks: what is read, refused and told."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.round_tank import RoundTankScene
from hydroelastic.scenes.models.sea import SeaScene
from hydroelastic.scenes.models.tank_kinds import is_round_tank
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.round_tank.run import run_round_tank
from hydroelastic.scenes.tank.check_tables import hydrostatics_table

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
    at_rest = next(section for section in outcome.sections if section.title == "Bodies at rest")
    # m = ρπ; c33 = ρgπ; c55 = ρgπ(1/4 − 1/2), of a homogeneous cylinder as high above the water as below it.
    assert [*at_rest.rows[-1]] == ["hydrostatic stiffness of pitch c55, N·m", f"{-9810.0 * pi / 4:.6g}"]
    assert hydrostatics_table(scene).rows == at_rest.rows


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
    section = 'kind = "float", shape = "ellipse", half_width = 1.0, half_height = 1.0'
    assert "half_width, half_height, tail" in said(tmp_path, f"{section}, colour = 1.0")
    assert '"beam" or "varying_beam" or "float". ' in said(tmp_path, 'kind = "boat"')


def test_a_float_on_the_axis_over_a_sloping_bed_is_of_three_dimensions() -> None:
    document = {"tank": {"radius": 3.0, "bed": {"slope": [0.1, 0.0]}}, "body": [CYLINDER]}
    assert not is_round_tank(document)
    upright = CYLINDER | {"vertical_centre_of_gravity": -0.5}
    assert LevelTankScene.model_validate(document | {"liquid": [{"density": 1000.0, "depth": 3.0}], "body": [upright]})
