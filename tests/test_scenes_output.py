"""Result folders: whole or not at all, and never over what no run has written."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from command import assert_refused, run_command

import hydroelastic as he


@pytest.fixture(scope="module")
def save() -> Callable[[Path], None]:
    """Writes a result that takes no time."""
    result = he.solve("swell")

    def saved(folder: Path) -> None:
        result.save(folder, images=None)

    return saved


Save = Callable[[Path], None]
FILES = {"summary.json", "summary.md", "response.csv", "dataset.nc"}


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_a_result_appears_with_the_folders_above_it(save: Save, tmp_path: Path) -> None:
    save(tmp_path / "a" / "b" / "result")
    assert names(tmp_path / "a" / "b") == {"result"}
    assert names(tmp_path / "a" / "b" / "result") == FILES
    (tmp_path / "empty").mkdir()
    save(tmp_path / "empty")
    assert names(tmp_path / "empty") == FILES


def test_a_previous_result_is_replaced_as_a_whole(save: Save, tmp_path: Path) -> None:
    he.solve("string_smooth").save(tmp_path / "result", images=None)
    assert "fields" in names(tmp_path / "result")
    save(tmp_path / "result")
    assert names(tmp_path / "result") == FILES
    assert names(tmp_path) == {"result"}


def test_what_no_run_has_written_is_kept(save: Save, tmp_path: Path) -> None:
    target = tmp_path / "result"
    save(target)
    (target / "mine").mkdir()
    (target / "mine" / "notes.md").write_text("notes", encoding="utf-8")
    (target / "mine" / "link").symlink_to("nowhere")
    (target / "mine.toml").touch()
    inode = (target / "mine.toml").stat().st_ino
    for _ in range(2):
        save(target)
        assert names(target) == FILES | {"mine", "mine.toml"}
        assert (target / "mine" / "notes.md").read_text(encoding="utf-8") == "notes"
        assert (target / "mine" / "link").is_symlink()
        # The same file: an editor that has it open goes on with it.
        assert (target / "mine.toml").stat().st_ino == inode


def test_results_that_were_changed_are_kept_under_another_name(save: Save, tmp_path: Path) -> None:
    target = tmp_path / "result"
    save(target)
    for text in ("first remark", "second remark"):
        time.sleep(0.02)  # of the resolution of times of files
        (target / "response.csv").write_text(text, encoding="utf-8")
        save(target)
    assert (target / "response.csv").read_text(encoding="utf-8").startswith("t")
    assert (target / "response.csv.kept").read_text(encoding="utf-8") == "first remark"
    assert (target / "response.csv.kept.kept").read_text(encoding="utf-8") == "second remark"


@pytest.mark.parametrize("ending", [".partial", ".previous"])
def test_what_killed_runs_have_left_is_removed_and_no_more(save: Save, tmp_path: Path, ending: str) -> None:
    target, remains, other = (
        tmp_path / name for name in ("result", f".result.0a1b2c3d{ending}", f".x.0a1b2c3d{ending}")
    )
    for folder in (target, remains, other):
        save(folder)
    save(target)
    assert names(tmp_path) == {"result", other.name}


def test_a_run_that_was_killed_amid_the_exchange_gives_its_old_results_back(save: Save, tmp_path: Path) -> None:
    save(tmp_path / ".result.0a1b2c3d.previous")
    (tmp_path / ".result.0a1b2c3d.previous" / "notes.md").touch()
    save(tmp_path / "result")
    assert names(tmp_path / "result") == FILES | {"notes.md"}
    assert names(tmp_path) == {"result"}


@pytest.mark.parametrize(
    "listed", ["{}", "not JSON", "[1]", '{"scene_file": 1, "files": []}', '{"scene_file": "", "files": {}}']
)
def test_foreign_folders_are_refused_and_kept(save: Save, tmp_path: Path, listed: str) -> None:
    target = tmp_path / "mine"
    target.mkdir()
    (target / "thesis.tex").touch()
    (target / "summary.json").write_text(listed, encoding="utf-8")
    before = names(target)
    with pytest.raises(he.SceneError, match="not a result folder"):
        save(target)
    assert names(target) == before


def test_places_that_cannot_be_written_are_refused_before_solving(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    for path in ("file", "file/below", ".", "..", "/", "/proc/result", "n" * 300):
        assert_refused(run_command("run", "aquarium", "--out", path), "output folder")
    assert names(tmp_path) == {"file"}


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write anywhere")
def test_a_folder_without_permission_is_refused(save: Save, tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(he.SceneError, match="Permission denied"):
        save(tmp_path / "result")


def test_a_link_stays_a_link(save: Save, tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    save(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert names(tmp_path / "real") == FILES


def test_nothing_is_left_when_writing_fails(save: Save, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_arguments: Any, **_settings: Any) -> None:
        raise OSError(28, os.strerror(28))

    save(tmp_path / "old")
    (tmp_path / "old" / "response.csv").write_text("mine", encoding="utf-8")
    monkeypatch.setattr(Path, "write_text", full)
    for target in (tmp_path / "old", tmp_path / "made" / "deeper" / "result"):
        with pytest.raises(he.SceneError, match="No space left"):
            save(target)
    assert names(tmp_path) == {"old"}
    assert (tmp_path / "old" / "response.csv").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_process_that_is_ended_while_it_writes_cleans_up(tmp_path: Path, number: signal.Signals) -> None:
    program = (
        "import pathlib, signal, sys, time, hydroelastic as he\n"
        # A shell may start background jobs with this ignored.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "result = he.solve('swell')\n"
        "def slow(*_a, **_k):\n"
        "    print('writing', flush=True)\n"
        "    for _ in range(600): time.sleep(0.1)\n"
        "pathlib.Path.write_text = slow\n"
        f"result.save({str(tmp_path / 'result')!r}, images=None)\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "writing\n"
        time.sleep(0.2)
        assert names(tmp_path)
        process.send_signal(number)
        assert process.wait(timeout=20) != 0
    assert list(tmp_path.iterdir()) == []
