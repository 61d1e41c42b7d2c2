"""Result folders: whole or not at all, and never over what is not ours."""

import errno
import json
import os
import signal
import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import pytest

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.output import folder as output
from hydroelastic.scenes.output.folder import check_output, result_folder

SUMMARY = json.dumps({"scene": {}, "status": "ok"})


def write_result(target: Path, text: str = "new") -> None:
    with result_folder(target) as folder:
        (folder / "summary.json").write_text(SUMMARY, encoding="utf-8")
        (folder / "modes.csv").write_text(text, encoding="utf-8")


def test_a_result_appears_with_the_folders_above_it(tmp_path: Path) -> None:
    target = tmp_path / "a" / "b" / "result"
    with result_folder(target) as folder:
        assert not target.exists()
        assert folder.parent == target.parent
        (folder / "summary.json").write_text(SUMMARY, encoding="utf-8")
    assert [path.name for path in target.parent.iterdir()] == ["result"]
    assert (target / "summary.json").is_file()


def test_a_previous_result_is_replaced_as_a_whole(tmp_path: Path) -> None:
    target = tmp_path / "result"
    write_result(target)
    (target / "old.csv").touch()
    write_result(target, "newer")
    assert (target / "modes.csv").read_text(encoding="utf-8") == "newer"
    assert not (target / "old.csv").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_an_empty_folder_is_filled(tmp_path: Path) -> None:
    target = tmp_path / "result"
    target.mkdir()
    write_result(target)
    assert (target / "modes.csv").is_file()


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, SystemExit])
def test_nothing_is_left_when_the_work_fails(tmp_path: Path, error: type[BaseException]) -> None:
    def fail(target: Path) -> None:
        with result_folder(target) as folder:
            (folder / "fields").mkdir()
            (folder / "fields" / "mode.vtu").touch()
            raise error

    with pytest.raises(error):
        fail(tmp_path / "made" / "deeper" / "result")
    assert list(tmp_path.iterdir()) == []

    write_result(tmp_path / "result")
    with pytest.raises(error):
        fail(tmp_path / "result")
    assert [path.name for path in tmp_path.iterdir()] == ["result"]
    assert (tmp_path / "result" / "modes.csv").read_text(encoding="utf-8") == "new"


def test_a_full_disk_is_a_scene_error(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="No space left"), result_folder(tmp_path / "result"):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert list(tmp_path.iterdir()) == []


def test_errors_that_are_not_about_the_folder_stay_what_they_are(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError), result_folder(tmp_path / "result"):
        Path("/nowhere/at/all").read_text(encoding="utf-8")


def test_a_failed_move_keeps_the_previous_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "result"
    write_result(target)
    rename = Path.rename

    def rename_that_fails_to_move_in(self: Path, to: Path) -> Path:
        if self.name.endswith(".partial"):
            raise OSError(errno.EIO, os.strerror(errno.EIO), str(self))
        return rename(self, to)

    monkeypatch.setattr(Path, "rename", rename_that_fails_to_move_in)
    with pytest.raises(SceneError):
        write_result(target, "newer")
    assert [path.name for path in tmp_path.iterdir()] == ["result"]
    assert (target / "modes.csv").read_text(encoding="utf-8") == "new"


@pytest.mark.parametrize("summary", [None, "{}", "not JSON", "[1]", '{"scene": 1}'])
def test_foreign_folders_are_refused_and_kept(tmp_path: Path, summary: str | None) -> None:
    target = tmp_path / "mine"
    target.mkdir()
    (target / "thesis.tex").touch()
    if summary is not None:
        (target / "summary.json").write_text(summary, encoding="utf-8")
    with pytest.raises(SceneError, match="not a result folder"):
        check_output(target)
    with pytest.raises(SceneError, match="not a result folder"):
        write_result(target)
    assert (target / "thesis.tex").is_file()


def test_a_folder_that_became_foreign_meanwhile_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "result"

    def write_while_another_uses_the_name() -> None:
        with result_folder(target):
            target.mkdir()
            (target / "thesis.tex").touch()

    with pytest.raises(SceneError, match="not a result folder"):
        write_while_another_uses_the_name()
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_places_that_cannot_be_written_are_refused_beforehand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "file"
    file.touch()
    refused = [file, file / "below", Path(), tmp_path.parent, Path("/"), Path("/proc/result"), Path("n" * 300)]
    for path in refused:
        with pytest.raises(SceneError, match="output folder"):
            check_output(path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write anywhere")
def test_a_folder_without_permission_is_refused(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(SceneError, match="Permission denied"):
        check_output(tmp_path / "result")


def test_looking_leaves_nothing_behind(tmp_path: Path) -> None:
    check_output(tmp_path / "a" / "b")
    assert list(tmp_path.iterdir()) == []


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    real, link = tmp_path / "real", tmp_path / "link"
    real.mkdir()
    link.symlink_to(real)
    write_result(link)
    assert link.is_symlink()
    assert (real / "modes.csv").is_file()


def test_handlers_of_the_caller_and_threads_are_respected(tmp_path: Path) -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        with result_folder(tmp_path / "one"):
            assert signal.getsignal(signal.SIGTERM) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGTERM, before)
    worker = threading.Thread(target=write_result, args=(tmp_path / "two",))
    worker.start()
    worker.join()
    assert (tmp_path / "two" / "modes.csv").is_file()
    assert signal.getsignal(signal.SIGTERM) == before


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_killed_process_cleans_up(tmp_path: Path, number: signal.Signals) -> None:
    program = f"""
        import signal, sys, time
        from hydroelastic.scenes.output.folder import result_folder
        # A shell may start background jobs with these ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        with result_folder({str(tmp_path / "result")!r}) as folder:
            (folder / "big").touch()
            print("writing", flush=True)
            # A signal between a print and one long sleep would be seen only when the sleep is over.
            for _ in range(600):
                time.sleep(0.1)
    """
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "writing\n"
        process.send_signal(number)
        assert process.wait(timeout=20) != 0
    assert list(tmp_path.iterdir()) == []


def test_the_module_knows_nothing_of_mpi() -> None:
    assert "mpi" not in " ".join(vars(output)).lower()
