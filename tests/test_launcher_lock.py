"""The locked packages are within the ranges, each with hashes."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

CHECKOUT = Path(__file__).resolve().parent.parent
REQUIREMENTS = CHECKOUT / "requirements"
# Of Debian in a private root; `lock.py` finds the same.
BROUGHT_BY_DEBIAN = {"fenics-dolfinx", "mpi4py", "petsc4py", "slepc4py", "gmsh", "numpy", "scipy", "h5py"}


def entries() -> list[str]:
    """The entries of the lock, each on one line."""
    text = (REQUIREMENTS / "lock.txt").read_text().replace("\\\n", " ")
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def locked() -> dict[str, str]:
    """Versions by normalized names."""
    pairs = [re.split("==| ", entry)[:2] for entry in entries()]
    return {canonicalize_name(name): version for name, version in pairs}


def test_every_entry_is_one_version_with_hashes():
    for entry in entries():
        name, *hashes = re.split(r"\s+--hash=", entry)
        assert re.fullmatch(r"==[^=*]+", str(Requirement(name).specifier)), entry
        assert hashes, entry
        assert all(re.fullmatch(r"sha256:[0-9a-f]{64}", value.strip()) for value in hashes), entry
    assert len(locked()) == len(entries())


def test_lock_names_no_place():
    text = (REQUIREMENTS / "lock.txt").read_text()
    assert not re.search(r"://|--(extra-)?index-url|--find-links|^-[if]", text, re.MULTILINE)


@pytest.mark.parametrize("name", ["run", "dev"])
def test_lock_satisfies_the_ranges(name):
    versions = locked()
    lines = [line.split("#")[0].strip() for line in (REQUIREMENTS / f"{name}.txt").read_text().splitlines()]
    wanted = [Requirement(line) for line in lines if line]
    assert wanted
    for requirement in wanted:
        project = canonicalize_name(requirement.name)
        if project in BROUGHT_BY_DEBIAN:
            assert project not in versions
        else:
            assert requirement.specifier.contains(versions[project]), f"{requirement}: run requirements/lock.py"


def environment(checkout: Path, way: str) -> str:
    """The name of the folder in which the packages of a checkout are."""
    code = """
        checkout=$1 way=$2 suite=trixie HYDROELASTIC_CACHE=/cache
        python_executable=/python python_version=3.13.0 dolfinx_version=0.10.0
        source "$1/launcher/messages.sh"; source "$1/launcher/names.sh"
        name_folders; echo "$venv"
    """
    ended = subprocess.run(
        ["bash", "-euc", code, "bash", checkout, way], capture_output=True, text=True, check=True, timeout=30
    )
    return ended.stdout


@pytest.mark.parametrize(
    ("way", "name", "new"),
    [("root", "lock", True), ("root", "dev", False), ("active", "lock", False), ("active", "dev", True)],
)
def test_environment_is_named_by_what_it_is_made_from(tmp_path, way, name, new):
    for folder in ("launcher", "requirements"):
        shutil.copytree(CHECKOUT / folder, tmp_path / folder)
    shutil.copy(CHECKOUT / "pyproject.toml", tmp_path)
    before = environment(tmp_path, way)
    with (tmp_path / "requirements" / f"{name}.txt").open("a") as file:
        file.write("another==1.0\n")
    assert (environment(tmp_path, way) != before) == new
