"""The package of the interface: what it imports and names, and what pip installs."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import hydroelastic as he

ROOT = Path(__file__).parent.parent


def modules_after(code: str) -> set[str]:
    code += "\nimport sys; print(*(name.partition('.')[0] for name in sys.modules))"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(ended.stdout.split())


def test_imports_come_when_they_are_needed() -> None:
    own = modules_after("from typing import TYPE_CHECKING, Any\nimport importlib")
    assert modules_after("import hydroelastic as he; dir(he)") - own <= {"hydroelastic"}
    heavy = {"dolfinx", "petsc4py", "mpi4py", "gmsh", "pydantic", "xarray", "matplotlib", "pyvista", "rich", "jinja2"}
    assert not modules_after("import hydroelastic.modal.beam.estimates") & heavy
    assert modules_after("import hydroelastic as he; he.read('aquarium')") & heavy <= {"pydantic"}


def test_names_are_listed_and_others_are_not_there() -> None:
    assert set(he.__all__) == {name for name in dir(he) if not name.startswith("_")}
    assert all(getattr(he, name) for name in he.__all__)
    with pytest.raises(AttributeError, match="module 'hydroelastic' has no attribute 'slove'"):
        he.slove  # noqa: B018


def test_pip_installs_every_folder_of_code() -> None:
    setup = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]
    folders = {".".join(file.parent.relative_to(ROOT).parts) for file in ROOT.glob("*/**/__init__.py")}
    assert set(setup["packages"]) == {"hydroelastic", *(f"hydroelastic.{name}" for name in folders - {"api"})}


@pytest.mark.slow
@pytest.mark.parametrize("way", ["--target", "--editable"])
def test_pip_installs_the_interface(way: str, tmp_path: Path) -> None:
    pytest.importorskip("setuptools")
    for name in ("api", "physics", "meshes", "modal", "fem", "output", "scenes", "benchmarks", "requirements"):
        shutil.copytree(ROOT / name, tmp_path / "checkout" / name)
    for name in ("pyproject.toml", "README.md"):
        shutil.copy(ROOT / name, tmp_path / "checkout")
    given = ["--target", tmp_path / "site", "."] if way == "--target" else ["--prefix", tmp_path, "--editable", "."]
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", *given]
    subprocess.run(pip, cwd=tmp_path / "checkout", check=True, capture_output=True)
    (site,) = {file.parent for file in tmp_path.rglob("hydroelastic-*.dist-info")}
    # Before the checkout of these tests, which is on the path by way of PYTHONPATH.
    code = f"""import site, sys
sys.path[:] = [place for place in sys.path if "checkouts" not in place]
site.addsitedir({str(site)!r})
import hydroelastic as he, hydroelastic.modal.beam as beam
print(he.__file__, beam.__file__, len(he.solve("swell")._repr_html_()), sep="\\n")"""
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, check=True)
    files = ended.stdout.splitlines()
    assert all(Path(file).is_relative_to(tmp_path) for file in files[:2])
    assert int(files[2]) > 1000
