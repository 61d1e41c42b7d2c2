"""Result folders: whole or not at all, and never over what no run has written."""

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

from hydroelastic.output import exchange as exchange_module
from hydroelastic.output import folder as output
from hydroelastic.output.folder import FolderError, check_output, result_folder, results_message

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


@pytest.fixture(params=["one step", "two steps"])
def steps(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """How folders exchange their names: in one step, or in two where the file system has no such thing."""
    if request.param == "two steps":
        monkeypatch.setattr(exchange_module.sys, "platform", "another system")
    return str(request.param)


@pytest.mark.usefixtures("steps")
def test_a_previous_result_is_replaced_as_a_whole(tmp_path: Path) -> None:
    target = tmp_path / "result"
    with result_folder(target) as folder:
        (folder / "fields").mkdir()
        (folder / "fields" / "old.vtu").touch()
    write_result(target, "newer")
    assert (target / "modes.csv").read_text(encoding="utf-8") == "newer"
    assert not (target / "fields").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


@pytest.mark.usefixtures("steps")
def test_what_no_run_has_written_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "result"
    write_result(target)
    (target / "mine.toml").write_text("the scene", encoding="utf-8")
    (target / "mine").mkdir()
    (target / "mine" / "notes.md").write_text("notes", encoding="utf-8")
    (target / "mine" / "link").symlink_to("nowhere")
    (target / "folder").symlink_to("mine")
    inode = (target / "mine.toml").stat().st_ino
    for _ in range(2):
        write_result(target, "newer")
        assert (target / "modes.csv").read_text(encoding="utf-8") == "newer"
        assert (target / "mine" / "notes.md").read_text(encoding="utf-8") == "notes"
        assert (target / "mine" / "link").is_symlink()
        assert (target / "folder").is_symlink()
        # The same file: an editor that has it open goes on with it.
        assert (target / "mine.toml").stat().st_ino == inode
        assert results_message(target, replaces=True).endswith(
            "(replacing earlier ones, keeping folder, mine.toml, mine/link and 1 more)"
        )
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_results_that_were_changed_are_kept_under_another_name(tmp_path: Path) -> None:
    target = tmp_path / "result"
    write_result(target)
    for text in ("first remark", "second remark"):
        (target / "modes.csv").write_text(text, encoding="utf-8")
        write_result(target, "newer")
    assert (target / "modes.csv").read_text(encoding="utf-8") == "newer"
    assert (target / "modes.csv.kept").read_text(encoding="utf-8") == "first remark"
    assert (target / "modes.csv.kept.kept").read_text(encoding="utf-8") == "second remark"


def test_a_file_of_the_user_is_kept_where_the_new_results_have_one_of_that_name(tmp_path: Path) -> None:
    target = tmp_path / "result"
    write_result(target)
    with result_folder(target) as folder:
        (folder / "response.csv").write_text("results", encoding="utf-8")
        (target / "response.csv").write_text("mine", encoding="utf-8")
    assert (target / "response.csv").read_text(encoding="utf-8") == "results"
    assert (target / "response.csv.kept").read_text(encoding="utf-8") == "mine"


def test_files_are_copied_where_they_cannot_have_two_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def no_links(*_arguments: object, **_settings: object) -> None:
        raise OSError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "link", no_links)
    target = tmp_path / "result"
    write_result(target)
    (target / "notes.md").write_text("notes", encoding="utf-8")
    write_result(target)
    assert (target / "notes.md").read_text(encoding="utf-8") == "notes"


def test_what_appears_amid_the_exchange_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "result"
    write_result(target)
    exchange = exchange_module.exchange

    def late(new: Path, old: Path) -> None:
        (old / "late.md").touch()
        exchange(new, old)

    monkeypatch.setattr(output, "exchange", late)
    write_result(target)
    assert (target / "late.md").exists()


def test_the_list_of_files_names_the_scene_relative_to_the_folder(tmp_path: Path) -> None:
    scene = tmp_path / "scenes" / "tank.toml"
    with result_folder(tmp_path / "results" / "tank", scene_file=scene):
        pass
    tmp_path.rename(tmp_path.with_name("moved"))
    moved = tmp_path.with_name("moved")
    listed = check_output(moved / "results" / "tank")
    assert listed is not None
    assert listed.scene_file(moved / "results" / "tank") == moved / "scenes" / "tank.toml"


def leave_remains(target: Path, ending: str) -> Path:
    remains = target.with_name(f".{target.name}.0a1b2c3d{ending}")
    write_result(remains)
    return remains


@pytest.mark.parametrize("ending", [".partial", ".previous"])
def test_what_killed_runs_have_left_is_removed(tmp_path: Path, ending: str) -> None:
    target = tmp_path / "result"
    write_result(target)
    remains = leave_remains(target, ending)
    others = leave_remains(tmp_path / "result.2", ending)
    check_output(target)
    assert not remains.exists()
    assert others.exists()


def test_a_run_that_was_killed_amid_the_exchange_gives_its_old_results_back(tmp_path: Path) -> None:
    target = tmp_path / "result"
    leave_remains(target, ".previous")
    check_output(target)
    assert (target / "modes.csv").read_text(encoding="utf-8") == "new"
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_what_another_run_is_writing_is_left_alone(tmp_path: Path) -> None:
    target = tmp_path / "result"
    with result_folder(target) as folder:
        program = f"from hydroelastic.output.folder import check_output; check_output({str(target)!r})"
        subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
        assert folder.exists()


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
    with pytest.raises(FolderError, match="No space left"), result_folder(tmp_path / "result"):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert list(tmp_path.iterdir()) == []


def test_errors_that_are_not_about_the_folder_stay_what_they_are(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError), result_folder(tmp_path / "result"):
        Path("/nowhere/at/all").read_text(encoding="utf-8")


def test_a_failed_move_keeps_the_previous_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exchange_module.sys, "platform", "another system")
    target = tmp_path / "result"
    write_result(target)
    rename = Path.rename

    def rename_that_fails_to_move_in(self: Path, to: Path) -> Path:
        if self.name.endswith(".partial"):
            raise OSError(errno.EIO, os.strerror(errno.EIO), str(self))
        return rename(self, to)

    monkeypatch.setattr(Path, "rename", rename_that_fails_to_move_in)
    with pytest.raises(FolderError):
        write_result(target, "newer")
    assert [path.name for path in tmp_path.iterdir()] == ["result"]
    assert (target / "modes.csv").read_text(encoding="utf-8") == "new"


FOREIGN = [None, "{}", "not JSON", "[1]", '{"scene": 1, "files": []}', '{"scene": "", "files": 1}']


@pytest.mark.parametrize("listed", FOREIGN)
def test_foreign_folders_are_refused_and_kept(tmp_path: Path, listed: str | None) -> None:
    target = tmp_path / "mine"
    target.mkdir()
    (target / "thesis.tex").touch()
    (target / "summary.json").write_text(SUMMARY, encoding="utf-8")
    if listed is not None:
        (target / "manifest.json").write_text(listed, encoding="utf-8")
    with pytest.raises(FolderError, match="not a result folder"):
        check_output(target)
    with pytest.raises(FolderError, match="not a result folder"):
        write_result(target)
    assert (target / "thesis.tex").is_file()


def test_a_folder_that_became_foreign_meanwhile_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "result"

    def write_while_another_uses_the_name() -> None:
        with result_folder(target):
            target.mkdir()
            (target / "thesis.tex").touch()

    with pytest.raises(FolderError, match="not a result folder"):
        write_while_another_uses_the_name()
    assert [path.name for path in tmp_path.iterdir()] == ["result"]


def test_places_that_cannot_be_written_are_refused_beforehand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "file"
    file.touch()
    refused = [file, file / "below", Path(), tmp_path.parent, Path("/"), Path("/proc/result"), Path("n" * 300)]
    for path in refused:
        with pytest.raises(FolderError, match="output folder"):
            check_output(path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write anywhere")
def test_a_folder_without_permission_is_refused(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(FolderError, match="Permission denied"):
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
        from hydroelastic.output.folder import result_folder
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
