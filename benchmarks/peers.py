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
from importlib.metadata import requires, version
from pathlib import Path

MODULES = {"scikit-fem": "skfem", "open-flash": "openflash"}
"""Names of modules that differ from those of their packages."""
_KEPT = [f"{name}=={version(name)}" for name in ("numpy", "scipy")]
_OPTIONS = ["--disable-pip-version-check", "--no-input", "--quiet", "--no-warn-script-location"]


class PeerError(RuntimeError):
    """A peer is not there and cannot be installed; the message says why."""


def peer_folder(package: str, *, install: bool, report: Callable[[str], None]) -> str:
    """Return where the modules of a peer are; empty where the environment has them."""
    module = MODULES.get(package, package)
    if PathFinder.find_spec(module) is not None:
        return ""
    pattern = rf"({package}\b[^;]*);\s*extra\s*==\s*['\"]bench['\"]"
    found = [match[1].strip() for line in requires("hydroelastic") or () if (match := re.match(pattern, line))]
    if not found:
        raise PeerError(f"the metadata of hydroelastic do not name {package}")
    parts = [*found, *_KEPT, str(sys.implementation.cache_tag), sysconfig.get_platform()]
    fingerprint = hashlib.sha256("\n".join(parts).encode()).hexdigest()[:12]
    folder = cache_folder() / f"benchmark-peers-{fingerprint}"
    if not folder.is_dir():
        if not install:
            raise PeerError("not installed")
        report(f"installing {found[0]} into {folder}")
        _install(found[0], folder)
    base = {"base": str(folder), "platbase": str(folder)}
    packages = sysconfig.get_path("purelib", sysconfig.get_preferred_scheme("prefix"), base)
    if PathFinder.find_spec(module, [packages]) is None:
        raise PeerError(f"{folder} has no {module} that can be read; remove it to have it installed again")
    return packages


def cache_folder() -> Path:
    """Return the cache of this project: $HYDROELASTIC_CACHE, else hydroelastic in the user's cache."""
    named = os.environ.get("HYDROELASTIC_CACHE")
    above = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(named).absolute() if named else Path(above) / "hydroelastic"


def _install(requirement: str, folder: Path) -> None:
    """Let pip install into a folder, which appears whole or not at all."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        building = Path(tempfile.mkdtemp(prefix=f"{folder.name}.", suffix=".partial", dir=folder.parent))
    except OSError as error:
        raise PeerError(f"the cache {folder.parent} cannot be written ({error.strerror or error})") from error
    # OpenFLASH asks for a NumPy older than the environment's, with which it works, and for a web server.
    alone = ["--no-deps"] * requirement.startswith("open-flash")
    # pip would otherwise replace the environment's own where a peer asks for newer ones.
    (building / "constraints.txt").write_text("\n".join(_KEPT) + "\n", encoding="utf-8")
    # A prefix, for Netgen's wheel has libraries outside of its packages, which `--target` loses.
    words = [*alone, "--prefix", str(building), "--constraint", str(building / "constraints.txt"), requirement]
    try:
        command = [sys.executable, "-m", "pip", "install", *_OPTIONS, *words]
        ended = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=1800)
        if ended.returncode:
            said = [line for line in ended.stderr.splitlines() if line.strip()] or ["without a message"]
            raise PeerError(f"pip ended with code {ended.returncode}: {said[-1]}")
        building.chmod(folder.parent.stat().st_mode)  # as open as the cache, which others may share
        building.rename(folder)
    except (OSError, subprocess.TimeoutExpired) as error:
        if not folder.is_dir():  # else another process was faster
            raise PeerError(f"{folder}: {error}") from error
    finally:
        shutil.rmtree(building, ignore_errors=True)
