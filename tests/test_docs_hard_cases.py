"""The catalogue of hard cases covers all systems, and each of its rows names a test that is there."""

import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
PAGE = (TESTS.parent / "docs" / "hard_cases.md").read_text(encoding="utf-8")
SYSTEMS = ("Beams in tanks", "Floats and two liquids", "Open water", "Strings", "Ships", "Threads")


@pytest.mark.parametrize("system", SYSTEMS)
def test_each_row_names_a_test(system: str) -> None:
    section = PAGE.split(f"\n## {system}\n")[1].split("\n## ")[0]
    if system == "Beams in tanks":
        # One file has all of them, case by case.
        assert "| cases of `test_hard_cases.py` |" in section
        return
    rows = [line for line in section.splitlines() if line.startswith("| ") and not line.startswith("| case ")]
    assert len(rows) >= 7
    for row in rows:
        named = row.rpartition("|")[0].rpartition(" | ")[2]
        files = re.findall(r"`(test_\w+)\.py`(?:: ((?:`test_\w+`(?:, )?)+))?", named)
        assert files, row
        for file, functions in files:
            text = (TESTS / f"{file}.py").read_text(encoding="utf-8")
            for function in re.findall(r"`(\w+)`", functions):
                assert f"def {function}(" in text, f"{function} in {file}"
