"""A line that hangs below its lower fixed end: that no sea bed is modelled is said by `check` and `run`."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

CHAIN = """
kind = "thread"
[thread]
length = 850.0
weight = 5865.84
axial_rigidity = 3.27e9
[ends.a]
kind = "fixed"
position = [-837.6, 0.0, -200.0]
[ends.b]
kind = "fixed"
position = [-58.0, 0.0, -14.0]
[output]
positions = [0.0, 850.0]
[accuracy]
tolerance = 1e-4
"""
# Lowest z of the catenary with Hooke's law (Irvine, 1981), of whose end forces SciPy's root finder gives 12 digits.
LOWEST = "-250.387"


@pytest.fixture
def chain(tmp_path: Path) -> Path:
    file = tmp_path / "chain.toml"
    file.write_text(CHAIN, encoding="utf-8")
    return file


def said(*arguments: str) -> str:
    command = [sys.executable, "-m", "hydroelastic.scenes", *arguments]
    found = subprocess.run(command, capture_output=True, text=True, check=True)
    return " ".join((found.stdout + found.stderr).split())


def warnings_of(**thread: Any) -> list[str]:
    a, b = thread.pop("a"), thread.pop("b")
    return list(
        he.solve(
            {"kind": "thread", "thread": thread, "ends": {"a": a, "b": b}, "accuracy": {"tolerance": 1e-4}}
        ).summary["warnings"]
    )


def fixed(x: float, z: float) -> dict[str, Any]:
    return {"kind": "fixed", "position": [x, 0.0, z]}


def test_check_says_how_far_a_line_hangs_below_its_anchor(chain: Path) -> None:
    # All six digits: it is the same closed form.
    words = said("check", str(chain))
    assert f"z = {LOWEST} m" in words
    assert "No sea bed is modelled" in words


def test_a_run_warns_of_it_in_words_in_tables_and_in_the_summary(chain: Path, tmp_path: Path) -> None:
    words = said("run", str(chain), "--no-images", "--quiet", "--out", str(tmp_path / "results"))
    assert "No sea bed is modelled" in words
    (warning,) = json.loads((tmp_path / "results" / "summary.json").read_text(encoding="utf-8"))["warnings"]
    assert warning in (tmp_path / "results" / "summary.md").read_text(encoding="utf-8").replace("\\", "")
    # The tolerance allows 1e-4 of 850 m, and points between which a parabola is followed; found are all digits.
    below = float(warning.partition("z = ")[2].partition(" m")[0])
    assert below == pytest.approx(float(LOWEST), abs=0.09)


def test_lines_that_stay_above_their_lower_end_or_hang_freely_are_not_warned_of() -> None:
    taut = warnings_of(length=200.0, weight=100.0, axial_rigidity=1e5, a=fixed(0.0, -200.0), b=fixed(100.0, 0.0))
    assert taut == []
    hanging = warnings_of(length=100.0, weight=100.0, a={"kind": "free", "weight": 100.0}, b=fixed(0.0, 0.0))
    assert hanging == []
    in_air = warnings_of(length=120.0, mass=10.0, a=fixed(0.0, -2.0), b=fixed(100.0, 0.0))
    assert in_air == []
    between_equal_heights = warnings_of(length=120.0, weight=100.0, a=fixed(0.0, 0.0), b=fixed(100.0, 0.0))
    assert between_equal_heights == []
