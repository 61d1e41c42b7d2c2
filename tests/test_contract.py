"""What users may rely on changes only where that is meant."""

import difflib

from contract import FILE, contract


def test_the_contract_is_what_it_was() -> None:
    kept = FILE.read_text(encoding="utf-8")
    changes = list(difflib.unified_diff(kept.splitlines(), contract().splitlines(), "kept", "now", lineterm="", n=0))
    assert changes == [], "if it is meant: ./hydro python tests/support/contract.py, and a line in CHANGELOG.md"
