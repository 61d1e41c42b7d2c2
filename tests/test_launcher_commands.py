"""The launcher ./hydro says what it can do, and ends with one clear message where it cannot.

Each test starts the script itself, with a path on which only what the test allows is found and a cache of its own:
nothing is prepared and no network is used.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parent.parent
LAUNCHER = CHECKOUT / "hydro"
# What the launcher calls before it knows which environment it has.
TOOLS = (
    "bash",
    "env",
    "dirname",
    "readlink",
    "sha256sum",
    "mkdir",
    "cat",
    "flock",
    "grep",
    "rm",
    "mktemp",
    "chmod",
    "sed",
    "find",
)

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


def start(*arguments: str, cache: Path, path: Path, launcher: Path = LAUNCHER, **variables: str):
    """Run the launcher as a user outside of it would."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("HYDROELASTIC", "PYTHON"))}
    environment |= {"PATH": str(path), "HYDROELASTIC_CACHE": str(cache), **variables}
    return subprocess.run(
        [shutil.which("bash"), launcher, *arguments], env=environment, capture_output=True, text=True, timeout=30
    )


def executable(file: Path, text: str) -> None:
    file.write_text(text)
    file.chmod(0o755)


@pytest.fixture
def tools(tmp_path):
    """A folder with the basic tools: no Python, no apt-get."""
    folder = tmp_path / "tools"
    folder.mkdir()
    for name in TOOLS:
        found = shutil.which(name)
        assert found is not None, name
        (folder / name).symlink_to(found)
    return folder


@pytest.fixture
def prepared(tmp_path):
    """Stand for a prepared environment: a virtual environment whose Python tells its arguments and variables."""
    folder = tmp_path / "prepared venv"
    (folder / "bin").mkdir(parents=True)
    executable(
        folder / "bin" / "python",
        '#!/bin/sh\nprintf "%s\\n" "$@"\necho '
        '"threads=$OMP_NUM_THREADS bytecode=${PYTHONDONTWRITEBYTECODE-kept} path=$PYTHONPATH"\nexit 7\n',
    )
    return folder


@pytest.mark.parametrize("arguments", [(), ("--help",), ("-h",), ("help",)])
def test_help_lists_the_commands_and_prepares_nothing(arguments, tools, tmp_path):
    ended = start(*arguments, cache=tmp_path / "cache", path=tools)
    assert ended.returncode == 0
    assert ended.stderr == ""
    for command in (
        "run",
        "compare",
        "check",
        "list",
        "study",
        "bench",
        "test",
        "lint",
        "docs",
        "python",
        "mpirun",
        "exec",
        "shell",
        "env",
    ):
        assert f"\n  {command} " in ended.stdout
    assert not (tmp_path / "cache").exists()


@pytest.mark.parametrize("flag", ["--help", "-h"])
@pytest.mark.parametrize("command", ["test", "lint", "docs", "env", "exec", "shell"])
def test_own_commands_have_help_that_prepares_nothing(command, flag, tools, tmp_path):
    ended = start(command, flag, cache=tmp_path / "cache", path=tools)
    assert ended.returncode == 0
    assert ended.stderr == ""
    assert ended.stdout.startswith(f"usage: ./hydro {command}")
    assert not (tmp_path / "cache").exists()


@pytest.mark.parametrize("arguments", [("exec", "python", "--help"), ("python", "-h"), ("exec", "python", "-h")])
def test_help_of_a_program_is_its_own(inside, arguments):
    ended = inside(*arguments)
    assert ended.stdout.splitlines()[0] == arguments[-1]
    assert ended.returncode == 7


@pytest.mark.parametrize("command", ["env", "lint"])
def test_commands_without_arguments_refuse_some(inside, command):
    ended = inside(command, "--all")
    assert ended.returncode == 2
    assert ended.stderr == f"hydro: {command} takes no arguments, and was given --all\n"
    assert ended.stdout == ""


@pytest.mark.parametrize("output", [">/dev/full", ">&-"])
@pytest.mark.parametrize("command", ["help", "docs --help", "env"])
def test_output_that_cannot_be_written_is_one_message(tools, tmp_path, prepared, command, output):
    # Here `env` needs no versions, only a Python that ends well.
    executable(prepared / "bin" / "python", "#!/bin/sh\n")
    for name in ("head", "ln", "mv", "du", "cut"):
        (tools / name).symlink_to(shutil.which(name))
    variables = {"PATH": str(tools), "HYDROELASTIC_CACHE": str(tmp_path / "cache")}
    ended = subprocess.run(
        ["bash", "-c", f'"$0" {command} {output}', LAUNCHER],
        env=os.environ | variables | {"HYDROELASTIC_INSIDE": str(prepared)},
        capture_output=True,
        text=True,
        timeout=30,
    )
    assert ended.returncode == 2
    assert ended.stderr == "hydro: the standard output cannot be written\n"


def test_without_dolfinx_and_apt_the_three_ways_are_told(tools, tmp_path):
    ended = start("list", cache=tmp_path / "cache", path=tools)
    assert ended.returncode == 2
    assert ended.stdout == ""
    for way in ("conda env create", "docker build", "apt-get install", "there is no Python on the path"):
        assert way in ended.stderr
    assert not (tmp_path / "cache").exists()


def test_python_without_dolfinx_is_named(tools, tmp_path):
    executable(tools / "python3", "#!/bin/sh\necho lacks dolfinx slepc4py\n")
    ended = start("list", cache=tmp_path / "cache", path=tools)
    assert ended.returncode == 2
    assert f"{tools / 'python3'} lacks dolfinx slepc4py" in ended.stderr


def test_broken_python_is_no_crash_of_the_launcher(tools, tmp_path):
    executable(tools / "python3", "#!/bin/sh\nexit 9\n")
    ended = start("list", cache=tmp_path / "cache", path=tools)
    assert ended.returncode == 2
    assert "does not start" in ended.stderr


def test_suite_that_is_no_name_is_refused(tools, tmp_path):
    ended = start("list", cache=tmp_path / "cache", path=tools, HYDROELASTIC_SUITE="../sid")
    assert ended.returncode == 2
    assert ended.stderr.count("hydro:") == 1
    assert "HYDROELASTIC_SUITE" in ended.stderr


def test_cache_that_cannot_be_made_is_told(tools, tmp_path, prepared):
    (tmp_path / "file").write_text("")
    ended = start("list", cache=tmp_path / "file" / "cache", path=tools, HYDROELASTIC_INSIDE=str(prepared))
    assert ended.returncode == 2
    assert ended.stderr.count("hydro:") == 1
    assert "cannot write to the cache" in ended.stderr


@pytest.fixture
def inside(tools, tmp_path, prepared):
    """Start the launcher as if it ran inside the prepared environment."""
    for name in ("head", "ln", "mv"):
        (tools / name).symlink_to(shutil.which(name))

    def run(*arguments: str, **variables: str):
        return start(
            *arguments, cache=tmp_path / "the cache", path=tools, HYDROELASTIC_INSIDE=str(prepared), **variables
        )

    return run


def test_other_words_go_to_the_command_line_unchanged(inside):
    ended = inside("run", "my scene.toml", "--set", "tank.length=12", "", "*")
    assert ended.stdout.splitlines()[:-1] == [
        *("-m", "hydroelastic.scenes"),
        *("run", "my scene.toml", "--set", "tank.length=12", "", "*"),
    ]


def test_exit_code_is_that_of_the_program(inside):
    assert inside("list").returncode == 7
    assert inside("python", "-c", "pass").returncode == 7
    assert inside("exec", "bash", "-c", "exit 3").returncode == 3


def test_python_gets_its_arguments_unchanged(inside):
    assert inside("python", "-c", "print('a b')").stdout.splitlines()[:-1] == ["-c", "print('a b')"]


def test_docs_are_built_where_the_user_says(inside, tmp_path):
    ended = inside("docs", "--out", str(tmp_path / "my site"))
    arguments = ended.stdout.splitlines()
    assert arguments[:2] == ["-m", "sphinx"]
    assert {"--fail-on-warning", "--keep-going"} <= set(arguments)
    assert arguments[-3:-1] == [str(CHECKOUT), str(tmp_path / "my site")]
    assert ended.returncode == 7


def test_docs_go_to_the_cache_otherwise(inside, tmp_path):
    folder = inside("docs", XDG_CACHE_HOME=str(tmp_path / "forms")).stdout.splitlines()[-2]
    assert Path(folder).is_relative_to(tmp_path / "forms" / "docs")


def test_docs_replace_nothing_else(inside, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter").write_text("")
    ended = inside("docs", f"--out={tmp_path / 'mine'}")
    assert ended.returncode == 2
    assert "holds something else" in ended.stderr
    assert ended.stdout == ""


@pytest.mark.parametrize(("arguments", "said"), [(("--out",), "--out needs a folder"), (("html",), "was given html")])
def test_docs_refuse_other_arguments(inside, arguments, said):
    ended = inside("docs", *arguments)
    assert ended.returncode == 2
    assert said in ended.stderr


def test_exec_needs_a_program(inside):
    ended = inside("exec")
    assert ended.returncode == 2
    assert "exec needs a program" in ended.stderr


def test_one_thread_unless_told_otherwise(inside):
    assert "threads=1 " in inside("python", OMP_NUM_THREADS="").stdout
    assert "threads=4 " in inside("python", OMP_NUM_THREADS="4").stdout


def test_bytecode_is_kept_in_the_cache(inside):
    assert "bytecode=kept " in inside("python", PYTHONDONTWRITEBYTECODE="1").stdout


def test_prepared_start_is_silent(inside):
    inside("list")
    assert inside("list").stderr == ""


def test_stale_unfinished_folders_are_removed(inside, tmp_path):
    inside("list")
    stale = tmp_path / "the cache" / "building.abc123"
    stale.mkdir()
    (stale / "half").write_text("")
    inside("list")
    assert not stale.exists()


def test_link_to_the_launcher_finds_the_checkout(tools, tmp_path):
    link = tmp_path / "linked hydro"
    link.symlink_to(LAUNCHER)
    ended = start("list", cache=tmp_path / "cache", path=tools, launcher=link)
    assert f"{CHECKOUT}/environment.yml" in ended.stderr
