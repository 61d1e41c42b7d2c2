"""Sections, studies and benchmarks read summaries by the declared quantities, never by keys."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.provenance import OF_ALL_SCENES, SCENE, STATUS, VERSIONS, read_summary
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.roll.quantities import ROLL
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.output.thread.quantities import THREAD

ROOT = Path(__file__).parents[1]
KINDS = (OF_ALL_SCENES, TANK, LEVEL_TANK, OPEN_WATER, HANGING_STRING, THREAD, ROLL)
PARTS = [part for kind in KINDS for _, _, _, part in kind.places()]
KEYS = {part.key for part in PARTS if isinstance(part, Group) or part.in_summary}
READS = {"Reading", "read_summary", "reading_of"}

MODES = Group(
    "modes",
    "modes",
    (
        OMEGA := Quantity("omega", "angular frequency", "rad/s", error="relative_error"),
        ERROR := Quantity("relative_error", "relative error", "1", shown=".1e"),
        KIND := Quantity("kind", "kind"),
    ),
    dimension="mode",
)
SIZE = Group("size", "size", (CELLS := Quantity("cells", "cells", "1"), TERMS := Quantity("terms", "terms", "1")))
NAMED = Group("estimates", "estimates by name", (OF_ESTIMATE := Quantity("omega", "by a theory", "rad/s"),),
    dimension="estimate")  # fmt: skip
STEADY = Group("steady", "what there may not be", (Quantity("value", "value"),))
SCENE_KIND = Group("", "a kind", (MODES, SIZE, NAMED, STEADY))
SUMMARY = {
    "scene": {"title": "One"},
    "status": "ok",
    "modes": [{"omega": 1.23456789, "relative_error": 1e-5, "kind": "sloshing"}],
    "size": {"cells": 7},
    "estimates": {"rayleigh": {"omega": 1.5}},
    "steady": None,
}


def test_values_are_read_by_their_declarations() -> None:
    told = read_summary(SUMMARY, SCENE_KIND)
    assert (told[SCENE]["title"], told[STATUS]) == ("One", "ok")
    (mode,) = told[MODES]
    assert (mode[OMEGA], mode.cell(OMEGA), mode.cell(ERROR)) == (1.23456789, "1.2346", "1.0e-05")
    assert told[NAMED]["rayleigh"][OF_ESTIMATE] == 1.5
    assert told[STEADY] is None
    # Solutions of some kinds have no terms.
    assert CELLS in told[SIZE]
    assert TERMS not in told[SIZE]
    assert (mode | {KIND: "heave"}).cell(KIND) == "heave"
    assert mode.without(KIND).values == {"omega": 1.23456789, "relative_error": 1e-5}


def test_what_is_not_declared_there_is_an_error() -> None:
    told = read_summary(SUMMARY, SCENE_KIND)
    (mode,) = told[MODES]
    # A quantity of another group has the same key.
    with pytest.raises(KeyError, match="modes: 'omega' is not declared there"):
        mode[OF_ESTIMATE]
    with pytest.raises(KeyError, match="not declared"):
        mode.cell(CELLS)
    with pytest.raises(KeyError, match="terms"):
        told[SIZE][TERMS]
    assert VERSIONS in told.group.parts
    with pytest.raises(KeyError, match="not declared"):
        Reading(SCENE_KIND, SUMMARY)[VERSIONS]


def keys_read(source: str) -> Iterator[str]:
    """What a module reads of summaries by texts: ``summary["modes"]``; ``mode["omega"]`` where it reads them at all.

    Keys of the scene are declared by its model.
    """
    tree = ast.parse(source)
    reads = any(isinstance(node, ast.Name) and node.id in READS for node in ast.walk(tree))
    for node in ast.walk(tree):
        match node:
            case ast.Subscript(value=base, slice=ast.Constant(value=str(key)), ctx=ast.Load()):
                pass
            case ast.Call(func=ast.Attribute(value=base, attr="get"), args=[ast.Constant(value=str(key)), *_]):
                pass
            case _:
                continue
        text = ast.unparse(base)
        is_summary = text.split(".")[-1].split("[")[0] in ("summary", "summaries")
        of_scene = "[SCENE]" in text or text.split("[")[0] == "scene"
        if not of_scene and (is_summary or (reads and key in KEYS)):
            yield ast.unparse(node)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ('summary["modes"]', ["summary['modes']"]),
        ('outcome.summary.get("modes", ())', ["outcome.summary.get('modes', ())"]),
        ('summary[MODES][0]["omega"]', ["summary[MODES][0]['omega']"]),
        ('mode["omega"]', []),
        ('read_summary(summary)[MODES][0]["omega"]', ["read_summary(summary)[MODES][0]['omega']"]),
        ('mode["omega"], Reading', ["mode['omega']"]),
        ('summary[SCENE]["title"], scene["tank"]["omega"], sizes["of mine"], Reading', []),
    ],
)
def test_keys_that_are_read_are_found(line: str, expected: list[str]) -> None:
    assert list(keys_read(line)) == expected


@pytest.mark.parametrize("folder", ["output", "scenes", "benchmarks", "api"])
def test_no_summary_is_read_by_keys(folder: str) -> None:
    files = sorted((ROOT / folder).rglob("*.py"))
    found = {str(file.relative_to(ROOT)): list(keys_read(file.read_text(encoding="utf-8"))) for file in files}
    assert files
    assert {file: keys for file, keys in found.items() if keys} == {}
