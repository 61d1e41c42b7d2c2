"""The codes that are compared with: found in the environment, or installed into a folder of their own in the cache.

What is to be installed is the extra ``bench`` of this package. The folder is added behind all that the environment
has, in the process of that code alone, and NumPy and SciPy are not installed again: what they are stays as it is.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Callable
from importlib.machinery import PathFinder
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

from hydroelastic.benchmarks.cases import Code

PEER_MODULES: dict[Code, str] = {
    "ngsolve": "ngsolve",
    "ngsolve loop": "ngsolve",
    "scikit-fem": "skfem",
    "capytaine": "capytaine",
    "moorpy": "moorpy",
    "moordyn": "moordyn",
    "ngsolve plan": "ngsolve",
    "ngsolve volume": "ngsolve",
    "capytaine buoy": "capytaine",
    "open-flash": "openflash",
}
EXTRA = "bench"
_KEPT = ("numpy", "scipy")
_MOST_SECONDS = 1800
# It asks for a NumPy older than the environment's, with which it works, and for a web server.
_ALONE = ("open-flash",)


class PeerError(RuntimeError):
    """A peer is not there and cannot be installed; the message says why."""


def peer_folder(code: Code, *, install: bool, report: Callable[[str], None]) -> Path | None:
    """Where the packages of a peer are."""
    # `importlib.util.find_spec` would find what this process has imported from elsewhere, too.
    if PathFinder.find_spec(PEER_MODULES[code]) is not None:
        return None
    # The same package in another way has its name first.
    requirement = _requirement(code.split()[0])
    folder = cache_folder() / f"benchmark-peers-{_fingerprint(requirement)}"
    if not folder.is_dir():
        if not install:
            raise PeerError(f"{code} is not installed, and no installation was asked for")
        report(f"installing {requirement} into {folder}")
        _install(requirement, folder)
    packages = _packages(folder)
    if PathFinder.find_spec(PEER_MODULES[code], [str(packages)]) is None:
        raise PeerError(f"{folder} has no {PEER_MODULES[code]} that can be read; remove it to have it installed again")
    return packages


def cache_folder() -> Path:
    """The cache of this project: $HYDROELASTIC_CACHE, else hydroelastic in the user's cache."""
    named = os.environ.get("HYDROELASTIC_CACHE")
    above = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(named).absolute() if named else Path(above) / "hydroelastic"


def _requirement(package: str) -> str:
    """The requirement of a peer's package, as the metadata of this package have it."""
    try:
        declared = requires("hydroelastic") or []
    except PackageNotFoundError:
        declared = []
    for line in declared:
        requirement, _, marker = line.partition(";")
        name = re.match(r"[A-Za-z0-9._-]+", requirement.strip())
        if name and name[0].lower() == package and re.search(rf"extra\s*==\s*['\"]{EXTRA}['\"]", marker):
            return requirement.strip()
    raise PeerError(f"the metadata of hydroelastic do not name {package}; start with ./hydro, or install the package")


def _fingerprint(requirement: str) -> str:
    kept = [f"{name}=={version(name)}" for name in _KEPT]
    parts = [requirement, *kept, str(sys.implementation.cache_tag), sysconfig.get_platform()]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:12]


def _install(requirement: str, folder: Path) -> None:
    """Let pip install into a folder, which appears whole or not at all."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        building = Path(tempfile.mkdtemp(prefix=f"{folder.name}.", suffix=".partial", dir=folder.parent))
        building.chmod(folder.parent.stat().st_mode)  # as open as the cache, which others may share
    except OSError as error:
        raise PeerError(f"the cache {folder.parent} cannot be written ({error.strerror or error})") from error
    try:
        # pip would otherwise replace the environment's own where a peer asks for newer ones.
        constraints = building / "constraints.txt"
        constraints.write_text("".join(f"{name}=={version(name)}\n" for name in _KEPT), encoding="utf-8")
        # A prefix, for Netgen's wheel has libraries outside of its packages, which `--target` loses.
        alone = ["--no-deps"] * requirement.startswith(_ALONE)
        _pip("install", *alone, "--prefix", str(building), "--constraint", str(constraints), requirement)
        try:
            building.rename(folder)
        except OSError:
            if not folder.is_dir():  # else another process was faster
                raise
    except OSError as error:
        raise PeerError(f"{folder} cannot be written ({error.strerror or error})") from error
    finally:
        shutil.rmtree(building, ignore_errors=True)


def _pip(*arguments: str) -> None:
    options = ["--disable-pip-version-check", "--no-input", "--quiet", "--no-warn-script-location"]
    environment = {
        name: value for name, value in os.environ.items() if name not in ("PIP_TARGET", "PIP_PREFIX", "PIP_USER")
    }
    command = [sys.executable, "-m", "pip", arguments[0], *options, *arguments[1:]]
    try:
        ended = subprocess.run(
            command, capture_output=True, text=True, errors="replace", env=environment, timeout=_MOST_SECONDS
        )
    except subprocess.TimeoutExpired as error:
        raise PeerError(f"pip did not end within {_MOST_SECONDS} s") from error
    if ended.returncode:
        said = [line for line in ended.stderr.splitlines() if line.strip()]
        errors = [line for line in said if line.startswith("ERROR")] or said
        raise PeerError(f"pip ended with code {ended.returncode}: {' '.join(errors[-2:]) or 'without a message'}")


def _packages(prefix: Path) -> Path:
    scheme = sysconfig.get_preferred_scheme("prefix")
    return Path(sysconfig.get_path("purelib", scheme, {"base": str(prefix), "platbase": str(prefix)}))
