"""The command line: bad input is one clear message and exit code 2, and nothing heavy is loaded for it."""

import json
import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from command import assert_refused, run_command, run_process
from scene_files import BEAM_IN_TANK

SPACE = {"vtk", "vtkmodules", "pyvista"}
DRAWING = SPACE | {"matplotlib", "PIL"}
# What reads datasets; they are written without.
READING = {"xarray", "pandas"}
HEAVY = (
    DRAWING
    | READING
    | {
        "dolfinx",
        "ufl",
        "basix",
        "ffcx",
        "gmsh",
        "petsc4py",
        "slepc4py",
        "mpi4py",
        "meshio",
    }
)
SCENES = Path(__file__).parent.parent / "scenes"
COARSE = ("--set", "accuracy.modes=1", "--set", "accuracy.tolerance=1e-3")

GOOD = BEAM_IN_TANK + "[accuracy]\ntolerance = 1e-6\nmodes = 10\n"
AFTER_GOOD = f"line {len(GOOD.splitlines()) + 1}"
SECOND_BEAM = "[[body]]\nstart = 6.0\nlength = 2.0\nflexural_rigidity = 5e3\nmass_per_length = 50.0\n"
DENSER_LIQUID = "[[liquid]]\ndensity = 1200.0\ndepth = 1.0\n"


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"):
        monkeypatch.delenv(name, raising=False)


BAD = {
    "wrong type": (GOOD.replace("length = 10.0", "length = [10.0]"), ["[tank]", '"length"', "not a number"]),
    "text for number": (GOOD.replace("length = 10.0", 'length = "10"'), ['"10"', "not a number", "without quotes"]),
    "bool for number": (GOOD.replace("length = 10.0", "length = true"), ["true", "not a number"]),
    "number for bool": (GOOD.replace("start = 3.0", "start = 3.0\nhydrostatic = 0"), ["true or false"]),
    "unknown key": (GOOD.replace("depth =", "dept ="), ['"dept"', 'Did you mean "depth"?']),
    "unknown table": (GOOD + "[solver]\n", ["[solver]", "not known"]),
    "misspelt table": (GOOD.replace("[accuracy]", "[acuracy]"), ["[acuracy]", 'Did you mean "accuracy"?']),
    "table of open water": (GOOD + '[[analysis]]\nkind = "resonance"\n', ["[[analysis]]", 'set ends = "open"']),
    "single brackets": (GOOD.replace("[[body]]", "[body]"), ["[[body]]"]),
    "misspelt choice": (GOOD.replace("length = 10.0", 'length = 10.0\ntop = "fee"'), ['Did you mean "free"?']),
    "open ends": (
        GOOD.replace("length = 10.0", 'length = 10.0\nends = "open"\ntop = "rigid"'),
        ["there are no waves", '"free"'],
    ),
    "misspelt kind": (
        GOOD.replace("start = 3.0", 'kind = "flaot"\nstart = 3.0'),
        ['"beam" or "varying_beam" or "float"', 'mean "float"?'],
    ),
    "plate for beam": (GOOD.replace("start = 3.0", 'kind = "plate"\nstart = 3.0'), ['Did you mean "beam"?']),
    "unit in a text": (
        GOOD.replace("length = 10.0", 'length = "10 m"'),
        ["not a number", "Write a number without a unit; the unit is m."],
    ),
    "bare unit": (GOOD.replace("depth = 5.0", "depth = 5.0 m"), ["not TOML", "Write a number without a unit."]),
    "decimal comma": (
        GOOD.replace("length = 10.0", "length = 10,5  # m"),
        ["not TOML", "Write a decimal point, not a comma: 10.5."],
    ),
    "other kind": (GOOD.replace('"tank"', '"drum"'), ['Allowed: "tank"']),
    "no kind": (GOOD.replace('kind = "tank"', ""), ['"kind"', "missing"]),
    "outside": (GOOD.replace("start = 3.0", "start = 7.0"), ['[[body]] number 1, key "start" = 7.0', "0 to 6 m"]),
    "overlap": (GOOD + SECOND_BEAM, ["[[body]] number 2", "[[body]] number 1", "overlaps"]),
    "upside down": (GOOD + DENSER_LIQUID, ["[[liquid]] number 2", "less than 1000"]),
    "three liquids": (GOOD + 2 * DENSER_LIQUID, ["[[liquid]]", "one liquid or two"]),
    "no liquid": (GOOD.replace("[[liquid]]\ndensity = 1000.0\ndepth = 5.0", ""), ["[[liquid]]", "missing"]),
    "zero depth": (GOOD.replace("depth = 5.0", "depth = 0"), ['"depth" = 0', "positive"]),
    "negative depth": (GOOD.replace("depth = 5.0", "depth = -5.0"), ['"depth" = -5.0', "positive"]),
    "NaN": (GOOD.replace("depth = 5.0", "depth = nan"), ["nan", "not a number"]),
    "infinity": (GOOD.replace("depth = 5.0", "depth = inf"), ["inf", "finite"]),
    "no mass": (GOOD.replace("mass_per_length = 50.0", "mass_per_length = 0.0"), ["mass_per_length"]),
    "tolerance 0": (GOOD.replace("tolerance = 1e-6", "tolerance = 0"), ["from 1e-12 to 0.1"]),
    "a million modes": (GOOD.replace("modes = 10", "modes = 1_000_000"), ["1000000", "from 1 to 200"]),
    "broken modes": (GOOD.replace("modes = 10", "modes = 10.5"), ["whole number"]),
    "nothing moves": (
        'kind = "tank"\n[tank]\nlength = 1.0\ntop = "rigid"\n[[liquid]]\ndensity = 1.0\ndepth = 1.0\n',
        ['"top"', "nothing oscillates"],
    ),
    "empty": ("", ["empty"]),
    "comments alone": ("# nothing\n", ["empty"]),
    "not TOML": (GOOD + "this is not TOML\n", ["not TOML", AFTER_GOOD]),
    "key given twice": (GOOD + "modes = 11\n", ["not TOML", "line"]),
    "deep": ("a = " + "[" * 5000, ["nested"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_scenes_give_one_clear_message(tmp_path: Path, case: str) -> None:
    text, words = BAD[case]
    # Each command in turn.
    command = ("check", "run", "compare")[list(BAD).index(case) % 3]
    Path("scene.toml").write_text(text, encoding="utf-8")
    assert_refused(run_command(command, "scene.toml"), "scene.toml", *words)
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


@pytest.mark.parametrize("command", ["check", "run"])
def test_files_that_cannot_be_read(tmp_path: Path, command: str) -> None:
    Path("folder").mkdir()
    Path("latin.toml").write_bytes(GOOD.encode() + 'title = "Länge"\n'.encode("latin-1"))
    Path("wide.toml").write_bytes(GOOD.encode("utf-16"))
    assert_refused(run_command(command, "missing.toml"), "missing.toml", "no such file")
    assert_refused(run_command(command, "aquarum"), 'Did you mean "aquarium"?')
    assert_refused(run_command(command, "latin"), 'Did you mean "latin.toml"?')
    assert_refused(run_command(command, "folder"), "it is a folder")
    assert_refused(run_command(command, "/dev/null"), "not a regular file")
    assert_refused(run_command(command, "latin.toml"), "not UTF-8", AFTER_GOOD)
    assert_refused(run_command(command, "wide.toml"), "not UTF-8")
    # Python up to 3.13 says that the name is too long, later ones that there is no such file.
    assert_refused(run_command(command, "n" * 300), "n" * 100)
    assert_refused(run_command(command, "latin.toml/scene.toml"), "no such file")
    assert {path.name for path in tmp_path.iterdir()} == {"folder", "latin.toml", "wide.toml"}


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read anything")
def test_a_file_without_permission() -> None:
    Path("scene.toml").write_text(GOOD, encoding="utf-8")
    Path("scene.toml").chmod(0)
    assert_refused(run_command("check", "scene.toml"), "Permission denied")


def test_unwritable_output_is_refused_before_solving(tmp_path: Path) -> None:
    Path("file").touch()
    Path("mine").mkdir()
    Path("mine", "thesis.tex").touch()
    assert_refused(run_command("run", "aquarium", "--out", "file"), "not a folder")
    assert_refused(run_command("run", "aquarium", "--out", "file/below"), "not a folder")
    assert_refused(run_command("run", "aquarium", "--out", "mine"), "not a result folder")
    assert_refused(run_command("run", "aquarium", "--out", "/proc/result"), "cannot be written")
    assert_refused(run_command("run", "aquarium", "--out", "."), "current folder")
    assert {path.name for path in tmp_path.iterdir()} == {"file", "mine"}


@pytest.mark.parametrize("arguments", [["chek", "aquarium"], ["check"], ["run", "aquarium", "--fast"], ["list", "x"]])
def test_usage_errors_exit_with_2(arguments: list[str]) -> None:
    result = run_command(*arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Error" in result.stderr


@pytest.mark.parametrize("command", [[], ["run"], ["compare"], ["check"], ["list"], ["bench"]])
def test_help_has_an_example(command: list[str]) -> None:
    result = run_command(*command, "--help")
    assert result.exit_code == 0
    assert "Example:\n" in result.stdout
    assert "hydroelastic " in result.stdout


@pytest.mark.slow
def test_the_program_has_the_name_that_the_launcher_says() -> None:
    for program, said in (("./hydro", {"HYDROELASTIC_PROGRAM": "./hydro"}), ("hydroelastic", {})):
        shown = run_process("run", "--help", **said).stdout
        assert shown.startswith(f"Usage: {program} run ")
        assert f"\n    {program} run aquarium" in shown
        assert f"Try '{program} run --help'" in run_process("run", **said).stderr
        assert f"`{program} list`" in run_process("check", "zzzzz", **said).stderr


def test_list_and_check_and_version_print_to_the_output() -> None:
    listed = run_command("list")
    assert listed.exit_code == 0
    assert "nearly_covered" in listed.stdout
    checked = run_command("check", "aquarium", "--set", "body.1.start=2.5")
    assert checked.exit_code == 0
    assert "2.5" in checked.stdout
    assert checked.stderr == ""
    version = run_command("--version")
    assert version.exit_code == 0
    assert version.stdout.startswith("hydroelastic")


def test_the_exit_code_tells_whether_the_tolerance_was_met() -> None:
    result = run_command("run", "sloshing", "--no-images", "--quiet", *COARSE)
    assert (result.exit_code, result.stdout) == (0, "")
    assert Path("results/sloshing/summary.json").is_file()
    # Rounding of degree 10 does not allow so much.
    missed = run_command("run", "sloshing", "--no-images", "--set", "accuracy.tolerance=1e-12", "--out", "elsewhere")
    assert missed.exit_code == 3
    summary = json.loads(Path("elsewhere/summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "unconverged"
    assert any("above the tolerance 1e-12" in reason for reason in summary["reasons"])
    for text in (missed.output, Path("elsewhere/summary.md").read_text("utf-8")):
        assert "NOT CONVERGED to the tolerance 1e-12" in text
        assert summary["reasons"][0] in " ".join(text.split())
    # The best answer is there, with honest errors.
    for row, mode in zip(summary["exact"], summary["modes"], strict=True):
        assert abs(row["difference"]) <= mode["relative_error"] < 1e-9


@pytest.mark.slow
def test_a_terminal_is_told_the_scene_and_what_is_done() -> None:
    said, written = pty.openpty()
    command = [sys.executable, "-m", "hydroelastic.scenes", "run", "swell", "--no-images"]
    ended = subprocess.run(
        command, stdout=subprocess.DEVNULL, stderr=written, env=os.environ | {"TERM": "xterm"}, check=False, timeout=60
    )
    os.close(written)
    assert ended.returncode == 0
    # A pipe has no such line.
    assert "libraries – Ship on a swell, n = 0.6 k" in os.read(said, 65536).decode("utf-8", errors="replace")
    assert run_process("run", "swell", "--no-images").stderr == ""


def test_results_that_are_replaced_are_named() -> None:
    first, second = (run_command("run", "swell", "--no-images", "--out", "mine").stdout for _ in range(2))
    assert first.endswith("Results written to mine/\n")
    assert second.endswith("Results written to mine/ (replacing earlier ones)\n")


def test_two_scenes_of_one_name_are_kept_apart(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "roll.toml").write_bytes((SCENES / "swell.toml").read_bytes())
    first, second = os.path.join("a", "roll.toml"), os.path.join("b", "roll.toml")
    assert run_command("run", first, "--no-images").exit_code == 0
    summary = Path("results/roll/summary.json")
    before = summary.stat().st_ino
    assert_refused(run_command("run", second, "--no-images"), "another scene", str(tmp_path / first), "--out")
    assert summary.stat().st_ino == before
    replaced = run_command("run", second, "--no-images", "--out", "results/roll")
    assert replaced.stderr == f"Note: the results of {tmp_path / first} in results/roll/ will be replaced.\n"
    # The scene that is there now is that of the last run.
    assert run_command("run", second, "--no-images").stderr == ""


@pytest.mark.slow_but("arguments0")
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("arguments", [["list"], ["check", "swell"], ["run", "swell", "--no-images"]])
def test_an_output_that_is_full_is_one_line(arguments: list[str]) -> None:
    command = [sys.executable, "-m", "hydroelastic.scenes", *arguments]
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60)
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert "nothing can be printed: No space left on device" in ended.stderr


@pytest.mark.slow_but("arguments[01]-*")
@pytest.mark.parametrize(
    ("arguments", "needed"),
    [
        # A check meshes the scene to say how large it is.
        (["check", "aquarium"], {"gmsh", "basix"}),
        (["list"], set()),
        (["--help"], set()),
        (["run", "--help"], set()),
        (["run", "missing.toml"], set()),
        # What solves draws only when asked, and draws sections without VTK.
        (["run", "aquarium", "--no-images", *COARSE], HEAVY - DRAWING - READING),
        (["run", "open_circle", "--no-images", "--set", "accuracy.tolerance=1e-2"], HEAVY - DRAWING - READING),
        (["compare", "aquarium", *COARSE], HEAVY - DRAWING - READING),
        (["run", "aquarium", *COARSE], HEAVY - READING - SPACE),
    ],
)
def test_nothing_heavy_is_imported_that_is_not_needed(arguments: list[str], needed: set[str]) -> None:
    program = (
        "import sys\n"
        "from hydroelastic.scenes.command_line import main\n"
        f"try: main({arguments!r})\n"
        "except SystemExit: pass\n"
        f"superfluous = {HEAVY - needed!r} & sys.modules.keys()\n"
        "sys.exit(f'imported: {superfluous}' if superfluous else 0)\n"
    )
    finished = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False, timeout=60)
    assert finished.returncode == 0, finished.stderr


@pytest.mark.slow
def test_a_tank_compiles_nothing_and_says_what_it_cost(tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    ended = run_process("run", "aquarium", "--no-images", "--out", "result", *COARSE, XDG_CACHE_HOME=str(cache))
    assert ended.returncode == 0, ended.stderr
    assert not list(cache.glob("fenics/*.c"))
    assert 0.0 < json.loads(Path("result", "summary.json").read_text(encoding="utf-8"))["seconds"] < 60.0


def test_the_real_command_keeps_streams_and_exit_codes_apart() -> None:
    bad = run_process("check", "missing.toml")
    assert (bad.returncode, bad.stdout) == (2, "")
    assert bad.stderr.count("\n") == 1
    good = run_process("check", "swell")
    assert (good.returncode, good.stderr) == (0, "")


def test_a_terminal_without_greek_letters_gets_question_marks() -> None:
    result = run_process("check", "swell", PYTHONIOENCODING="ascii", PYTHONUTF8="0")
    assert result.returncode == 0, result.stderr
    assert "?" in result.stdout


@pytest.mark.slow_but("OMPI*")
@pytest.mark.parametrize("variable", ["OMPI_COMM_WORLD_RANK", "PMI_RANK"])
def test_only_the_first_rank_prints(variable: str) -> None:
    silent = run_process("check", "missing.toml", **{variable: "1"})
    assert (silent.returncode, silent.stdout, silent.stderr) == (2, "", "")
    assert run_process("list", **{variable: "1"}).stdout == ""


def test_a_scene_comes_from_the_standard_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (SCENES / "sloshing.toml").read_text(encoding="utf-8")
    checked = run_command("check", "-", input=text)
    assert checked.exit_code == 0
    assert checked.output == run_command("check", "sloshing").output
    wrong = run_command("check", "-", "--set", "accuracy.modes=0", input=text)
    assert wrong.exit_code == 2
    assert "the standard input with --set accuracy.modes=0" in wrong.output
    empty = run_command("run", "-", input="")
    assert empty.exit_code == 2
    assert "the standard input: it is empty" in empty.output
    run = run_command("run", "-", "--no-images", "--quiet", "--set", "accuracy.modes=1", input=text)
    assert run.exit_code == 0
    assert (tmp_path / "results" / "standard_input" / "summary.json").is_file()
    assert json.loads((tmp_path / "results" / "standard_input" / "summary.json").read_text())["scene_file"] == ""


@pytest.mark.parametrize(("shell", "word"), [("bash", "complete"), ("zsh", "compdef"), ("fish", "complete")])
def test_shells_complete_commands_and_shipped_scenes(shell: str, word: str) -> None:
    source = run_command(env={"_HYDROELASTIC_COMPLETE": f"{shell}_source"}, prog_name="hydroelastic")
    assert source.exit_code == 0
    assert word in source.output
    typed = {"COMP_WORDS": "hydroelastic run aqua", "COMP_CWORD": "2", "_HYDROELASTIC_COMPLETE": "bash_complete"}
    found = run_command(env=typed, prog_name="hydroelastic")
    assert found.output.split() == ["plain,aquarium", "plain,aquarium_hydrostatic", "file,aqua"]
