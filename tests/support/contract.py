"""The contract: what users may rely on, as one text, made of what is declared.

    ./hydro python tests/support/contract.py      # after a change that is meant: tests/reference/contract.txt anew

Keys of results have their unit, words that they take, and their variable of ``dataset.nc`` with its dimensions; behind
† are those whose presence is promised, not their value. Keys of scenes have their type.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

import hydroelastic as he
from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.provenance import OF_ALL_SCENES
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.roll.quantities import ROLL
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.output.thread.comparison import COMPARISON
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.schema import scene_schema

FILE = Path(__file__).parents[1] / "reference" / "contract.txt"
KINDS = {
    "all scenes": OF_ALL_SCENES,
    "tanks": TANK,
    "tanks in three dimensions": LEVEL_TANK,
    "open water": OPEN_WATER,
    "strings": HANGING_STRING,
    "threads": THREAD,
    "comparisons of threads": COMPARISON,
    "ships": ROLL,
}


def contract() -> str:
    """Return the whole contract."""
    lines = ["# names in hydroelastic", *sorted(he.__all__), "# commands", *_commands(main, "hydroelastic")]
    for name, kind in KINDS.items():
        lines += [f"# results of {name}", *_results(kind)]
    lines.append("# keys of scenes")
    for model, definition in sorted(scene_schema()["definitions"].items()):
        required = definition.get("required", ())
        for key, told in definition.get("properties", {}).items():
            lines.append(f"{model}.{key}{'!' if key in required else ''}: {_type(told)}")
    return "\n".join(lines) + "\n"


def unpromised() -> re.Pattern[str]:
    """Return what matches keys of ``summary.json``, and variables of ``dataset.nc``, whose values are not promised."""
    found = []
    for kind in KINDS.values():
        lists = {place for place, _, _, part in kind.places() if isinstance(part, Group) and part.dimension}
        for place, name, _, part in kind.places():
            if not part.contract:
                key, parts = "", place.split(".")
                for number, word in enumerate(parts, 1):
                    key += rf"\.{word}" + r"(\[\d+\]|\.\w+)?" * (".".join(parts[:number]) in lists)
                found += [f"summary{key}", r".*\.nc: " + re.sub(r"\{.*?\}", r"\\w+", name or "-")]
    return re.compile("|".join(dict.fromkeys(found)))


def _commands(command: click.Command, name: str) -> Iterator[str]:
    shown = [one for one in command.params if not getattr(one, "hidden", False)]
    yield " ".join([name, *(_parameter(one) for one in shown)])
    if isinstance(command, click.Group):
        for inner, one in sorted(command.commands.items()):
            yield from _commands(one, f"{name} {inner}")


def _parameter(one: click.Parameter) -> str:
    words = [one.human_readable_name if isinstance(one, click.Argument) else "/".join([*one.opts, *one.secondary_opts])]
    if isinstance(one.type, click.Choice):
        words.append("|".join(map(str, one.type.choices)))
    return "=".join(words) + "*" * bool(one.multiple if isinstance(one, click.Option) else one.nargs != 1)


def _results(kind: Group) -> Iterator[str]:
    for place, name, dimensions, part in kind.places():
        key = place if isinstance(part, Group) or part.in_summary else ""
        told = [f"{key}[{part.dimension}]" if isinstance(part, Group) and part.dimension else key]
        if isinstance(part, Quantity):
            words = re.findall(r'`"([^"]*)"`', f"{part.meaning} {part.note}")
            told += [part.unit_with_rolls or "", *["|".join(words)] * bool(words)]
            told += [f"{name}({', '.join(dimensions)})"] * bool(name)
        yield "; ".join(filter(None, told)) + " †" * (not part.contract)


def _type(told: Any) -> str:
    if "$ref" in told:
        return str(told["$ref"].rpartition("/")[2])
    for words in ("anyOf", "allOf"):
        if words in told:
            return " | ".join(dict.fromkeys(map(_type, told[words])))
    if "enum" in told or "const" in told:
        return "|".join(map(str, told.get("enum", [told.get("const")])))
    kind = str(told.get("type", "any"))
    return f"{kind} of {_type(told['items'])}" if isinstance(told.get("items"), dict) else kind


if __name__ == "__main__":
    FILE.write_text(contract(), encoding="utf-8")
