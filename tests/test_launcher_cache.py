"""A cache that cannot work is refused before anything is written, and a damaged one is made anew with one line."""

import os
import pwd
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parent.parent

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


def start(*, venv: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run `true` by the launcher as if inside an environment, with these variables in place of the user's."""
    left_out = ("HYDROELASTIC", "XDG_CACHE_HOME", "HOME")
    environment = {name: value for name, value in os.environ.items() if not name.startswith(left_out)}
    environment |= {"HYDROELASTIC_INSIDE": str(venv), **variables}
    return subprocess.run(
        [CHECKOUT / "hydro", "exec", "true"], env=environment, capture_output=True, text=True, timeout=30
    )


@pytest.mark.parametrize("home", ["/", "//", "/no/such/home"])
def test_home_that_is_none_is_refused(tmp_path, home):
    ended = start(venv=tmp_path, HOME=home)
    assert ended.returncode == 2
    assert ended.stderr.startswith(f"hydro: the cache would be in the home folder, and '{home}' is none")
    assert "HYDROELASTIC_CACHE" in ended.stderr
    assert not Path("/no").exists()


def test_home_that_is_none_is_no_matter_where_the_cache_is_named(tmp_path):
    assert start(venv=tmp_path, HOME="/", HYDROELASTIC_CACHE=str(tmp_path / "cache")).returncode == 0
    assert start(venv=tmp_path, HOME="/no/such/home", XDG_CACHE_HOME=str(tmp_path / "caches")).returncode == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cache", "caches"]


def test_unset_home_is_that_of_the_user(tmp_path):
    code = 'source "$1/launcher/messages.sh"; source "$1/launcher/names.sh"; choose_cache; echo "$HOME"; echo "$cache"'
    ended = subprocess.run(
        ["bash", "-euc", code, "bash", CHECKOUT],
        env={"PATH": os.environ["PATH"]},
        capture_output=True,
        text=True,
        check=True,
        timeout=30,
    )
    home = pwd.getpwuid(os.getuid()).pw_dir
    assert ended.stdout.splitlines() == [home, f"{os.path.realpath(home)}/.cache/hydroelastic"]


@pytest.mark.parametrize("cache", ["/", "/usr", "/proc/cache", "/tmp/a:b", "/etc/../etc"])
def test_cache_that_cannot_work_is_refused(tmp_path, cache):
    ended = start(venv=tmp_path, HOME=str(tmp_path), HYDROELASTIC_CACHE=cache)
    assert ended.returncode == 2
    assert ended.stderr.startswith(f"hydro: the cache cannot be {os.path.realpath(cache)}; set HYDROELASTIC_CACHE")
    assert ended.stderr.count("\n") == 1
    assert not Path("/tmp/a:b").exists()


def empty(overlay: Path) -> None:
    for path in overlay.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def halve(overlay: Path) -> None:
    (overlay / "hydroelastic" / "fem").unlink()


def truncate(overlay: Path) -> None:
    next(overlay.glob("*.dist-info/METADATA")).write_text("")


def test_damaged_links_to_the_checkout_are_made_anew(tmp_path):
    def again() -> subprocess.CompletedProcess[str]:
        return start(venv=tmp_path, HYDROELASTIC_CACHE=str(tmp_path / "cache"))

    assert again().stderr == ""
    [overlay] = (tmp_path / "cache" / "checkouts").iterdir()
    whole = sorted(overlay.rglob("*"))
    for damage in (empty, halve, truncate):
        damage(overlay)
        ended = again()
        assert ended.stderr == f"hydro: {overlay} is damaged and made anew\n"
        assert ended.returncode == 0
        assert sorted(overlay.rglob("*")) == whole
        assert again().stderr == ""
    assert not list((tmp_path / "cache").glob("building.*"))


def is_whole(function: str, folder: Path) -> bool:
    code = f'source "$1/launcher/names.sh"; root=$2; if {function} "$2"; then echo yes; fi'
    ended = subprocess.run(["bash", "-euc", code, "bash", CHECKOUT, folder], capture_output=True, text=True, check=True)
    return ended.stdout == "yes\n"


def test_environment_without_its_python_is_not_whole(tmp_path):
    code = (
        'source "$1/launcher/names.sh"; source "$1/launcher/cache.sh"; building=$2; cache=$2; '
        'list_contents -path "./bin/*"'
    )
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python").symlink_to("/seen/from/within/a/root/only")
    subprocess.run(["bash", "-euc", code, "bash", CHECKOUT, tmp_path], check=True)
    assert is_whole("is_whole", tmp_path)
    (tmp_path / "bin" / "python").unlink()
    assert not is_whole("is_whole", tmp_path)
    assert not is_whole("is_whole", tmp_path / "nothing")


def test_root_without_its_essentials_is_not_whole(tmp_path):
    files = ["etc/hosts", "var/lib/dpkg/status", "usr/lib/any/libc.so.6"]
    files += [f"usr/bin/{name}" for name in ("env", "gcc", "mpirun", "python3")]
    folders = ["dev", "proc", "sys", "var/tmp", "usr/include", "usr/share", "usr/lib/petscdir"]
    folders += [f"usr/lib/python3/dist-packages/{name}" for name in ("h5py", "numpy", "scipy")]
    for name in folders:
        (tmp_path / name).mkdir(parents=True)
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert is_whole("is_whole_root", tmp_path)
    for name in (*files, *folders):
        (tmp_path / name).rename(tmp_path / "aside")
        assert not is_whole("is_whole_root", tmp_path), name
        (tmp_path / "aside").rename(tmp_path / name)
