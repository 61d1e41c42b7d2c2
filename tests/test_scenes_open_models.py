"""Scenes with open ends: what is accepted, what is refused, and in which words."""

from __future__ import annotations

import io
import json
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
from open_tables import ANALYSES, CIRCLE, DEEP, OIL, PLATE, open_scene
from pydantic import ValidationError
from rich.console import Console
from scene_files import CIRCLE_IN_OPEN_WATER

from hydroelastic.output.check_text import print_check
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.open_analyses import Decay, Radiation, Resonance, Response
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.time_analyses import Release
from hydroelastic.scenes.open_water.check import check_open
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.validation_errors import scene_error

WATER: dict[str, Any] = {"density": 1000.0, "depth": 2.0}
HIGH_OIL: dict[str, Any] = {"density": 800.0, "depth": inf}
RADIATION: dict[str, Any] = {"kind": "radiation", "omega": [1.0]}
RESPONSE: dict[str, Any] = {"kind": "response", "omega": [1.0]}
DECAY: dict[str, Any] = {"kind": "decay", "displacement": 0.1, "times": [1.0]}


def said(*bodies: dict[str, Any], **changes: Any) -> str:
    """What is said of a scene that is refused for one reason."""
    with pytest.raises(ValidationError) as caught:
        open_scene(*bodies, **changes)
    text = str(scene_error(caught.value, TankScene))
    assert "\n" not in text
    return text


def test_defaults_are_those_of_the_contract() -> None:
    radiation, response, resonance, decay = open_scene().analyses
    assert isinstance(radiation, Radiation)
    assert radiation.elastic_modes == 4
    assert radiation.omega == (0.0, 1.0, 2.0, 3.0, inf)
    assert isinstance(response, Response)
    assert (response.omega, response.waves_from, response.positions) == ((1.0, 2.0, 3.0), "left", 101)
    assert isinstance(resonance, Resonance)
    assert (resonance.count, resonance.below, resonance.largest_damping) == (4, None, 0.5)
    assert isinstance(decay, Decay)
    assert (decay.displacement, decay.body, len(decay.times)) == (Release(heave=0.1), 1, 41)


def test_open_water_without_analyses_is_asked_for_its_resonances() -> None:
    assert open_scene(analyses=[]).analyses == (Resonance(),)


def test_a_closed_tank_has_no_analyses_and_its_summary_no_such_key() -> None:
    closed = TankScene.model_validate({"tank": {"length": 10.0}, "liquid": [WATER]})
    assert (closed.is_open, closed.analyses) == (False, ())
    assert "analysis" not in closed.model_dump()
    assert "analysis" in open_scene().model_dump()


def test_a_logarithmic_sweep_has_equal_ratios_and_its_very_ends() -> None:
    sweep = {"start": 0.1, "stop": 10.0, "number": 5, "spacing": "logarithmic"}
    (analysis,) = open_scene(analyses=[{"kind": "response", "omega": sweep}]).analyses
    assert isinstance(analysis, Response)
    assert analysis.omega == pytest.approx([0.1, 0.1 * 10**0.5, 1.0, 10**0.5, 10.0], rel=1e-15)
    assert (analysis.omega[0], analysis.omega[-1]) == (0.1, 10.0)


@pytest.mark.parametrize(("start", "stop", "places"), [(0.1, 3.0, 1), (0.05, 20.0, 2), (0.001, 0.7, 3), (1.3, 2.3, 1)])
def test_a_linear_sweep_gives_the_decimal_numbers_that_are_meant(start: float, stop: float, places: int) -> None:
    number = round((stop - start) * 10**places) + 1
    sweep = {"start": start, "stop": stop, "number": number}
    (analysis,) = open_scene(analyses=[{"kind": "response", "omega": sweep}]).analyses
    assert isinstance(analysis, Response)
    # Equal to the last bit, so that they can be looked up by their value.
    assert analysis.omega == tuple(round(start + place / 10**places, places) for place in range(number))


@pytest.mark.parametrize("liquids", [(DEEP,), (WATER, OIL), (DEEP, HIGH_OIL), (WATER, HIGH_OIL)])
def test_scenes_are_hashable_and_go_through_strict_json(liquids: tuple[dict[str, Any], ...]) -> None:
    given = open_scene(CIRCLE, PLATE, liquids=liquids)
    assert hash(given) == hash(open_scene(CIRCLE, PLATE, liquids=liquids))
    text = json.dumps(given.model_dump(mode="json"), allow_nan=False)
    assert ('"depth": "inf"' in text) == any(liquid["depth"] == inf for liquid in liquids)
    assert TankScene.model_validate(json.loads(text)) == given
    assert TankScene.model_validate(given.model_dump()) == given


def test_bodies_may_lie_anywhere_in_the_stretch() -> None:
    # Beside a wall these would touch it; in open water a circle at 0 lies half outside what is drawn.
    assert open_scene(CIRCLE | {"position": 0.0}).floats
    assert open_scene(CIRCLE | {"position": 10.0}).floats
    assert open_scene(PLATE | {"start": 0.0, "length": 10.0}, analyses=[]).beams
    assert "outside the stretch" in said(CIRCLE | {"position": 10.1})
    assert "stretch that is drawn" in said(PLATE | {"start": 9.0}, analyses=[])


def test_answers_do_not_depend_on_the_stretch_so_sizes_do_not_either() -> None:
    # 1e-4 of a closed tank's length is the least; here a metre of float in a thousand kilometres.
    assert open_scene(length=1e6).floats
    assert open_scene(PLATE, length=1e6, analyses=[]).beams
    assert "too small beside the other bodies" in said(CIRCLE, PLATE | {"start": 2e4}, length=1e5)
    assert "too short beside the others" in said(PLATE, PLATE | {"start": 9e4, "length": 30.0}, length=1e5, analyses=[])


def test_depths_are_neither_too_thin_nor_too_deep_to_mesh() -> None:
    assert open_scene(liquids=({"density": 1000.0, "depth": 1e6},)).liquid[0].depth == 1e6
    assert "too thin" in said(PLATE, liquids=({"density": 1000.0, "depth": 1e-5},), analyses=[])
    for body in (PLATE, CIRCLE):
        assert "too deep" in said(body, liquids=({"density": 1000.0, "depth": 1e30},), analyses=[])
    assert "reaches down" in said(liquids=({"density": 1000.0, "depth": 0.4},))


def test_an_upper_liquid_without_end_has_no_surface() -> None:
    given = open_scene(liquids=(WATER, HIGH_OIL))
    assert given.top == "rigid"
    (level,) = physical_tank(given).levels_from_top
    assert level.name == "interface"
    assert [piece.body for piece in level.pieces] == [None, 0, None]
    assert (level.pieces[0].start, level.pieces[-1].end) == (-inf, inf)
    assert "infinitely deep" in said(liquids=(WATER, HIGH_OIL), top="rigid")
    assert "no surface" in said(CIRCLE | {"at": "surface"}, liquids=(WATER, HIGH_OIL))


def test_a_lid_over_two_liquids_leaves_the_waves_of_the_interface() -> None:
    assert open_scene(liquids=(WATER, OIL), top="rigid").top == "rigid"
    assert "there are no waves" in said(liquids=(WATER,), top="pressure_release")
    assert "there are no waves" in said(liquids=(WATER,), top="rigid")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"body": []}, "[[body]]: open water without a body"),
        ({"mesh": {"file": "sea.msh"}}, '[mesh], key "file"'),
        ({"accuracy": {"modes": 3}}, 'the number of resonances is "count"'),
    ],
)
def test_what_open_water_cannot_take_is_said(changes: dict[str, Any], words: str) -> None:
    assert words in said(analyses=[], **changes)


def test_ends_that_are_guided_need_walls() -> None:
    beam = PLATE | {"start": 0.0, "length": 10.0, "ends": "guided"}
    assert "open water has none" in said(beam, analyses=[])


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


def test_what_is_no_table_is_no_analysis() -> None:
    assert "it is not a table" in said(analyses=[3])  # type: ignore[list-item]


def test_only_a_float_is_let_go() -> None:
    assert "it is a beam" in said(PLATE, analyses=[DECAY])
    assert "Allowed: 2" in said(PLATE, CIRCLE | {"position": 7.0}, analyses=[DECAY])


@pytest.mark.parametrize("depth", [0.0, -1.0, -inf, nan, 1e31, "deep", None])
def test_depths_are_positive_numbers_or_infinite(depth: Any) -> None:
    assert 'key "depth"' in said(liquids=({"density": 1000.0, "depth": depth},))


def test_a_tank_with_walls_takes_nothing_of_open_water() -> None:
    document: dict[str, Any] = {"tank": {"length": 10.0}, "liquid": [DEEP], "body": [CIRCLE], "analysis": ANALYSES}
    with pytest.raises(ValidationError) as caught:
        TankScene.model_validate(document)
    text = str(scene_error(caught.value, TankScene))
    assert "not infinitely deep" in text
    assert "[[analysis]]: a tank with walls has modes" in text
    assert text.count('ends = "open"') == 2


def test_infinite_depth_is_read_and_set(tmp_path: Path) -> None:
    file = tmp_path / "sea.toml"
    file.write_text(CIRCLE_IN_OPEN_WATER, encoding="utf-8")
    assert read_scene(file).liquid[0].depth == inf
    assert read_scene(file, ["liquid.1.depth=3.0"]).liquid[0].depth == 3.0
    assert read_scene(file, ["liquid.1.depth=3.0", "liquid.1.depth=inf"]).liquid[0].depth == inf
    swept = read_scene(file, ['analysis=[{kind = "radiation", omega = {start = 1, stop = 2, number = 2}}]'])
    assert swept.analyses == (Radiation(omega=(1.0, 2.0)),)
    with pytest.raises(SceneError, match="not infinitely deep"):
        read_scene(file, ["tank.ends=walls"])


def test_check_says_what_will_be_modelled() -> None:
    console = Console(file=io.StringIO(), width=200)
    scene = open_scene(CIRCLE, PLATE | {"start": 0.0}, liquids=(DEEP, HIGH_OIL))
    print_check(scene.title, check_open(scene), console)
    text = console.file.getvalue()  # type: ignore[attr-defined]
    for words in (
        "1. radiation: added mass, radiation damping and excitation forces at 5 frequencies from 0 to inf rad/s",
        "in waves from the left at 3 frequencies from 1 to 3 rad/s",
        "resonance: the lowest 4, with −Im ω up to 0.5 Re ω",
        "float 1 is released at 0.1 m in heave; 41 times from 0 to 20 s",
        "outgoing waves only",
        "∇ψₗ → 0 as y → −∞",
        "∇ψᵤ → 0 as y → ∞",
        "Lengths of outgoing waves at 1 rad/s: internal 6.849 m",
    ):
        assert words in text
    assert "walls" not in text
    assert "/L" not in text
