"""The launcher shows a checkout as the import package `hydroelastic` without installing it or writing into it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parent.parent

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


@pytest.fixture
def checkout(tmp_path):
    """A small checkout in a path with a space, with the launcher and what it reads."""
    folder = tmp_path / "a checkout"
    folder.mkdir()
    shutil.copy(CHECKOUT / "hydro", folder)
    shutil.copy(CHECKOUT / "pyproject.toml", folder)
    for name in ("launcher", "requirements"):
        shutil.copytree(CHECKOUT / name, folder / name)
    for name in ("physics", "meshes", "fem", "modal", "scenes", "benchmarks"):
        (folder / name).mkdir()
        (folder / name / "__init__.py").write_text(f"name = {name!r}\n")
    (folder / "api").mkdir()
    (folder / "api" / "__init__.py").write_text("name = 'api'\n")
    return folder


def python(checkout: Path, cache: Path, code: str) -> str:
    """Run code with the launcher of a checkout, in this Python instead of a prepared environment."""
    venv = cache.parent / "venv"
    if not venv.exists():
        (venv / "bin").mkdir(parents=True)
        # A link would make Python look for its packages beside the link.
        (venv / "bin" / "python").write_text(f'#!/bin/sh\nexec {sys.executable} -S "$@"\n')
        (venv / "bin" / "python").chmod(0o755)
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("HYDROELASTIC", "PYTHON"))}
    environment |= {"HYDROELASTIC_CACHE": str(cache), "HYDROELASTIC_INSIDE": str(venv)}
    environment["XDG_CACHE_HOME"] = str(cache / "forms")
    ended = subprocess.run(
        [checkout / "hydro", "python", "-c", code],
        env=environment,
        cwd=cache.parent,
        capture_output=True,
        text=True,
        timeout=30,
        check=True,
    )
    assert ended.stderr == ""
    return ended.stdout.strip()


def test_folders_of_the_checkout_are_subpackages(checkout, tmp_path):
    code = (
        "import hydroelastic; from hydroelastic import benchmarks, fem, meshes, modal, physics, scenes; "
        "print(*(one.name for one in (hydroelastic, benchmarks, fem, meshes, modal, physics, scenes)))"
    )
    assert python(checkout, tmp_path / "cache", code) == "api benchmarks fem meshes modal physics scenes"


def test_version_is_that_of_pyproject_and_follows_it(checkout, tmp_path):
    code = "from importlib.metadata import version; print(version('hydroelastic'))"
    project = checkout / "pyproject.toml"
    first = python(checkout, tmp_path / "cache", code)
    assert f'\nversion = "{first}"\n' in project.read_text()
    project.write_text(project.read_text().replace(f'\nversion = "{first}"\n', '\nversion = "9.8.7"\n'))
    assert python(checkout, tmp_path / "cache", code) == "9.8.7"


def test_metadata_has_the_command_and_the_requirements(checkout, tmp_path):
    code = (
        "from importlib.metadata import distribution as d; h = d('hydroelastic'); "
        "print([e.value for e in h.entry_points], len(h.requires))"
    )
    lines = [
        line
        for name in ("run", "bench")
        for line in (checkout / "requirements" / f"{name}.txt").read_text().splitlines()
    ]
    required = sum(bool(line.split("#")[0].strip()) for line in lines)
    expected = f"['hydroelastic.scenes.__main__:start'] {required}"
    assert python(checkout, tmp_path / "cache", code) == expected


def test_two_checkouts_share_a_cache_and_see_their_own_code(checkout, tmp_path):
    second = tmp_path / "second"
    shutil.copytree(checkout, second)
    (second / "fem" / "__init__.py").write_text("name = 'second fem'\n")
    code = "from hydroelastic import fem; print(fem.name)"
    assert python(checkout, tmp_path / "cache", code) == "fem"
    assert python(second, tmp_path / "cache", code) == "second fem"
    assert python(checkout, tmp_path / "cache", code) == "fem"


def test_nothing_is_written_into_the_checkout(checkout, tmp_path):
    before = sorted(checkout.rglob("*"))
    python(checkout, tmp_path / "cache", "import hydroelastic.fem")
    assert sorted(checkout.rglob("*")) == before
    # Python has kept what it compiled, but elsewhere.
    assert list((tmp_path / "cache" / "forms").rglob("fem/__init__.*.pyc"))


def test_examples_that_hypothesis_keeps_are_not_in_the_checkout(checkout, tmp_path):
    code = "import os; print(os.environ['HYPOTHESIS_STORAGE_DIRECTORY'])"
    assert Path(python(checkout, tmp_path / "cache", code)).is_relative_to(tmp_path / "cache" / "forms")
