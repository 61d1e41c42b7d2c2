"""Error messages of a scene: place, value found, values allowed, remedy."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from hydroelastic.output.folder import FolderError

MOST_PROBLEMS_SHOWN = 10
LONGEST_VALUE_SHOWN = 60
LARGEST_DECIMAL_SHOWN = 10**LONGEST_VALUE_SHOWN


@dataclass(frozen=True, kw_only=True)
class Problem:
    """One thing that is wrong.

    Args:
        wrong: the error, a phrase that follows the key.
        key: where, as the author reads it, for example ``[[body]] number 1, key "start"``.
        value: the value found, in TOML; empty if it has no short form.
        allowed: the values allowed.
        remedy: what to do.
        argument: whether the key is an argument of a function in Python, and an option of the command line.
    """

    wrong: str
    key: str = ""
    value: str = ""
    allowed: str = ""
    remedy: str = ""
    argument: bool = False

    def line(self, *, options: bool = False) -> str:
        """Return the problem as one line that a terminal shows as it is; with ``options``, arguments are ``--key``."""
        key = f"--{self.key}" if options and self.argument else self.key
        subject = f"{key} = {self.value}" if self.value else key
        parts = [f"{subject}: {self.wrong}" if subject else self.wrong]
        if self.allowed:
            parts.append(f"Allowed: {self.allowed}")
        if self.remedy:
            parts.append(self.remedy)
        return printable(" ".join(part if part.endswith(("?", ".")) else f"{part}." for part in parts))


class SceneError(Exception):
    """A scene, an override or an output folder that cannot be used.

    Args:
        problems: what is wrong, at least one.
        file: the scene file, or None where no file is concerned.
    """

    def __init__(self, *problems: Problem, file: str | Path | None = None) -> None:
        super().__init__(*problems)
        self.problems = problems
        self.file = file

    def __str__(self) -> str:
        return self.text()

    def text(self, *, options: bool = False) -> str:
        """Return one line for one problem, else a heading and one line each (ten at most)."""
        lines = [problem.line(options=options) for problem in self.problems]
        file = printable(str(self.file))
        if len(lines) == 1:
            return f"{file}: {lines[0]}" if self.file is not None else lines[0]
        shown = lines[:MOST_PROBLEMS_SHOWN]
        if len(lines) > len(shown):
            shown.append(f"… and {len(lines) - len(shown)} more")
        heading = f"{file}: {len(lines)} problems" if self.file is not None else f"{len(lines)} problems"
        return "\n  ".join([heading, *shown])


def cannot_be_meshed(error: Exception, scene: Any) -> SceneError:
    """Return the error of a scene whose liquid cannot be meshed, with the tables that shape it."""
    tables = ("[tank]", "[[liquid]]", "[[baffle]]", "[[column]]", "[[body]]")
    key = ", ".join(table for table in tables if getattr(scene, table.strip("[]"), None))
    key = key.replace("[tank]", f"[{scene.kind}]")
    remedy = "Change the shapes, places or sizes that it comes from"
    return SceneError(Problem(key=key, wrong=f"the liquid cannot be meshed: {error}", remedy=remedy), file=scene.source)


@contextmanager
def folder_errors(option: str = "") -> Iterator[None]:
    """Turn the error of a result folder that cannot be written into a message of the same form as all others."""
    try:
        yield
    except FolderError as error:
        key = "" if error.folder is None else f"output folder {error.folder}"
        remedy = f"{error.remedy} ({option})" if option and error.remedy else error.remedy
        raise SceneError(Problem(key=key, wrong=error.wrong, remedy=remedy)) from None


def printable(text: str) -> str:
    """Return a text with escapes for control characters and all else that would not be seen, as in names of files."""
    return "".join(sign if sign.isprintable() else sign.encode("unicode_escape").decode() for sign in text)


def shown_value(value: object) -> str:
    """Return a value as TOML writes it, shortened; empty for tables and lists, which are too long to show."""
    if isinstance(value, dict | list | tuple | BaseModel) or value is None:
        return ""
    if isinstance(value, str | bool):
        # JSON writes texts and truth values as TOML does, and escapes control characters.
        text = json.dumps(value, ensure_ascii=False)
    else:
        # Python refuses to write whole numbers of thousands of digits in decimal.
        text = hex(value) if isinstance(value, int) and abs(value) > LARGEST_DECIMAL_SHOWN else str(value)
    return text if len(text) <= LONGEST_VALUE_SHOWN else text[:LONGEST_VALUE_SHOWN] + "…"


class UnsolvedError(Exception):
    """A valid scene that could not be solved; the message states the failure."""
