"""A program in a root is the process that was started, as the same user, and sees what was mounted for it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

LAUNCHER = Path(__file__).resolve().parent.parent / "launcher"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


def bash(code: str, *arguments: str | Path, **variables: str) -> list[str]:
    """Run code after the functions of the launcher were read, and give the lines of its output."""
    files = 'checkout=${1%/*}; for file in messages variables enter; do source "$1/$file.sh"; done; shift; '
    ended = subprocess.run(
        ["bash", "-euc", files + code, "bash", LAUNCHER, *arguments],
        env=os.environ | variables,
        capture_output=True,
        text=True,
        check=True,
        timeout=30,
    )
    return ended.stdout.splitlines()


@pytest.fixture
def inside(tmp_path):
    """Run shell code in a root with the programs of this system, in the host's folder `seen`, beside `told`."""
    if bash('find_entry || entry=none; echo "$entry"') != ["unshare"]:
        pytest.skip("this system refuses namespaces")
    root, seen, told = tmp_path / "a root", tmp_path / "seen", tmp_path / "told"
    binds = [folder for folder in ("/usr", "/proc", "/dev", "/bin", "/lib", "/lib64") if Path(folder).is_dir()]
    for folder in (*binds, str(seen)):
        (root / folder[1:]).mkdir(parents=True)
    (root / str(told)[1:]).touch()
    seen.mkdir()
    told.write_text("by the host\n")
    command = (
        'find_entry; root=$1 folder=$2 binds_read_only=("$3") code=$4; binds=("$2" "${@:5}"); '
        'command_by_unshare sh -c "$code"; echo $$; exec "${command[@]}"'
    )
    return lambda code: bash(command, root, seen, told, code, *binds)


def test_program_is_the_process_that_was_started(inside):
    started, program = inside("echo $$")
    assert program == started


def test_user_and_folder_stay(tmp_path, inside):
    assert inside("id -u; id -g; pwd")[1:] == [str(os.getuid()), str(os.getgid()), str(tmp_path / "seen")]


def test_folders_of_the_host_are_those_that_were_named(tmp_path, inside):
    assert inside(f"cat {tmp_path}/told; touch new; ls {tmp_path}; ls -A {tmp_path}/seen")[1:] == [
        *("by the host", "seen", "told", "new"),
    ]
    assert (tmp_path / "seen" / "new").exists()


def test_root_cannot_be_written_by_accident(tmp_path, inside):
    said = inside(f"touch /new 2>/dev/null || echo refused; (echo >{tmp_path}/told) 2>/dev/null || echo refused")
    if os.getuid() == 0:
        assert said[1:] == ["refused", "refused"]
        assert (tmp_path / "told").read_text() == "by the host\n"


def test_cache_and_home_are_bound_wherever_they_are(tmp_path):
    # Without patterns no folder at the root of the file system is found, as if they were in a hidden one.
    (tmp_path / "home").mkdir()
    (tmp_path / "cache").mkdir()
    code = 'set -f; cache=$1; list_binds; printf "%s\\n" "${binds[@]}"'
    binds = bash(code, tmp_path / "cache", HOME=str(tmp_path / "home"), TMPDIR="/")
    assert {str(tmp_path / "home"), str(tmp_path / "cache"), str(LAUNCHER.parent)} <= set(binds)
    assert "/" not in binds


@pytest.mark.parametrize(("path", "bound"), [("/data", True), ("/data/cache", True), ("/data2", False), ("/.x", False)])
def test_what_lies_below_a_bound_folder_is_bound(path, bound):
    assert bash('binds=(/dev /data); if is_bound "$1"; then echo True; else echo False; fi', path) == [str(bound)]
