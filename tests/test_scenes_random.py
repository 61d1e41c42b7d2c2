"""Random valid scenes run: no NaN, errors as asked or a loud word; and theorems that hold of any of them."""

import csv
import json
from collections.abc import Callable, Iterator
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_scenes import HOW_MANY, coarse, hundred_scenes
from random_tanks import draw_tanks

import hydroelastic as he

SCENES = hundred_scenes()
TANKS = [coarse(scene) for scene in draw_tanks(11, 12)]
EMPTY = {"", "inf", "-inf"}


def test_there_are_a_hundred() -> None:
    assert len(SCENES) == sum(HOW_MANY.values()) == 100
    assert len(set(map(str, SCENES))) == 100


@pytest.mark.slow
@pytest.mark.parametrize("number", range(100))
def test_a_random_scene_runs_and_tells_how_well(number: int, tmp_path: Path) -> None:
    _, scene = SCENES[number]
    he.solve(scene).save(tmp_path / "result", images=None)
    summary = json.loads((tmp_path / "result" / "summary.json").read_text(encoding="utf-8"), parse_constant=_no_number)
    for table in (tmp_path / "result").rglob("*.csv"):
        with table.open(encoding="utf-8", newline="") as file:
            assert not any(_is_nan(cell) for row in csv.reader(file) for cell in row), table.name
    assert summary["status"] in ("ok", "unconverged")
    assert (summary["status"] == "ok") == (not summary["reasons"])
    if summary["status"] == "ok":
        errors = list(_errors(summary))
        assert errors
        assert max(errors) <= scene.accuracy.tolerance


def _no_number(constant: str) -> float:
    raise AssertionError(f"the summary holds {constant}")


def _is_nan(cell: str) -> bool:
    return "nan" in cell.lower().split()


def _errors(value: Any) -> Iterator[float]:
    """All relative errors of a summary that are those of the answer."""
    for key, inner in value.items() if isinstance(value, dict) else ():
        if key == "relative_error":
            yield from (abs(error) for error in np.ravel(inner).tolist() if error is not None and isfinite(error))
        elif key not in ("scene", "estimates", "comparison"):
            yield from _errors(inner)
    for inner in value if isinstance(value, list) else ():
        yield from _errors(inner)


def frequencies(scene: he.TankScene) -> tuple[np.ndarray, np.ndarray]:
    """ω and what they may be off by, rad/s, of as many modes as are asked for."""
    modes = he.solve(scene).modes
    return modes.omega, modes.omega * modes.relative_error


def beams_changed(scene: he.TankScene, change: Callable[[Any], dict[str, Any]]) -> he.TankScene:
    bodies = tuple(beam.model_copy(update=change(beam)) for _, beam in scene.beams)
    return scene.model_copy(update={"body": bodies})


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(TANKS)))
def test_other_units_give_the_same_numbers(number: int) -> None:
    """Lengths × a, g × b, densities × c: ω scales with √(b/a)."""
    scene, (a, b, c) = TANKS[number], np.exp(np.random.default_rng(number).uniform(-5.0, 5.0, 3))
    (liquid,) = scene.liquid
    other = beams_changed(
        scene,
        lambda beam: {
            "start": a * beam.start,
            "length": a * beam.length,
            "flexural_rigidity": a**4 * b * c * beam.flexural_rigidity,
            "mass_per_length": a * c * beam.mass_per_length,
        },
    ).model_copy(
        update={
            "tank": scene.tank.model_copy(update={"length": a * scene.tank.length, "gravity": b * scene.tank.gravity}),
            "liquid": (liquid.model_copy(update={"depth": a * liquid.depth, "density": c * liquid.density}),),
        }
    )
    (omega, error), (scaled, scaled_error) = frequencies(scene), frequencies(other)
    assert np.all(np.abs(scaled / np.sqrt(b / a) - omega) <= error + scaled_error / np.sqrt(b / a))


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(TANKS)))
def test_the_mirror_image_has_the_same_frequencies(number: int) -> None:
    scene = TANKS[number]
    mirrored = beams_changed(scene, lambda beam: {"start": max(scene.tank.length - beam.start - beam.length, 0.0)})
    (omega, error), (other, other_error) = frequencies(scene), frequencies(mirrored)
    assert np.all(np.abs(other - omega) <= error + other_error)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(TANKS)))
def test_more_mass_of_a_beam_raises_no_frequency(number: int) -> None:
    """Rayleigh, Courant: K stays, and M grows by a positive form."""
    scene = TANKS[number]
    heavier = beams_changed(scene, lambda beam: {"mass_per_length": 2.0 * beam.mass_per_length})
    (omega, error), (lowered, lowered_error) = frequencies(scene), frequencies(heavier)
    assert np.all(lowered <= omega + error + lowered_error)
    assert lowered.sum() < omega.sum() + error.sum()


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(TANKS)))
def test_a_denser_liquid_under_a_lid_lowers_the_elastic_frequencies(number: int) -> None:
    """Without waves and hydrostatics K is bending alone, and M the beam's mass with the liquid's in proportion to ρ."""
    scene = beams_changed(TANKS[number], lambda _beam: {"hydrostatic": False})
    (liquid,) = scene.liquid
    lid = scene.model_copy(update={"tank": scene.tank.model_copy(update={"top": "rigid"})})
    denser = lid.model_copy(update={"liquid": (liquid.model_copy(update={"density": 2.0 * liquid.density}),)})
    (omega, error), (lowered, lowered_error) = frequencies(lid), frequencies(denser)
    assert np.all(lowered < omega + error + lowered_error)
    assert lowered.sum() < omega.sum()


def _kinds(scenes: list[tuple[str, Any]]) -> set[str]:
    return {scene.kind for _, scene in scenes}


def test_all_kinds_are_among_them() -> None:
    assert _kinds(SCENES) == {"tank", "string", "thread", "roll"}
