"""Bad input, a full disk, a missing folder: one clear message and exit code 2, without a traceback."""

import json
import os
import pty
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

COARSE = ("--set", "accuracy.modes=1", "--set", "accuracy.tolerance=1e-2", "--no-images")
DOTS = "a." * 30_000
# Of memory, in bytes: a command takes far less, and a key of 30,000 names took 3.6 GB.
MOST = 3 * 10**9


def run(
    *arguments: str, folder: Path, limit: Callable[[], None] | None = None, **more: Any
) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "hydroelastic.scenes", *arguments]
    settings = {"capture_output": True, "encoding": "utf-8", "timeout": 120, "check": False} | more
    found: subprocess.CompletedProcess[str] = subprocess.run(command, cwd=folder, preexec_fn=limit, **settings)
    return found


def refused(found: subprocess.CompletedProcess[str], *words: str) -> None:
    assert found.returncode == 2, found.stderr[-2000:]
    assert found.stderr.startswith("Error: ")
    assert len(found.stderr.splitlines()) == 1
    for word in words:
        assert word in found.stderr


def little_memory() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MOST, MOST))


NESTED = {
    "a key of 30,000 names": f"{DOTS}b = 1",
    "a table of 30,000 names": f"[{DOTS}b]",
    "a key of 400 names": ".".join("a" * 400) + " = 1",
    "400 keys, one for each level": "\n".join(f"[{'.'.join('a' * depth)}]" for depth in range(1, 90)),
    "tables in tables": "x = " + "{ a = " * 300 + "1" + " }" * 300,
    "lists in lists": "x = " + "[" * 400 + "]" * 400,
    "lists that end nowhere": "x = " + "[" * 50_000,
}


@pytest.mark.slow_but("a key of 30,000 names", "tables in tables")
@pytest.mark.parametrize("text", NESTED.values(), ids=list(NESTED))
def test_deep_nesting_is_refused_before_it_takes_memory(text: str, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(f'kind = "tank"\n{text}\n', encoding="utf-8")
    refused(run("check", "scene.toml", folder=tmp_path, limit=little_memory), "scene.toml", "nested too deeply")


@pytest.mark.slow_but("names")
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("check", "aquarium", "--set", f"{DOTS}b=1"), "too many names"),
        (("check", "aquarium", "--set", f"x={{{DOTS}b=1}}"), "not TOML"),
        (("sweep", "aquarium", "--vary", f"x={{{DOTS}b=1}}"), "x"),
    ],
    ids=["names", "value", "values"],
)
def test_deep_nesting_of_options_is_refused(words: tuple[str, ...], said: str, tmp_path: Path) -> None:
    refused(run(*words, folder=tmp_path, limit=little_memory), said)


def test_deep_nesting_of_dictionaries_is_refused() -> None:
    deep: dict[str, Any] = {}
    for _ in range(5000):
        deep = {"a": deep}
    for read in (lambda: he.read(deep), lambda: he.read("aquarium", {"tank": deep})):
        with pytest.raises(he.SceneError, match="nested too deeply"):
            read()


def test_a_standard_input_without_a_scene_is_refused(tmp_path: Path) -> None:
    refused(run("check", "-", folder=tmp_path, stdin=subprocess.DEVNULL), "the standard input", "empty")
    closed = run("check", "-", folder=tmp_path, limit=lambda: os.close(0))
    refused(closed, "the standard input", "closed", "name its file")
    ours, theirs = pty.openpty()
    refused(run("check", "-", folder=tmp_path, stdin=theirs), "the standard input", "a terminal", "name its file")
    os.close(ours)
    os.close(theirs)


def test_kinds_of_scenes_are_not_varied(tmp_path: Path) -> None:
    refused(run("sweep", "aquarium", "--vary", 'kind="sea","tank"', folder=tmp_path), "--vary", "kind", "by itself")
    assert not (tmp_path / "results").exists()


@pytest.mark.slow_but("file-command1", "missing-command2")
@pytest.mark.parametrize("command", [("run", "swell"), ("run", "aquarium"), ("check", "scow_in_a_basin")])
@pytest.mark.parametrize("folder", ["missing", "file"])
def test_a_temporary_folder_that_cannot_be_used_is_named(command: tuple[str, ...], folder: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    place = str(tmp_path / folder)
    refused(run(*command, folder=tmp_path, env=os.environ | {"TMPDIR": place}), place, "TMPDIR")
    assert not (tmp_path / "results").exists()


def test_a_journal_that_ends_within_a_character_is_gone_on_with(tmp_path: Path) -> None:
    def table() -> Any:
        found = he.sweep(he.read("string_ramp"), {"string.resistance": [0.1, 0.2]}, out=tmp_path).table
        return found[[name for name in found if "memory" not in name]]

    before, journal = table(), tmp_path / "sweep.journal"
    journal.write_bytes(journal.read_bytes()[:-300] + "ω".encode()[:1])
    assert table().equals(before)


# Memory that processes share is a file too.
ALONE = {"OMPI_MCA_btl": "self"}


def small_files() -> None:
    # Of any file that is written, as on a disk that becomes full.
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


def test_a_full_disk_names_the_journal(tmp_path: Path) -> None:
    vary = ("--vary", "string.resistance=0.1:0.3:5", "--no-images", "--out", "sweep")
    found = run("sweep", "string_ramp", *vary, folder=tmp_path, limit=small_files, env=os.environ | ALONE)
    refused(found, "sweep.journal", "File too large", "Make room")


@pytest.mark.slow_but("a file")
@pytest.mark.parametrize("limit", [small_files, None], ids=["full", "a file"])
def test_a_cache_that_cannot_be_written_is_named(limit: Callable[[], None] | None, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    if limit is None:
        cache.touch()
    environment = os.environ | ALONE | {"XDG_CACHE_HOME": str(cache)}
    found = run("run", "scow_in_a_basin", *COARSE, folder=tmp_path, limit=limit, env=environment)
    refused(found, str(cache), "cache of compiled kernels", "XDG_CACHE_HOME")


def test_a_full_output_is_still_told(tmp_path: Path) -> None:
    with open("/dev/full", "wb") as full:
        found = run("check", "aquarium", folder=tmp_path, capture_output=False, stdout=full, stderr=subprocess.PIPE)
    refused(found, "nothing can be printed")


FOREIGN = ["{}", "[1]", "null", '{"scene": {"kind": "tank"}, "status": "ok"}', '{"a":' * 100_000, "no JSON"]


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("saved") / "swell"
    he.solve(he.read("swell")).save(folder, images=None)
    return folder


@pytest.mark.parametrize("text", FOREIGN, ids=[text[:20] for text in FOREIGN])
def test_the_summary_of_another_program_is_not_loaded(text: str, saved: Path, tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    folder = Path(shutil.copytree(saved, tmp_path / "other"))
    assert json.loads(json.dumps(he.load(folder).summary))
    dataset = xarray.load_dataset(folder / "dataset.nc", engine="scipy")
    dataset["summary"] = ((), text)
    dataset.to_netcdf(folder / "dataset.nc", engine="scipy")
    with pytest.raises(he.SceneError, match=r"dataset\.nc or summary\.md is damaged, or is not that of a solved scene"):
        he.load(folder)
    with pytest.raises(he.SceneError, match="result folder 3"):
        he.load(3)  # type: ignore[arg-type]


TRACES = {
    "solved": ("run", "aquarium", "--set", "accuracy.modes=1", "--set", "accuracy.tolerance=1e-2"),
    "checked": ("check", "scow_in_a_basin"),
    "refused": ("run", "aquarium", "--set", "body.1.start=90"),
    "swept": ("sweep", "string_ramp", "--vary", "string.resistance=0.1,0.2", "--jobs", "2", "--no-images"),
}


@pytest.mark.slow_but("solved")
@pytest.mark.parametrize("arguments", TRACES.values(), ids=list(TRACES))
def test_nothing_is_left_in_the_temporary_folder_or_the_home(arguments: tuple[str, ...], tmp_path: Path) -> None:
    folders = {name: tmp_path / name for name in ("TMPDIR", "HOME", "here")}
    for folder in folders.values():
        folder.mkdir()
    environment = {name: value for name, value in os.environ.items() if name != "MPLCONFIGDIR"}
    environment |= {name: str(folder) for name, folder in folders.items() if name != "here"}
    environment.setdefault("XDG_CACHE_HOME", str(tmp_path / "cache"))
    run(*arguments, folder=folders["here"], env=environment)
    assert not list(folders["TMPDIR"].iterdir())
    assert not list(folders["HOME"].iterdir())
