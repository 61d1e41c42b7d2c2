"""Mutations of physics: a sign, a factor, a missing term, each of which the default tests must see.

    ./hydro python tests/support/mutations.py [NAME ...]

The lists are mutations/*.toml beside this file, entries of

    [[mutation]]
    name = "what is wrong then"
    file = "fem/liquid.py"
    old = "text that occurs once in the file"
    new = "text in its place"
    tests = "tests/test_front_tanks.py -k sloshing"    # default tests, some seconds, one of which fails

Each is made in a copy of the checkout. The exit code is 1 if one is not caught, or no longer fits the file.
"""

from __future__ import annotations

import shlex
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

CHECKOUT = Path(__file__).resolve().parents[2]
LISTS = Path(__file__).with_suffix("")


def mutations() -> list[dict[str, str]]:
    return [one for file in sorted(LISTS.glob("*.toml")) for one in tomllib.loads(file.read_text())["mutation"]]


def misfit(mutation: dict[str, str]) -> str:
    """Why a mutation cannot be made; empty if it can."""
    file = CHECKOUT / mutation["file"]
    count = file.read_text(encoding="utf-8").count(mutation["old"]) if file.is_file() else 0
    return "" if count == 1 else f"{mutation['file']} has its text {count} times"


def outcome(copy: Path, mutation: dict[str, str]) -> str:
    file = copy / mutation["file"]
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace(mutation["old"], mutation["new"]), encoding="utf-8")
    command = [copy / "hydro", "test", "-x", "-q", *shlex.split(mutation["tests"])]
    ended = subprocess.run(command, cwd=copy, capture_output=True, text=True, check=False)
    file.write_text(text, encoding="utf-8")
    # pytest: 1 if tests failed; 5 if there was none, 2 and 4 if they could not be collected.
    return {0: "NOT CAUGHT", 1: "caught"}.get(ended.returncode, f"NOT RUN: {ended.stdout[-300:]}{ended.stderr[-300:]}")


def main(names: list[str]) -> int:
    chosen = [one for one in mutations() if not names or one["name"] in names]
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "checkout"
        subprocess.run(["git", "clone", "--quiet", CHECKOUT, copy], check=True)
        for number, mutation in enumerate(chosen, 1):
            found = misfit(mutation) or outcome(copy, mutation)
            failed += found != "caught"
            print(f"{number:3} {mutation['name']}: {found}", flush=True)
    print(f"{len(chosen) - failed} of {len(chosen)} caught")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
