"""The page of the architecture knows every folder of code, and the order in which imports may point."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
MAP = PAGE.split("## Folders")[1].split("\n## ")[0]
TABLE = [line.split("|")[1] for line in MAP.splitlines() if line.startswith("|")]


def test_every_folder_of_code_is_on_the_map() -> None:
    packages = [file.parent.relative_to(ROOT) for file in ROOT.glob("*/**/__init__.py")]
    assert packages
    assert [str(folder) for folder in packages if f"`{folder.as_posix()}/`" not in MAP] == []


def test_every_folder_of_the_map_exists() -> None:
    folders = [name for cell in TABLE for name in cell.split("`")[1::2]]
    assert len(folders) > 20
    assert [name for name in folders if not (ROOT / name).is_dir()] == []


def test_order_of_imports_is_that_of_the_linter() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = project["tool"]["importlinter"]["contracts"]
    within = next(contract for contract in contracts if contract.get("containers") == ["hydroelastic.scenes"])
    order = [layer for layer in reversed(within["layers"]) if " " not in layer]
    told = MAP.split("Within `scenes`:")[1]
    places = [told.index(f"`{layer}`") for layer in order]
    assert places == sorted(places)
