"""Scenes of open water and of the sea: what is accepted, what is refused, and in which words."""

from __future__ import annotations

import json
import re
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

CIRCLE: dict[str, Any] = {"kind": "float", "shape": "ellipse", "position": 5.0, "half_width": 0.5, "half_height": 0.5}
CIRCLE |= {"motions": ["heave", "sway"]}
PLATE: dict[str, Any] = {"start": 1.0, "length": 3.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
DEEP: dict[str, Any] = {"density": 1000.0, "depth": inf}
OIL: dict[str, Any] = {"density": 800.0, "depth": 1.0}
WATER: dict[str, Any] = {"density": 1000.0, "depth": 2.0}
HIGH_OIL: dict[str, Any] = {"density": 800.0, "depth": inf}
RADIATION: dict[str, Any] = {"kind": "radiation", "omega": [1.0]}
RESPONSE: dict[str, Any] = {"kind": "response", "omega": [1.0]}
DECAY: dict[str, Any] = {"kind": "decay", "displacement": 0.1, "times": [1.0]}


def read(*bodies: dict[str, Any], liquids: Any = (DEEP,), analyses: Any = (), **more: Any) -> Any:
    """A scene with open ends: a circle in deep water unless other things are given."""
    tank = {"length": 10.0, "ends": "open"} | {key: more.pop(key) for key in ("top", "length") if key in more}
    given = {"tank": tank, "liquid": list(liquids), "body": list(bodies or (CIRCLE,)), "analysis": list(analyses)}
    return he.read({"kind": "tank"} | given | more)


def said(*bodies: dict[str, Any], **changes: Any) -> str:
    """What is said of a scene that is refused for one reason."""
    with pytest.raises(he.SceneError) as caught:
        read(*bodies, **changes)
    text = str(caught.value)
    assert "\n" not in text
    return text


def test_open_water_without_analyses_is_asked_for_its_resonances() -> None:
    assert [one.kind for one in read().analyses] == ["resonance"]


def test_sweeps_give_the_numbers_that_are_meant() -> None:
    """Equal ratios and the very ends; of linear ones decimal numbers to the last bit."""
    sweep = {"start": 0.1, "stop": 10.0, "number": 5, "spacing": "logarithmic"}
    (analysis,) = read(analyses=[RESPONSE | {"omega": sweep}]).analyses
    assert analysis.omega == pytest.approx([0.1, 0.1 * 10**0.5, 1.0, 10**0.5, 10.0], rel=1e-15)
    assert (analysis.omega[0], analysis.omega[-1]) == (0.1, 10.0)
    for start, stop, places in ((0.1, 3.0, 1), (0.05, 20.0, 2), (0.001, 0.7, 3), (1.3, 2.3, 1)):
        number = round((stop - start) * 10**places) + 1
        (analysis,) = read(analyses=[RESPONSE | {"omega": {"start": start, "stop": stop, "number": number}}]).analyses
        assert analysis.omega == tuple(round(start + place / 10**places, places) for place in range(number))


@pytest.mark.parametrize("liquids", [(DEEP,), (WATER, OIL), (DEEP, HIGH_OIL), (WATER, HIGH_OIL)])
def test_scenes_go_through_strict_json(liquids: tuple[dict[str, Any], ...]) -> None:
    given = read(CIRCLE, PLATE, liquids=liquids)
    text = json.dumps(given.model_dump(mode="json"), allow_nan=False)
    assert ('"depth": "inf"' in text) == any(liquid["depth"] == inf for liquid in liquids)
    assert he.read(json.loads(text)) == given


def test_bodies_may_lie_anywhere_in_the_stretch() -> None:
    # Beside a wall these would touch it; in open water a circle at 0 lies half outside what is drawn.
    read(CIRCLE | {"position": 0.0})
    read(CIRCLE | {"position": 10.0})
    read(PLATE | {"start": 0.0, "length": 10.0})
    assert "outside the stretch" in said(CIRCLE | {"position": 10.1})
    assert "stretch that is drawn" in said(PLATE | {"start": 9.0})


def test_sizes_do_not_depend_on_the_stretch() -> None:
    # 1e-4 of a closed tank's length is the least; here a metre of float in a thousand kilometres.
    read(length=1e6)
    read(PLATE, length=1e6)
    assert "too small beside the other bodies" in said(CIRCLE, PLATE | {"start": 2e4}, length=1e5)
    assert "too short beside the others" in said(PLATE, PLATE | {"start": 9e4, "length": 30.0}, length=1e5)


def test_depths_are_neither_too_thin_nor_too_deep_to_mesh() -> None:
    read(liquids=({"density": 1000.0, "depth": 1e6},))
    assert "too thin" in said(PLATE, liquids=({"density": 1000.0, "depth": 1e-5},))
    for body in (PLATE, CIRCLE):
        assert "too deep" in said(body, liquids=({"density": 1000.0, "depth": 1e30},))
    assert "reaches down" in said(liquids=({"density": 1000.0, "depth": 0.4},))
    for depth in (0.0, -1.0, -inf, nan, 1e31, "deep", None):
        assert 'key "depth"' in said(liquids=({"density": 1000.0, "depth": depth},))


def test_tops_are_those_on_which_there_are_waves() -> None:
    read(liquids=(WATER, HIGH_OIL))
    read(liquids=(WATER, OIL), top="rigid")
    assert "infinitely deep" in said(liquids=(WATER, HIGH_OIL), top="rigid")
    assert "no surface" in said(CIRCLE | {"at": "surface"}, liquids=(WATER, HIGH_OIL))
    for top in ("pressure_release", "rigid"):
        assert "there are no waves" in said(liquids=(WATER,), top=top)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"body": []}, "[[body]]: open water without a body"),
        ({"mesh": {"file": "sea.msh"}}, '[mesh], key "file"'),
        ({"accuracy": {"modes": 3}}, 'the number of resonances is "count"'),
        ({"body": [PLATE | {"start": 0.0, "length": 10.0, "ends": "guided"}]}, "open water has none"),
        ({"body": [PLATE], "analysis": [DECAY]}, "it is a beam"),
        ({"body": [PLATE, CIRCLE | {"position": 7.0}], "analysis": [DECAY]}, "Allowed: 2"),
        ({"analysis": [3]}, "it is not a table"),
        (
            {"liquid": [WATER], "analysis": [{"kind": "resonance", "largest_damping": 1.5}]},
            "computed in infinite depths only",
        ),
    ],
)
def test_what_open_water_cannot_take_is_said(changes: dict[str, Any], words: str) -> None:
    assert words in said(**changes)


@pytest.mark.parametrize(
    ("analysis", "words"),
    [
        (RADIATION | {"omega": []}, 'number 1, key "omega": there are too few'),
        (RADIATION | {"omega": 2.0}, "or a table {start, stop, number, spacing}"),
        (RADIATION | {"omega": [-1.0]}, 'key "omega", entry 1 = -1.0: it is too small'),
        (RADIATION | {"omega": [nan]}, "it is not a number"),
        (RADIATION | {"omega": [1.0, 2.0, 1]}, "1 is named twice"),
        (RADIATION | {"elastic_modes": -1}, "it is too small"),
        (RADIATION | {"omega": [1.0, 1e-200]}, "its waves are too long or too short"),
        (RESPONSE | {"omega": [1e6]}, "its waves are too long or too short"),
        (DECAY | {"times": [1e20]}, "the waves at such late times are too long"),
        (RESPONSE | {"omega": [0.0]}, "it is too small"),
        (RESPONSE | {"omega": [inf]}, "it is not a finite number"),
        (RESPONSE | {"omega": {"start": 1.0, "stop": 1.0, "number": 3}}, 'in its table, key "stop" = 1.0'),
        (RESPONSE | {"omega": {"start": 1.0, "stop": 2.0}}, 'in its table, key "number": it is missing'),
        (RESPONSE | {"omega": {"start": 0, "stop": 2, "number": 3, "spacing": "logarithmic"}}, "equal ratios"),
        (RESPONSE | {"waves_from": "above"}, '"left" or "right"'),
        (RESPONSE | {"elastic_modes": 3}, 'It belongs to kind = "radiation"'),
        ({"kind": "resonance", "count": 0}, "it is too small"),
        ({"kind": "resonance", "below": -1.0}, "it is too small"),
        ({"kind": "resonance", "largest_damping": 2.5}, "it is too large"),
        (DECAY | {"displacement": 0.0}, "released from its equilibrium"),
        (DECAY | {"displacement": {"roll": 0.1}}, 'Add "roll" to its motions'),
        (DECAY | {"displacement": "high"}, "it is not a number"),
        (DECAY | {"displacement": {"sway": 0.1}}, "it is not known here. Allowed: heave, roll"),
        (DECAY | {"body": 2}, "there is no body of that number. Allowed: 1"),
        (DECAY | {"times": [-1.0]}, "it is too small"),
        ({"kind": "raditaion", "omega": [1.0]}, 'Did you mean "radiation"?'),
        ({"omega": [1.0]}, 'key "kind": it is missing'),
    ],
)
def test_analyses_that_make_no_sense_are_refused(analysis: dict[str, Any], words: str) -> None:
    assert words in said(analyses=[analysis])


def test_a_tank_with_walls_takes_nothing_of_open_water() -> None:
    with pytest.raises(he.SceneError) as caught:
        he.read({"kind": "tank", "tank": {"length": 10.0}, "liquid": [DEEP], "body": [CIRCLE], "analysis": [RADIATION]})
    text = str(caught.value)
    assert "not infinitely deep" in text
    assert "[[analysis]]: a tank with walls has modes" in text
    assert text.count('ends = "open"') == 2


def test_infinite_depth_is_read_and_set(tmp_path: Path) -> None:
    file = tmp_path / "sea.toml"
    circle = 'kind = "float", shape = "ellipse", half_width = 0.5, half_height = 0.5'
    file.write_text(f'kind = "sea"\nliquid = [{{density = 1000.0, depth = inf}}]\nbody = [{{{circle}}}]\n')
    read_one: Any = he.read
    assert read_one(file).liquid[0].depth == inf
    assert read_one(file, {"liquid.1.depth": 3.0}).liquid[0].depth == 3.0


BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 1.0,
    "half_height": 0.5,
    "motions": ["heave", "sway", "roll"],
}
SPAR = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 2.0, "motions": ["pitch"]}
DISC = {"kind": "plate", "outline": "disc", "radius": 5.0, "flexural_rigidity": 1e6, "mass_per_area": 100.0}
SEAWAY = {"kind": "spectrum", "significant_height": 1.0, "peak_period": 5.0}


def sea(*bodies: dict[str, Any], **keys: Any) -> dict[str, Any]:
    return {"kind": "sea", "liquid": [{"density": 1000.0, "depth": 3.0}], "body": list(bodies)} | keys


def test_draught_centre_of_gravity_and_inertia_stand_for_mass_height_and_radius() -> None:
    mass, radius = 1000.0 * 2.0 * 0.7, 0.6
    drawn = {"draught": 0.7, "vertical_centre_of_gravity": -0.1, "inertia": mass * radius**2}
    weighed = {"mass": mass, "centre_of_mass": 0.1, "radius_of_gyration": radius}
    for keys in (drawn, weighed, drawn | weighed):
        (rest,) = he.solve(sea(BARGE | keys, analysis=[RESPONSE], accuracy={"tolerance": 1e-1})).summary["bodies"]
        assert (rest["mass"], rest["draught"]) == (pytest.approx(mass), pytest.approx(0.7))
        assert rest["centre_of_gravity"] == [0.0, pytest.approx(-0.1)]
        assert rest["radius_of_gyration"] == pytest.approx(radius)
        # GM = I/V + KB − KG of a box.
        assert rest["metacentric_height"] == pytest.approx(8.0 / 12.0 / 1.4 - 0.35 + 0.1)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"mass": 1400.0, "draught": 0.6}, "it contradicts mass, with which it is 0.7"),
        ({"draught": 1.1}, "the section is 1 m high"),
        ({"centre_of_mass": 0.0, "vertical_centre_of_gravity": 0.2}, "it contradicts centre_of_mass"),
        ({"radius_of_gyration": 0.5, "inertia": 300.0}, "it contradicts radius_of_gyration, with which it is 250"),
        ({"vertical_centre_of_gravity": 3.0}, "the float capsizes"),
    ],
)
def test_contradictions_are_refused(keys: dict[str, float], message: str) -> None:
    with pytest.raises(he.SceneError, match=message):
        he.read(sea(BARGE | keys))


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"liquid": [{"density": 1000.0}]}, "depth of the layer, m; inf in open water alone"),
        ({"body": [BARGE | {"vertical_centre_of_gravity": 3.0}]}, r"3 m above the still level.*a vertical_centre_of"),
        ({"body": [SPAR]}, r"above the still level.*a vertical_centre_of_gravity of at most -0.875 m"),
        ({"attachment": [{"stiffness": [[1.0, 2.0, 3.0], 4.0]}]}, "entry 2 = 4.0: it is not a list. Allowed: a list"),
        ({"body": [DISC], "attachment": [{"at": [0.0, 0.0], "stiffness": [1.0, 1.0, 0.0]}]}, "a plate does not surge"),
        ({"body": [DISC], "analysis": [{"kind": "decay", "displacement": 1.0, "times": [1.0]}]}, "is a plate, and"),
        ({"body": [DISC], "analysis": [SEAWAY | {"points": [{"at": [9.0, 0.0]}]}]}, "not lie on the plate"),
    ],
)
def test_messages_tell_what_the_sea_has(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(he.SceneError, match=message) as error:
        he.read(sea(BARGE) | keys)
    assert not re.search(r"\btank\b|\bends\b|\bwalls\b", str(error.value))


def test_a_drawn_stretch_goes_from_left_to_right() -> None:
    he.read(sea(BARGE, sea={"drawn": [-30.0, 20.0]}))
    with pytest.raises(he.SceneError, match="from left to right"):
        he.read(sea(BARGE, sea={"drawn": [20.0, -30.0]}))


EXPORT = {"formats": ["wamit"], "width": 3.0}
IMPULSE = {"kind": "impulse_response", "times": [0.0, 1.0, 2.0]}
OF_RADIATION: dict[str, Any] = {"kind": "radiation", "omega": [0.5, 1.0]}
EXPORTED_DISC = {
    "kind": "plate",
    "outline": "disc",
    "radius": 5.0,
    "youngs_modulus": 6e9,
    "thickness": 1.0,
    "density": 900.0,
}
EXPORTED_DISC |= {"poisson_ratio": 0.3}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"export": {"formats": ["wamit"]}}, "width"),
        ({"export": EXPORT, "body": [{"kind": "float", "shape": "sphere", "radius": 1.0}]}, "solids of revolution"),
        ({"export": {"formats": ["wamit", "wamit"], "width": 1.0}}, "named twice"),
        ({"export": {"formats": ["hydrostar"], "width": 1.0}}, "formats"),
        ({"export": EXPORT, "analysis": []}, "analysis of radiation"),
        ({"export": EXPORT, "liquid": [{"density": 1025.0, "depth": 3.0}, {"density": 1.2, "depth": 5.0}]}, "two"),
        ({"export": {"formats": ["wamit"]}, "body": [EXPORTED_DISC]}, "a plate is neither"),
        (
            {"export": EXPORT, "body": [PLATE], "analysis": [OF_RADIATION, OF_RADIATION | {"elastic_modes": 2}]},
            "different elastic_modes",
        ),
        ({"export": EXPORT | {"formats": ["bemio"]}}, "impulse responses at equally spaced times"),
        (
            {"export": EXPORT | {"formats": ["nemoh"]}, "analysis": [{"kind": "radiation", "omega": [0.5, 1.0, 2.0]}]},
            "equally spaced",
        ),
    ],
)
def test_what_files_need_is_asked_for(changes: dict[str, Any], words: str) -> None:
    barge = BARGE | {"motions": ["heave"], "vertical_centre_of_gravity": -0.2}
    with pytest.raises(he.SceneError, match=words):
        he.read(sea(barge, analysis=[OF_RADIATION]) | changes)


CYLINDER: dict[str, Any] = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 1.0}


@pytest.mark.parametrize(
    ("bodies", "keys", "words"),
    [
        ([CYLINDER, BARGE], {}, "other bodies of the scene are solids of revolution"),
        ([{"kind": "float", "shape": "cylinder", "radius": 1.0}], {}, "needs it"),
        ([{"kind": "float", "shape": "cone", "radius": 1.0, "draught": 1.0, "inner_radius": 0.5}], {}, "not belong"),
        ([CYLINDER | {"inner_radius": 1.0}], {}, "inside the ring"),
        ([{"kind": "float", "shape": "sphere", "radius": 1.0, "draught": 2.0}], {}, "under water"),
        (
            [{"kind": "float", "shape": "revolved", "outline": [[0, -1], [1, -1], [0, 0], [1, 1]]}],
            {},
            "one side of a section",
        ),
        ([CYLINDER], {"analysis": [{"kind": "resonance", "largest_damping": 1.0}]}, "sections only"),
        (
            [CYLINDER],
            {"analysis": [RADIATION | {"fields_at": [1.0]}]},
            "only the response to waves from the left in one liquid is drawn",
        ),
        ([CYLINDER], {"analysis": [RESPONSE | {"fields_at": [1.1]}]}, "the response is not solved for there"),
    ],
)
def test_solids_that_do_not_fit_are_refused(bodies: list[dict[str, Any]], keys: dict[str, Any], words: str) -> None:
    with pytest.raises(he.SceneError, match=words):
        he.read(sea(*bodies) | keys)


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
    assert wrong in written(tmp_path, f'kind = "plate", {body}')


def test_round_plates_that_overlap_are_refused(tmp_path: Path) -> None:
    disc = 'kind = "plate", outline = "disc", radius = 2.0, rigid = true, mass_per_area = 1.0'
    ring = 'kind = "plate", outline = "ring", radius = 4.0, inner_radius = 1.5, rigid = true, mass_per_area = 1.0'
    assert "overlaps or touches [[body]] number 1" in written(tmp_path, f"{disc}}}, {{{ring}")


def test_a_misspelt_solid_shape_is_told(tmp_path: Path) -> None:
    assert 'Did you mean "cylinder"' in written(
        tmp_path, 'kind = "float", shape = "cylnder", radius = 1.0, draught = 1.0'
    )
    assert 'Did you mean "ellipse"' in written(tmp_path, 'kind = "float", shape = "elipse", half_width = 1.0')


def written(tmp_path: Path, body: str) -> str:
    """Return the message about a body of the sea."""
    scene = tmp_path / "scene.toml"
    scene.write_text(f'kind = "sea"\nliquid = [{{density = 1000.0, depth = 10.0}}]\nbody = [{{{body}}}]\n')
    with pytest.raises(he.SceneError) as caught:
        he.read(scene)
    return str(caught.value)


def test_messages_name_the_keys_of_the_body_at_hand(tmp_path: Path) -> None:
    """A section and a solid are both of kind "float"."""
    solid = 'kind = "float", shape = "cylinder", radius = 1.0'
    negative = written(tmp_path, f"{solid}, draught = -1.0")
    assert 'key "draught" = -1.0: it is too small. Allowed: a positive number' in negative
    misplaced = written(tmp_path, f"{solid}, draught = 1.0, half_width = 1.0")
    assert "inner_radius" in misplaced
    assert "belongs to kind" not in misplaced
    assert 'key "draught" = 12.0: the float reaches down' in written(tmp_path, f"{solid}, draught = 12.0")
    heavy = written(tmp_path, 'kind = "float", shape = "sphere", radius = 1.0, mass = 1e5')
    assert "with a volume of 4.18879 m³ it sinks. Allowed: between 0 and 4188.79 kg (Archimedes)" in heavy
    around = 'kind = "float", shape = "cylinder", radius = 2.0, inner_radius = 1.0, draught = 1.0'
    assert "[[body]] number 2: the body overlaps" in written(tmp_path, f"{solid}, draught = 1.0}}, {{{around}")
    section = 'kind = "float", shape = "ellipse", half_width = 1.0, half_height = 1.0'
    assert "half_width, half_height, tail" in written(tmp_path, f"{section}, colour = 1.0")
    assert '"beam" or "varying_beam" or "float" or "plate". ' in written(tmp_path, 'kind = "boat"')
