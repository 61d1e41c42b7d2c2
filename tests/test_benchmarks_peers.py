"""The peers: their scripts find the exact frequencies, and they are installed without touching the environment."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hydroelastic.benchmarks import peers
from hydroelastic.benchmarks.cases import CODES, Case, Code
from hydroelastic.benchmarks.peers import PEER_MODULES, PeerError, peer_folder
from hydroelastic.benchmarks.tank.cases import tank_named
from hydroelastic.benchmarks.workers import WorkerError, start_worker

PEERS = list(PEER_MODULES)
TANK_PEERS = [code for code in PEERS if code in CODES]


def silent(_message: str) -> None:
    pass


def folder_or_skip(code: Code) -> Path | None:
    try:
        return peer_folder(code, install=False, report=silent)
    except PeerError as error:
        pytest.skip(f"{error}; `./hydro bench` installs it")


@pytest.mark.slow
@pytest.mark.parametrize("code", TANK_PEERS)
def test_scripts_of_the_peers_find_the_exact_frequencies(code: Code) -> None:
    with start_worker(code, folder_or_skip(code)) as worker:
        for name, variant in (
            ("base_s0", "whole"),
            ("base_s0", "halves"),
            ("base_s1", "halves"),
            ("vlfs_dock_s1", "whole"),
        ):
            case = Case(code=code, tank=name, variant=variant, degree=7)  # type: ignore[arg-type]
            _, answer = worker.solve(case)
            errors = np.array(answer.values) / tank_named(name).frequencies - 1.0
            # Ritz values come from above; degree 7 leaves 1.2e-6 at the most (measured, NGSolve on halves of base_s0).
            assert errors.min() > -1e-11
            assert errors.max() < 4e-6
        # The environment's own stay in front of what the folder might have.
        assert worker.versions["NumPy"] == np.__version__


@pytest.mark.parametrize("code", PEERS)
def test_a_peer_that_is_missing_is_one_error(code: Code, tmp_path: Path) -> None:
    if peers.PathFinder.find_spec(PEER_MODULES[code]) is not None:
        pytest.skip("the environment itself has it")
    with pytest.raises(WorkerError, match="No module named"), start_worker(code, tmp_path):
        pass


@pytest.fixture
def empty_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache without peers, and an environment that has none."""
    monkeypatch.setenv("HYDROELASTIC_CACHE", str(tmp_path / "cache"))
    found = peers.PathFinder.find_spec
    monkeypatch.setattr(peers.PathFinder, "find_spec", lambda name, path=None: found(name, path) if path else None)
    return tmp_path / "cache"


def pip_that(monkeypatch: pytest.MonkeyPatch, behaves: Any) -> None:
    def run(command: list[str], **_settings: Any) -> subprocess.CompletedProcess[str]:
        return behaves(command)

    monkeypatch.setattr(peers.subprocess, "run", run)


def test_without_installation_the_cache_is_not_touched(empty_cache: Path) -> None:
    with pytest.raises(PeerError, match="not installed"):
        peer_folder("ngsolve", install=False, report=silent)
    assert not empty_cache.exists()


@pytest.mark.parametrize(
    ("code", "declared"),
    [
        ("ngsolve", "ngsolve>="),
        ("scikit-fem", "scikit-fem>="),
        ("capytaine", "capytaine>="),
        ("moorpy", "moorpy>="),
        ("moordyn", "moordyn>="),
    ],
)
def test_pip_gets_the_declared_range_and_keeps_numpy(
    code: Code, declared: str, empty_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []
    pins: list[str] = []

    def pip(command: list[str]) -> subprocess.CompletedProcess[str]:
        asked.append(command)
        pins.append(Path(command[command.index("--constraint") + 1]).read_text(encoding="utf-8"))
        (peers._packages(Path(command[command.index("--prefix") + 1])) / PEER_MODULES[code]).mkdir(parents=True)
        return subprocess.CompletedProcess(command, 0, "", "")

    pip_that(monkeypatch, pip)
    said: list[str] = []
    folder = peer_folder(code, install=True, report=said.append)
    assert folder is not None
    assert folder.is_relative_to(empty_cache)
    ((*_, requirement),) = asked
    assert requirement.startswith(declared)
    assert f"numpy=={np.__version__}\n" in pins[0]
    assert len(said) == 1
    # A second run finds it.
    assert peer_folder(code, install=True, report=said.append) == folder
    assert (len(asked), len(said)) == (1, 1)
    assert [path.suffix for path in empty_cache.iterdir()] == [""]


def test_what_cannot_be_read_is_told(empty_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pip_that(monkeypatch, lambda command: subprocess.CompletedProcess(command, 0, "", ""))
    with pytest.raises(PeerError, match=r"has no capytaine that can be read; remove it"):
        peer_folder("capytaine", install=True, report=silent)
    (folder,) = empty_cache.iterdir()
    assert folder.stat().st_mode == empty_cache.stat().st_mode


def test_a_failed_installation_leaves_nothing_and_says_why(empty_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def pip(command: list[str]) -> subprocess.CompletedProcess[str]:
        words = "Looking around\nERROR: No matching distribution found\n"
        return subprocess.CompletedProcess(command, 1, "", words)

    pip_that(monkeypatch, pip)
    with pytest.raises(PeerError, match=r"pip ended with code 1: ERROR: No matching distribution found"):
        peer_folder("ngsolve", install=True, report=silent)
    assert list(empty_cache.iterdir()) == []


def test_a_cache_that_cannot_be_written_is_told(empty_cache: Path) -> None:
    empty_cache.write_text("a file", encoding="utf-8")
    with pytest.raises(PeerError, match="cannot be written"):
        peer_folder("ngsolve", install=True, report=silent)


def test_no_other_folder_imports_the_benchmark_or_its_peers() -> None:
    program = (
        "import sys, hydroelastic.scenes.command_line, hydroelastic.modal\n"
        "names = ('ngsolve', 'netgen', 'skfem', 'capytaine', 'moorpy', 'moordyn', 'hydroelastic.benchmarks')\n"
        "wrong = [n for n in sys.modules if n.startswith(names)]\n"
        "print(*wrong)\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "\n", "")
