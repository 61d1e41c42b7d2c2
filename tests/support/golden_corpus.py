"""The golden corpus: what users receive from some eighty commands, made of any commit, and compared within its errors.

    python3 tests/support/golden_corpus.py make FOLDER [--commit COMMIT] [--subset | --only NAME ...]
    python3 tests/support/golden_corpus.py compare BEFORE AFTER
    python3 tests/support/golden_corpus.py reference      # the subset again, into tests/reference/corpus/

It needs Python and git alone; each command runs by the launcher of the commit. The cases are in ``corpus_cases.toml``:
those of this working copy, whichever commit is run. ``corpus_records.py`` tells what is compared, and how.
"""

from __future__ import annotations

import argparse
import json
import os
import shlex
import subprocess
import tempfile
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
RECORDS = ROOT / "tests" / "support" / "corpus_records.py"
REFERENCE = ROOT / "tests" / "reference" / "corpus"
CASES: dict[str, dict[str, Any]] = tomllib.loads((ROOT / "tests/support/corpus_cases.toml").read_text(encoding="utf-8"))
SUBSET = tuple(name for name, case in CASES.items() if case.get("subset"))


def run_case(name: str, folder: Path, program: Iterable[str]) -> None:
    """Run the command of a case; its results, exit code and output are then in the folder.

    Args:
        name: of the case.
        folder: for it alone.
        program: words with which a command line of the program begins.
    """
    case = CASES[name]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "record.json").unlink(missing_ok=True)
    scene = ROOT / "scenes" / f"{case['scene']}.toml"
    if "\n" in case["scene"]:
        scene = folder / "scene.toml"
        scene.write_text(case["scene"], encoding="utf-8")
    command, *options = shlex.split(case.get("command", "run --no-images --quiet"))
    options += [part for change in case.get("set", ()) for part in ("--set", change)]
    if command not in ("check", "compare"):
        options += ["--out", str(folder / "results")]
    words = [*program, command, str(scene), *options]
    wide = {**os.environ, "COLUMNS": "200", "NO_COLOR": "1"}
    done = subprocess.run(words, capture_output=True, text=True, env=wide, check=False)
    told = {"command": command, "exit code": done.returncode, "output": done.stdout, "errors": done.stderr}
    (folder / "case.json").write_text(json.dumps(told, ensure_ascii=False, indent=0), encoding="utf-8")


def make(folder: Path, names: Iterable[str], commit: str | None = None) -> None:
    """Run cases by the program of a commit or tag, or of the working copy, each into a folder of its name."""
    with tempfile.TemporaryDirectory() as temporary:
        tree = ROOT if commit is None else Path(temporary)
        if commit is not None:
            packed = subprocess.run(["git", "-C", str(ROOT), "archive", commit], stdout=subprocess.PIPE, check=True)
            subprocess.run(["tar", "-x", "-C", str(tree)], input=packed.stdout, check=True)
        for name in names:
            run_case(name, folder.resolve() / name, [str(tree / "hydro")])
            code = json.loads((folder / name / "case.json").read_text(encoding="utf-8"))["exit code"]
            print(f"{name}: exit code {code}", flush=True)


def by_records(*words: str) -> int:
    """Run `corpus_records.py`, which needs the libraries of the program, and return its exit code."""
    return subprocess.run([str(ROOT / "hydro"), "python", str(RECORDS), *words], check=False).returncode


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="Make golden corpora and compare them.")
    commands = parser.add_subparsers(dest="command", required=True)
    making = commands.add_parser("make", help="run all cases, or those named, and write their results")
    making.add_argument("folder", type=Path)
    making.add_argument("--commit", help="commit or tag whose program is run; by default the working copy")
    part = making.add_mutually_exclusive_group()
    part.add_argument("--subset", action="store_const", dest="names", const=SUBSET, help="what the default tests run")
    part.add_argument("--only", nargs="+", dest="names", metavar="NAME", choices=CASES, help="these cases")
    comparing = commands.add_parser("compare", help="print what differs; exit code 1 if anything does")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    commands.add_parser("reference", help="make anew what the default tests compare with")
    asked = parser.parse_args()
    if asked.command == "make":
        make(asked.folder, asked.names or CASES, asked.commit)
    elif asked.command == "compare":
        raise SystemExit(by_records("compare", str(asked.before.resolve()), str(asked.after.resolve())))
    else:
        REFERENCE.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as temporary:
            make(Path(temporary), SUBSET)
            raise SystemExit(by_records("reference", temporary, str(REFERENCE)))


if __name__ == "__main__":
    main()
