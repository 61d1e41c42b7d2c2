"""The notebook of the documentation runs from top to bottom, as Jupyter would run it."""

import json
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOKS = sorted((ROOT / "docs").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    notebook = json.loads(path.read_text(encoding="utf-8"))
    assert notebook["nbformat"] == 4
    names: dict[str, Any] = {}
    for number, cell in enumerate(notebook["cells"], 1):
        if cell["cell_type"] != "code":
            continue
        # What is committed has no results, which would differ from machine to machine.
        assert cell["outputs"] == []
        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), names)
    # Jupyter draws the figures of pyplot, and no others, below their cell.
    assert plt.fignum_exists(names["figure"].number)
    names["figure"].savefig(tmp_path / "figure.png")
    plt.close(names["figure"])
    assert names["result"].summary["status"] == "ok"
