"""The launcher takes the Debian mirror and its keyring from the configuration of the host's apt, in both formats."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

MIRROR = Path(__file__).resolve().parent.parent / "launcher" / "mirror.sh"
KEYRING = "/usr/share/keyrings/debian-archive-keyring.gpg"

pytestmark = pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")


def sources(folder: Path, *, system: str = "ID=debian\nVERSION_CODENAME=bookworm\n") -> list[str]:
    """Call the function of the launcher on a folder as /etc/apt and a text as /etc/os-release."""
    (folder / "os-release").write_text(system)
    ended = subprocess.run(
        ["bash", "-euc", 'source "$1"; debian_sources_of_host "$2" "$2/os-release"', "bash", MIRROR, folder],
        capture_output=True,
        text=True,
        check=True,
        timeout=30,
    )
    assert ended.stderr == ""
    return ended.stdout.splitlines()


def write(folder: Path, name: str, text: str) -> None:
    file = folder / name
    file.parent.mkdir(exist_ok=True)
    file.write_text(text)


def test_one_line_format(tmp_path):
    text = """
# deb http://commented.example/debian bookworm main
deb-src http://source.example/debian bookworm main
deb [arch=amd64 signed-by=/keys/own.gpg] http://mirror.example/debian/ bookworm main contrib
deb http://mirror.example/debian bookworm-updates main
deb http://security.example/debian-security bookworm-security main
deb http://unsigned.example/debian stable main
"""
    write(tmp_path, "sources.list", text)
    assert sources(tmp_path) == ["http://mirror.example/debian /keys/own.gpg"]


def test_deb822_format(tmp_path):
    text = f"""\
Types: deb
# a comment inside
URIs: https://mirror.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: {KEYRING}

Types: deb
URIs: http://security.example/debian-security
Suites: bookworm-security
Components: main

Enabled: no
Types: deb
URIs: http://off.example/debian
Suites: bookworm
Components: main

Types: deb deb-src
URIs: http://second.example/debian
Suites: sid sid-updates
Components: contrib
 main
Signed-By:
 -----BEGIN PGP PUBLIC KEY BLOCK-----
 .
"""
    write(tmp_path, "sources.list.d/debian.sources", text)
    assert sources(tmp_path) == [f"https://mirror.example/debian {KEYRING}", "http://second.example/debian -"]


def test_archives_of_others_and_other_schemes_are_left_out(tmp_path):
    write(tmp_path, "sources.list", "deb cdrom:[Debian]/ bookworm main\ndeb file:/srv/debian bookworm main\n")
    write(tmp_path, "sources.list.d/browser.list", "deb https://browser.example/deb stable main\n")
    write(
        tmp_path, "sources.list.d/tool.list", "deb [signed-by=/keys/tool.gpg] https://t.example/debian bookworm main\n"
    )
    write(tmp_path, "sources.list.d/containers.list", "deb https://c.example/linux/debian bookworm stable\n")
    write(tmp_path, "sources.list.d/node.sources", "Types: deb\nURIs: https://node.example\nSuites: nodistro\n")
    write(tmp_path, "sources.list.d/off.list.disabled", "deb http://off.example/debian bookworm main\n")
    assert sources(tmp_path) == []


def test_ubuntu_has_no_debian_mirror(tmp_path):
    write(tmp_path, "sources.list", "deb http://archive.example/ubuntu jammy main\n")
    assert sources(tmp_path, system="ID=ubuntu\nVERSION_CODENAME=jammy\n") == []


def test_no_sources_at_all(tmp_path):
    assert sources(tmp_path) == []


@pytest.mark.parametrize(
    ("mirror", "given"), [("", []), ("http://mirror.example/debian", ["http://mirror.example/debian"])]
)
def test_without_a_mirror_mmdebstrap_takes_its_own(tmp_path, mirror, given):
    (tmp_path / "mmdebstrap").write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" >{tmp_path}/arguments\n')
    (tmp_path / "mmdebstrap").chmod(0o755)
    code = """
        checkout=$1 building=$2/root suite=trixie mirror=$3 keyrings=()
        source "$1/launcher/names.sh"; source "$1/launcher/root.sh"
        tar() { cat; }; run_mmdebstrap
    """
    subprocess.run(
        ["bash", "-euc", code, "bash", MIRROR.parent.parent, tmp_path, mirror],
        env={"PATH": f"{tmp_path}:{os.environ['PATH']}"},
        check=True,
        timeout=30,
    )
    arguments = (tmp_path / "arguments").read_text().splitlines()
    assert arguments[arguments.index("trixie") + 2 :] == given
