"""The launcher ./hydro says what it can do, starts programs unchanged, and ends with one clear message where it cannot.

Each test starts the script itself, as if inside an environment whose Python tells its arguments: nothing is prepared
and no network is used.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

CHECKOUT = Path(__file__).resolve().parent.parent
REQUIREMENTS = CHECKOUT / "requirements"
WORKFLOW = CHECKOUT / ".github" / "workflows" / "checks.yml"
COMMANDS = re.findall(r"\w+", "run compare check list study sweep schema bench test lint docs python mpirun exec env")
# Of Debian in a private root; `lock.py` finds the same.
BROUGHT_BY_DEBIAN = {"fenics-dolfinx", "mpi4py", "petsc4py", "slepc4py", "gmsh", "numpy", "scipy", "h5py"}

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


@pytest.fixture
def environment(tmp_path):
    """Variables of a start inside an environment; its programs tell their arguments and end as RETURNS says."""
    (tmp_path / "venv" / "bin").mkdir(parents=True)
    telling = '#!/bin/sh\nprintf "%s\\n" "$@"\necho "threads=$OMP_NUM_THREADS path=$PYTHONPATH"\nexit ${RETURNS:-7}\n'
    # -n 2 sh SCRIPT FOLDER, then what goes to pytest.
    ranks = '#!/bin/sh\nfolder=$5; shift 5\necho "mpi: $*"\necho said by rank 1 >$folder/output\n'
    ranks += "echo ${RANK_0:-0} >$folder/status-0\necho ${RANK_1:-0} >$folder/status-1\n"
    for name, text in {"python": telling, "mpirun": ranks, "timeout": '#!/bin/sh\nshift 2\nexec "$@"\n'}.items():
        (tmp_path / "venv" / "bin" / name).write_text(text)
        (tmp_path / "venv" / "bin" / name).chmod(0o755)
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("HYDROELASTIC", "PYTHON"))}
    named = {"HYDROELASTIC_CACHE": "the cache", "HYDROELASTIC_INSIDE": "venv", "XDG_CACHE_HOME": "forms"}
    return clean | {name: str(tmp_path / folder) for name, folder in named.items()}


@pytest.fixture
def start(environment, tmp_path):
    def run(*arguments: str, checkout: Path = CHECKOUT, **variables: str) -> subprocess.CompletedProcess[str]:
        command = [shutil.which("bash"), checkout / "hydro", *arguments]
        given = environment | variables
        return subprocess.run(command, env=given, cwd=tmp_path, capture_output=True, text=True, timeout=60)

    return run


@pytest.mark.parametrize("arguments", [(), ("--help",), ("help",), ("test", "--help"), ("docs", "-h")])
def test_help_lists_the_commands_and_prepares_nothing(start, tmp_path, arguments):
    ended = start(*arguments)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert all(f"\n  {command} " in ended.stdout for command in COMMANDS)
    assert not (tmp_path / "the cache").exists()


def test_other_words_go_to_the_command_line_unchanged(start):
    ended = start("run", "my scene.toml", "--set", "tank.length=12", "", "*")
    expected = ["-m", "hydroelastic.scenes", "run", "my scene.toml", "--set", "tank.length=12", "", "*"]
    assert ended.stdout.splitlines()[:-1] == expected
    assert start("python", "-c", "print('a b')").stdout.splitlines()[:-1] == ["-c", "print('a b')"]
    assert start("exec", "python", "-h").stdout.splitlines()[0] == "-h"


def test_exit_code_is_that_of_the_program(start):
    assert start("list").returncode == 7
    assert start("exec", "bash", "-c", "exit 3").returncode == 3


def test_one_thread_unless_told_otherwise_and_silence(start):
    assert "threads=1 " in start("python", OMP_NUM_THREADS="").stdout
    ended = start("python", OMP_NUM_THREADS="4")
    assert "threads=4 " in ended.stdout
    assert ended.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "variables", "said"),
    [
        (("env", "--all"), {}, "env takes no arguments, and was given --all"),
        (("lint", "--all"), {}, "lint takes no arguments, and was given --all"),
        (("docs", "--out"), {}, "--out needs a folder"),
        (("docs", "html"), {}, "was given html"),
        (("docs", "--out", str(CHECKOUT / "docs")), {}, "holds something else"),
        (("exec",), {}, "exec needs a program"),
        (("list",), {"HYDROELASTIC_SUITE": "../sid"}, "HYDROELASTIC_SUITE"),
        (("list",), {"HYDROELASTIC_CACHE": "/dev/null/cache"}, "the cache /dev/null/cache"),
        (("list",), {"HYDROELASTIC_CACHE": "/usr"}, "the cache cannot be /usr; set HYDROELASTIC_CACHE"),
        (("list",), {"HYDROELASTIC_CACHE": "/tmp/a:b"}, "without a colon"),
        (("list",), {"HYDROELASTIC_CACHE": "", "XDG_CACHE_HOME": "", "HOME": "/"}, "and '/' is none"),
    ],
)
def test_what_cannot_be_is_one_message(start, arguments, variables, said):
    ended = start(*arguments, **variables)
    assert ended.returncode == 2
    assert ended.stdout == ""
    assert ended.stderr.count("hydro: ") == 1
    assert said in ended.stderr


def test_without_dolfinx_and_apt_the_three_ways_are_told(start, tmp_path):
    for name in ("bash", "env", "dirname", "readlink", "sed", "paste"):
        (tmp_path / name).symlink_to(shutil.which(name))
    ended = start("list", PATH=str(tmp_path), HYDROELASTIC_INSIDE="")
    assert ended.returncode == 2
    for way in ("conda env create", "docker build", "apt-get install", "there is no Python on the path"):
        assert way in ended.stderr
    (tmp_path / "python3").write_text("#!/bin/sh\necho lacks dolfinx slepc4py\n")
    (tmp_path / "python3").chmod(0o755)
    assert "lacks dolfinx slepc4py" in start("list", PATH=str(tmp_path), HYDROELASTIC_INSIDE="").stderr


def test_checkout_is_a_package_without_being_written_into(start, environment, tmp_path):
    checkout = tmp_path / "a checkout"
    for name in ("launcher", "requirements"):
        shutil.copytree(CHECKOUT / name, checkout / name)
    for name in ("hydro", "pyproject.toml"):
        shutil.copy(CHECKOUT / name, checkout)
    for name in ("api", "physics", "meshes", "fem", "modal", "output", "scenes", "benchmarks"):
        (checkout / name).mkdir()
        (checkout / name / "__init__.py").write_text(f"name = {name!r}\n")
    # A link would make Python look for its packages beside the link.
    (tmp_path / "venv" / "bin" / "python").write_text(f'#!/bin/sh\nexec {sys.executable} -S "$@"\n')
    before = sorted(checkout.rglob("*"))
    code = (
        "import hydroelastic; from hydroelastic import fem; from importlib.metadata import distribution as d; "
        "h = d('hydroelastic'); print(hydroelastic.name, fem.name, h.version, *(e.value for e in h.entry_points))"
    )
    ended = start("python", "-c", code, checkout=checkout)
    version = re.search(r'\nversion = "(.*)"\n', (checkout / "pyproject.toml").read_text())[1]
    assert ended.stdout.split() == ["api", "fem", version, "hydroelastic.scenes.__main__:start"]
    assert sorted(checkout.rglob("*")) == before


# ./hydro test


def test_everything_then_the_marked_tests_on_two_ranks(start):
    serial, parallel = start("test", "-q", "--junitxml=report.xml", RETURNS="0").stdout.split("mpi: ")
    assert serial.splitlines()[:2] == ["-m", "pytest"]
    assert {"-q", "--junitxml=report.xml", "loadfile"} <= set(serial.splitlines())
    assert " -q -m mpi and (not slow) tests/test_" in parallel
    assert "report.xml" not in parallel
    assert " -m mpi tests/test_" in start("test", "--all", RETURNS="0").stdout
    assert " -m mpi and (slow) " in start("test", "-m", "slow", RETURNS="0").stdout


@pytest.mark.parametrize("arguments", [("tests/test_launcher.py",), ("-k", "some"), ("--collect-only",)])
def test_selection_runs_once(start, arguments):
    assert "mpi: " not in start("test", *arguments, RETURNS="0").stdout


def test_paths_of_the_current_folder_are_understood(start, tmp_path):
    (tmp_path / "test_some.py").touch()
    assert f"{tmp_path}/test_some.py::test_one" in start("test", "test_some.py::test_one").stdout.splitlines()


@pytest.mark.parametrize(
    ("serial", "ranks", "code"),
    [("1", "00", 1), ("0", "10", 1), ("0", "02", 2), ("3", "10", 3), ("0", "55", 0), ("0", "00", 0)],
)
def test_fails_if_either_run_fails(start, serial, ranks, code):
    ended = start("test", RETURNS=serial, RANK_0=ranks[0], RANK_1=ranks[1])
    assert ended.returncode == code
    assert ("said by rank 1" in ended.stderr) == any(rank not in "05" for rank in ranks)


# Signals


@pytest.mark.parametrize("arguments", [("run", "aquarium"), ("exec", "python"), ("mpirun", "-n", "2"), ("test",)])
@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGKILL])
def test_program_ends_with_the_launcher(environment, tmp_path, arguments, sent):
    for name in ("python", "mpirun"):
        (tmp_path / "venv" / "bin" / name).write_text(
            f"#!/bin/bash\necho $$ >{tmp_path}/new && mv {tmp_path}/new {tmp_path}/number\n"
            "while true; do sleep 0.05; done\n"
        )
    process = subprocess.Popen(
        [CHECKOUT / "hydro", *arguments], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    # The limits are for a machine under load, an idle one needs milliseconds.
    wait_until((tmp_path / "number").exists)
    program = int((tmp_path / "number").read_text())
    process.send_signal(sent)
    process.wait(30)
    wait_until(lambda: not runs(program))


def wait_until(condition, seconds: float = 30.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def runs(number: int) -> bool:
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


# The lock of packages and the hosted checks


def test_lock_has_one_version_with_hashes_of_each_package_within_the_ranges():
    text = (REQUIREMENTS / "lock.txt").read_text().replace("\\\n", " ")
    assert not re.search(r"://|--(extra-)?index-url|--find-links|^-[if]", text, re.MULTILINE)
    versions = {}
    for entry in (line for line in text.splitlines() if line and not line.startswith("#")):
        name, *hashes = re.split(r"\s+--hash=", entry)
        assert hashes, entry
        assert all(re.fullmatch(r"sha256:[0-9a-f]{64}", value.strip()) for value in hashes), entry
        entry_requirement = Requirement(name)
        versions[canonicalize_name(entry_requirement.name)] = str(entry_requirement.specifier).removeprefix("==")
    lines = [line for file in ("run", "dev") for line in (REQUIREMENTS / f"{file}.txt").read_text().splitlines()]
    for requirement in (Requirement(line.split("#")[0]) for line in lines if line.split("#")[0].strip()):
        project = canonicalize_name(requirement.name)
        if project in BROUGHT_BY_DEBIAN:
            assert project not in versions
        else:
            assert requirement.specifier.contains(versions[project]), f"{requirement}: run requirements/lock.py"


def test_hosted_checks_run_on_both_suites_and_name_what_there_is():
    jobs = yaml.safe_load(WORKFLOW.read_text())["jobs"]
    assert set(jobs["suite"]["strategy"]["matrix"]["suite"]) == {"trixie", "sid"}
    assert {"run": ".ci/run"} in jobs["suite"]["steps"]
    for command in (step.get("run", "") for job in jobs.values() for step in job["steps"]):
        for word in command.split():
            if word.startswith(("./", ".ci/")) or word.endswith(".yml"):
                assert (CHECKOUT / word).exists(), command
        assert all((CHECKOUT / f"scenes/{scene}.toml").exists() for scene in re.findall(r"hydro run (\w+)", command))
