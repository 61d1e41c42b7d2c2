"""Shipped scenes with a few keys changed at random, and what the command `check` says of them, in this process.

    ./hydro python tests/support/mutated_scenes.py 3000 --seed 1

checks 3000 of them and prints each that is not accepted, or refused in words. The same seed gives the same scenes.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import shutil
import signal
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from math import inf, nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from command import run_command

Document = dict[str, Any]
SHIPPED_FOLDER = Path(__file__).parents[2] / "scenes"
ODD_TEXTS = (
    "",
    " ",
    "ü\u202e 火 \U0001f6a2",
    "a\nb",
    "\x1b[31m",
    "x" * 300,
    "1,5",
    "1e3 m",
    "inf",
    "../..",
    "scene.toml",
    "$x$|*",
)
ODD_NUMBERS = (
    0,
    -1,
    3,
    -0.0,
    0.5,
    1e-300,
    1e300,
    -1e300,
    5e-324,
    inf,
    -inf,
    nan,
    10**400,
    -(10**30),
    2**63,
    True,
    False,
)
FACTORS = (-1.0, 0.0, 0.5, 0.9, 0.999, 1.001, 1.1, 2.0, 10.0, 0.1, 1e-3, 1e3, 1e-9, 1e9, 1e-30, 1e30)
_WORDS = ("lenght", "depth", "kind", "x" * 80, "ü", "body", "mass", "outline", "width", "radius")
# What only programmers read, and texts with nothing where a reason should be.
_FOREIGN = re.compile(r"Traceback|<class|object at 0x|array\(|float64|int64|Errno|pydantic|\bNone\b|PosixPath")
_EMPTY = re.compile(r":\s*(\.|;|$)|\(\s*\)|\s\.(\s|$)")
_NAN = re.compile(r"\bnan\b", re.IGNORECASE)


def mutated_scenes(count: int, seed: int) -> Iterator[tuple[str, Document]]:
    """Yield names of shipped scenes, each in turn, and their documents with one to three changes."""
    files = sorted(SHIPPED_FOLDER.glob("*.toml"))
    shipped = [(file.stem, tomllib.loads(file.read_text(encoding="utf-8"))) for file in files]
    for number in range(count):
        name, document = shipped[number % len(shipped)]
        yield name, mutated(document, random.Random(f"{seed} {number}"))


def mutated(document: Document, chance: random.Random) -> Document:
    """Return a document with one to three changes."""
    changed = deepcopy(document)
    # What must fit together is reached by scenes that are good but for some numbers.
    numbers_alone = chance.random() < 0.6
    for _ in range(chance.choice((1, 1, 2, 3))):
        found = list(places(changed))
        if numbers_alone:
            found = [(holder, key) for holder, key in found if type(holder[key]) in (int, float)]
            if found:
                _scale(*chance.choice(found), chance)
        elif found:
            _mutate(*chance.choice(found), chance)
    return changed


def _mutate(holder: Any, key: Any, chance: random.Random) -> None:
    value = holder[key]
    ways = ["scale"] * 4 * (type(value) in (int, float)) + ["remove", "odd", "other type", "extra key", "rename"]
    match chance.choice([*ways, *["double"] * 2 * isinstance(holder, list)]):
        case "scale":
            _scale(holder, key, chance)
        case "remove":
            del holder[key]
        case "odd":
            holder[key] = chance.choice((*ODD_NUMBERS, *ODD_TEXTS))
        case "other type":
            holder[key] = chance.choice((str(value)[:40], [value], {"value": value}, [], {}, True, [[value, value]]))
        case "extra key" if isinstance(holder, dict):
            holder[chance.choice(_WORDS)] = deepcopy(value)
        case "rename" if isinstance(holder, dict):
            holder[chance.choice((f"{key}s", key[:-1] or "x", key.upper(), chance.choice(_WORDS)))] = holder.pop(key)
        case "double":
            holder += deepcopy([value] * chance.choice((1, 1, 2, 30)))
        case _:
            holder[key] = f"{value}x" if isinstance(value, str) else chance.choice(ODD_TEXTS)


def _scale(holder: Any, key: Any, chance: random.Random) -> None:
    value = holder[key]
    factor = chance.choice(FACTORS) if chance.random() < 0.5 else 10.0 ** chance.uniform(-2.0, 2.0)
    bounded = min(max(value, -1e300), 1e300)  # a whole number may be too large for a float
    holder[key] = type(value)(min(max(bounded * factor, -1e300), 1e300))


def places(value: Any) -> Iterator[tuple[Any, Any]]:
    """All places of a document: a table or a list, and a key or a number."""
    items = (
        list(value.items()) if isinstance(value, dict) else list(enumerate(value)) if isinstance(value, list) else []
    )
    for key, inner in items:
        yield value, key
        yield from places(inner)


def as_toml(document: Document) -> str:
    """A document as TOML, all tables inline."""
    return "".join(f"{_text(key)} = {_written(value)}\n" for key, value in document.items())


def _written(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_text(key)} = {_written(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_written, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _text(value) if isinstance(value, str) else repr(value)


def _text(value: str) -> str:
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def files_of_scenes(folder: Path) -> None:
    """Copy what the shipped scenes name into a folder."""
    for file in SHIPPED_FOLDER.iterdir():
        if file.suffix in (".csv", ".stl"):
            shutil.copy(file, folder)


def complaint(document: Document, folder: Path) -> str:
    """Check a document; return what is wrong with the answer, "" if it is accepted, or refused in words."""
    file, text = folder / "scene.toml", as_toml(document)
    file.write_text(text, encoding="utf-8")
    result = run_command("check", str(file))
    said = result.output.replace(str(file), "FILE")
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        return f"{type(result.exception).__name__}: {result.exception}"
    if result.exit_code not in (0, 2):
        return f"exit code {result.exit_code}: {said[-300:]}"
    lines = said.strip().splitlines()
    if result.exit_code == 2 and not any(re.match(r"Error: \S", line) for line in lines):
        return f"no error is told: {said[-300:]}"
    wrong = [line for line in lines if _FOREIGN.search(line)]
    wrong += [line for line in lines if result.exit_code == 2 and _EMPTY.search(line)]
    wrong += [line for line in lines if not _NAN.search(text) and _NAN.search(line)]
    return f"exit code {result.exit_code}: {wrong[0]}" if wrong else ""


def _too_long(_number: int, _frame: Any) -> None:
    raise TimeoutError("the check takes too long")


def main() -> None:
    """Check many and print those that are answered badly."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first one that is checked")
    parser.add_argument("--seconds", type=int, default=60, help="after which one is given up, and counts as bad")
    options = parser.parse_args()
    signal.signal(signal.SIGALRM, _too_long)
    tally: Counter[str] = Counter()
    with TemporaryDirectory() as name:
        files_of_scenes(Path(name))
        for number, (scene, document) in enumerate(mutated_scenes(options.count, options.seed)):
            if number < options.first:
                continue
            begun = time.perf_counter()
            signal.alarm(options.seconds)
            said = complaint(document, Path(name))
            signal.alarm(0)
            tally["bad" if said else "answered well"] += 1
            if said:
                print(
                    f"--- {number} of {scene}, {time.perf_counter() - begun:.1f} s: {said}\n{as_toml(document)}",
                    flush=True,
                )
    print(dict(tally))


if __name__ == "__main__":
    main()
