"""The notebook of the documentation runs from top to bottom, as Jupyter would run it."""

import ast
import json
from pathlib import Path
from typing import Any

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
        *body, last = ast.parse("".join(cell["source"])).body
        name = f"{path.name}, cell {number}"
        exec(compile(ast.Module(body, []), name, "exec"), names)
        if isinstance(last, ast.Expr):
            shown = eval(compile(ast.Expression(last.value), name, "eval"), names)
            # Jupyter shows the last value; a figure draws itself then.
            if hasattr(shown, "savefig"):
                shown.savefig(tmp_path / "figure.png")
        else:
            exec(compile(ast.Module([last], []), name, "exec"), names)
    assert names["result"].summary["status"] == "ok"
