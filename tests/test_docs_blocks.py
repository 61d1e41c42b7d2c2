"""Every block and command that the READMEs, CONTRIBUTING and docs/ show is run, or listed here with the reason why not.

A page is gone through as a reader would, in an empty folder with the files of the checkout beside it, block by block:

- ``toml`` is read as a scene. It is whole, or its first line is ``# added to NAME.toml``, a shipped scene. A first line
  ``# NAME.toml`` names the file in which the commands below find it. With ``from FILE`` it is that file to the letter.
- ``sh`` holds a command a line, which runs. It ends with exit code 0, or what its comment tells: ``# exit code 2``.
- ``python`` runs, in the same names as the blocks above it on the page.
- ``text`` is what the ``sh`` or ``python`` block above it prints, or parts of that; with ``from FILE`` of a file.
- ``math`` is a formula, in the notation of LaTeX, which the build of the pages reads; a block without fences, a sketch.
- braces around the language, ``{toctree}`` and the like, are directives for the build of the pages.

Commands within the text are run too; those that name a SCENE or a script of the reader's, or nothing, are read.
"""

import io
import re
import shutil
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest
from markdown_blocks import PAGES, ROOT, Block, blocks_of, inline_code_of
from shown_commands import commands_of, plain, read_command, run_shown
from shown_output import is_shown

import hydroelastic as he

SHIPPED_FOLDER = ROOT / "scenes"

MINUTES = "takes minutes; its parts have tests of their own"
OF_CI = "a step of the checks itself"
ALL_TESTS = "would run the tests within the tests"
# What is not run, and why. Its arguments are read all the same, if it is a command of the project.
NOT_RUN = {
    "./hydro test": OF_CI,
    "./hydro lint": OF_CI,
    "./hydro docs": OF_CI,
    "./hydro python docs/scene_reference.py": "writes into the checkout; a test compares what is there",
    "./hydro exec ruff format .": "changes the checkout; the lint checks the format",
    "./hydro test tests/test_modal_grammel.py": ALL_TESTS,
    "./hydro test --all": ALL_TESTS,
    "./hydro test -m slow": ALL_TESTS,
    "./hydro test --junitxml=report.xml": ALL_TESTS,
    "./hydro test --all --junitxml=report_of_all.xml": ALL_TESTS,
    "./hydro python tests/support/slowest.py report.xml report_of_all.xml": "needs the reports of all tests",
    "./hydro python tests/support/mutated_scenes.py 3000 --seed 1": MINUTES,
    "HYDROELASTIC_SUITE=sid ./hydro test": "the second lane: another Debian, from the network",
    "./hydro env": "a command of the launcher, tests/test_launcher.py",
    "./hydro mpirun -n 2 python -m hydroelastic.scenes run aquarium": (
        "MPI cannot start within MPI; tests marked mpi do it"
    ),
    "./hydro bench": MINUTES,
    "./hydro bench --problem circle": MINUTES,
    "./hydro bench --problem start": MINUTES,
    "./hydro bench --quick": MINUTES,
    "./hydro run absorber_at_sea.toml --no-images": (
        "some seconds; tests/test_fem_solids_of_revolution.py has a spectrum"
    ),
    "./hydro sweep floating_roof --vary body.1.thickness=0.02:0.05:4 --set accuracy.modes=4": (
        "some seconds; tests/test_scenes_sweep.py sweeps by the command"
    ),
    "./hydro study aquarium": "a quarter of a minute; results/regenerate.py keeps what it gives",
    "HYDROELASTIC_SUITE=trixie ./hydro python requirements/lock.py": "from the network",
    "./hydro exec python -m pip install jupyterlab": "from the network",
    "./hydro exec jupyter lab": "is not part of the environment",
    "./hydro python results/hard_cases.py": MINUTES,
    "./hydro python results/float_cases.py": MINUTES,
    "./hydro python results/level_cases.py": MINUTES,
    "./hydro python results/thread_cases.py": MINUTES,
    "./hydro python results/sweeps.py": MINUTES,
    "./hydro sweep aquarium --vary body.1.start=0:6:41 --jobs 2": "results/sweeps.py keeps what it gives",
    "./hydro python results/regenerate.py": MINUTES,
    "./hydro python results/regenerate.py aquarium swell": MINUTES,
}
# Run by a test of its own, which compares what it gives with what the page shows.
ELSEWHERE = {
    "./hydro run aquarium": "tests/test_scenes_run.py",
    "./hydro run aquarium --set tank.width=4": "tests/test_level_tanks.py",
    "./hydro run floating_roof": "tests/test_level_tanks.py",
    "./hydro run floating_roof --set body.1.thickness=0.05": "tests/test_level_tanks.py",
    "./hydro python docs/scene_reference.py": "tests/test_docs_reference.py",
    "./hydro python docs/tutorial_mesh_study.py": "tests/test_docs_tutorial.py",
    "./hydro python results/page_tables.py": "tests/test_benchmarks.py",
}
# Commands of others, which need the network or the host.
FOREIGN = {
    "sudo apt-get install": "asks for rights",
    "conda": "from the network",
    "docker": "from the network",
    "python3 tests/support/golden_corpus.py": "needs git, which the environment does not have",
    "rm -rf --one-file-system ~/.cache/hydroelastic": "removes the environment that runs this",
}
# Words that stand for what the reader has, and the names of commands.
FORM = re.compile(r"\b[A-Z]{3,}\b|my_\w+\.py|^./hydro \w+$")


def _is_foreign(command: str) -> bool:
    return any(command.startswith(start) for start in FOREIGN)


class Reader:
    """Goes through a page block by block, in the current folder."""

    def __init__(self) -> None:
        self.names: dict[str, Any] = {"__name__": "page"}
        self.printed = ""
        self.is_elsewhere = False

    def take(self, block: Block) -> None:
        """Do what a block says; an assertion fails where it is not true."""
        if block.language in ("math", "indented", "slurm") or block.language.startswith("{"):
            return
        rules = {"toml": self._scene, "sh": self._commands, "python": self._python, "text": self._output}
        assert block.language in rules, f"{block.place}: no rule for a block of {block.info!r}"
        rules[block.language](block)

    def _scene(self, block: Block) -> None:
        source = re.match(r"toml from (\S+)$", block.info)
        if source:
            assert block.text == (ROOT / source[1]).read_text(encoding="utf-8"), f"{block.place} is not {source[1]}"
        added = re.match(r"# added to (\w+\.toml)\n", block.text)
        named = re.match(r"# (\w+\.toml)\n", block.text)
        file = Path(named[1] if named else "shown.toml")
        base = (SHIPPED_FOLDER / added[1]).read_text(encoding="utf-8") if added else ""
        file.write_text(base + block.text, encoding="utf-8")
        he.read(file)

    def _commands(self, block: Block) -> None:
        self.printed = ""
        self.is_elsewhere = any(plain(command) in ELSEWHERE for command in commands_of(block.text))
        for command in commands_of(block.text):
            if plain(command) in NOT_RUN | ELSEWHERE:
                read_command(command)
            elif not _is_foreign(command):
                self.printed += run_shown(command)

    def _python(self, block: Block) -> None:
        self.is_elsewhere = False
        printed = io.StringIO()
        with redirect_stdout(printed):
            exec(compile(block.text, block.place, "exec"), self.names)
        self.printed = printed.getvalue()

    def _output(self, block: Block) -> None:
        source = re.match(r"text from (\S+)$", block.info)
        printed = (ROOT / source[1]).read_text(encoding="utf-8") if source else self.printed
        if source or not self.is_elsewhere:
            assert is_shown(block.text, printed), f"{block.place} shows\n{block.text}\nbut there is\n{printed}"


@pytest.fixture(autouse=True)
def _beside_the_checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An empty folder in which a page's commands find what they name in the checkout."""
    monkeypatch.chdir(tmp_path)
    for folder in ("docs", "scenes"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    for table in SHIPPED_FOLDER.glob("*.csv"):
        shutil.copy(table, tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")


@pytest.mark.slow_but(
    "README.md", "CONTRIBUTING.md", "docs/api/*", "docs/[cirst]*/*", "docs/theory*", "docs/structure.md"
)
@pytest.mark.parametrize(
    "page", [page for page in PAGES if blocks_of(page)], ids=lambda page: str(page.relative_to(ROOT))
)
def test_blocks_do_what_they_say(page: Path) -> None:
    reader = Reader()
    for block in blocks_of(page):
        reader.take(block)


def test_the_readme_shows_the_file_that_it_copies() -> None:
    blocks = blocks_of(ROOT / "README.md")
    (copied,) = (match[1] for block in blocks if (match := re.search(r"^cp (\S+) ", block.text, re.MULTILINE)))
    assert [block.info for block in blocks if block.language == "toml"] == [f"toml from {copied}"]


def test_the_readme_models_the_same_beam_by_the_command_and_from_python() -> None:
    """Their numbers agree as far as both are shown; that each is what is printed, the test of the page tells."""
    texts = [block.text for block in blocks_of(ROOT / "README.md") if block.language == "text"]
    by_command = re.search(r"First elastic tone: .* ω = (\S+) rad/s .* added mass (\S+) kg/m²", texts[0])
    from_python = re.search(r" 5.0 m: (\S+) rad/s, added mass (\S+) kg/m²", texts[-1])
    assert by_command is not None
    assert from_python is not None
    for shown, other in zip(from_python.groups(), by_command.groups(), strict=True):
        assert shown == f"{float(other):.{len(shown.partition('.')[2])}f}"


def _inline_commands() -> dict[str, str]:
    """Commands within the text of all pages, each once, with the place where it stands first."""
    found: dict[str, str] = {}
    for page in PAGES:
        for code in inline_code_of(page):
            if re.match(r"(\S+=\S+ )*\./hydro \w", code.text):
                found.setdefault(code.text, code.place)
    return found


@pytest.mark.parametrize("command", _inline_commands())
def test_commands_within_the_text_exist(command: str) -> None:
    if command in NOT_RUN | ELSEWHERE or (FORM.search(command) and command != "./hydro list"):
        read_command(command)
    else:
        run_shown(command)


@pytest.mark.parametrize(
    ("shown", "printed", "expected"),
    [
        ("ω = 1.234 rad/s", "ω =  1.235   rad/s", True),
        ("ω = 1.234 rad/s", "ω = 1.236 rad/s", False),
        ("1.2e+03", "1.4e+03", False),
        ("error 2.4e-09", "error 6.1e-09", True),
        ("error 2.4e-09", "error 9.1e-09", False),
        ("mode 1\n...\nmode 3", "mode 1\nmode 2\nmode 3", True),
        ("mode 1\nmode 3", "mode 1\nmode 2\nmode 3", False),
        ("mode 3\n...\nmode 1", "mode 1\nmode 2\nmode 3", False),
        ("83 cells; seconds: mesh 0.1; peak memory 9 MiB.", "91 cells; seconds: draw 2.0; peak\nmemory 8 MiB.", True),
    ],
)
def test_what_is_shown_is_compared(shown: str, printed: str, expected: bool) -> None:
    assert is_shown(shown, printed) == expected


def test_tests_that_run_commands_elsewhere_are_there() -> None:
    assert all((ROOT / test).exists() for test in ELSEWHERE.values())


def test_what_is_not_run_is_shown_somewhere() -> None:
    blocks = [block for page in PAGES for block in blocks_of(page) if block.language == "sh"]
    commands = [command for block in blocks for command in commands_of(block.text)]
    foreign = [command.strip() for command in commands if _is_foreign(command)]
    shown = {plain(command) for command in commands if not _is_foreign(command)} | set(_inline_commands())
    # What the pages no longer name needs no excuse.
    assert set(NOT_RUN) | set(ELSEWHERE) <= shown
    assert all(any(command.startswith(start) for command in foreign) for start in FOREIGN)
