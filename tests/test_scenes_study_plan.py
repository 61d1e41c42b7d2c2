"""Plans of studies: lists are put in order, and each mistake is one clear message with exit code 2."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.study.options import EXAMPLES, plan_from_options
from hydroelastic.scenes.study.plan import StudyPlan


def test_lists_are_put_in_order_and_entries_taken_once() -> None:
    values: dict[str, Any] = {
        "families": ["tolerance", "uniform"],
        "degrees": [3, 1, 3],
        "tolerances": [1e-6, 1e-3, 1e-6],
    }
    plan = StudyPlan(**values)
    assert plan.families == ("uniform", "tolerance")
    assert plan.degrees == (1, 3)
    assert plan.tolerances == (1e-3, 1e-6)


@pytest.mark.parametrize(
    ("text", "degrees"),
    [("1,2,3", (1, 2, 3)), ("1-8", tuple(range(1, 9))), (" 2 , 5 - 7,10", (2, 5, 6, 7, 10)), ("4", (4,))],
)
def test_degrees_are_lists_and_ranges(text: str, degrees: tuple[int, ...]) -> None:
    assert plan_from_options({"degrees": text, "tolerances": None}).degrees == degrees


def test_what_is_not_given_is_the_default() -> None:
    assert plan_from_options(dict.fromkeys(EXAMPLES)) == StudyPlan()


def test_every_example_of_a_message_is_allowed() -> None:
    for name, example in EXAMPLES.items():
        for text in example.split(" or "):
            plan_from_options({name: text})


BAD = [
    ("degrees", "0", "--degrees = 0: it is out of range"),
    ("degrees", "1-11", "--degrees = 11: it is out of range"),
    ("degrees", "1.5", '"1.5" is not a whole number'),
    ("degrees", "two", '"two" is not a whole number'),
    ("degrees", "", "--degrees: it is empty"),
    ("degrees", "1,,2", "an entry is empty"),
    ("degrees", "3-1", "the range 3-1 runs downwards"),
    ("degrees", "-2", "--degrees = -2: it is out of range"),
    ("degrees", "1-999999999999", "--degrees = 11: it is out of range"),
    ("geometric_degrees", "0-4", "--geometric-degrees = 0: it is out of range"),
    ("tolerances", "1e-3,x", '"x" is not a number'),
    ("tolerances", "1e-13", "--tolerances = 1e-13: it is out of range"),
    ("tolerances", "nan", "--tolerances = nan: it is out of range"),
    ("tolerances", " ", "--tolerances: it is empty"),
    ("halvings", "1", "--halvings = 1: it is out of range"),
    ("halvings", "", "an entry is empty"),
    ("most_unknowns", "1e5", '"1e5" is not a whole number'),
    ("families", "unifrom", 'Did you mean "uniform"?'),
    ("families", "", "--families: it is empty"),
]


@pytest.mark.parametrize(("name", "text", "said"), BAD)
def test_a_bad_option_is_one_message_with_what_is_allowed_and_a_remedy(name: str, text: str, said: str) -> None:
    option = f"--{name.replace('_', '-')}"
    result = CliRunner().invoke(main, ["study", "sloshing", option, text])
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"Error: {option}")
    assert said in line
    assert "Allowed: " in line
    assert f"Write for example {option} {EXAMPLES[name]}" in line or "Did you mean" in line


def test_two_bad_options_are_said_at_once() -> None:
    result = CliRunner().invoke(main, ["study", "sloshing", "--degrees", "0", "--halvings", "9"])
    assert result.exit_code == 2
    assert [line.split(" = ")[0].strip() for line in result.stderr.splitlines()[1:]] == ["--degrees", "--halvings"]


@pytest.mark.parametrize(
    "values",
    [
        {"degrees": ()},
        {"degrees": (0,)},
        {"degrees": (1.0,)},
        {"degrees": (True,)},
        {"degrees": 3},
        {"degrees": "12"},
        {"tolerances": (float("nan"),)},
        {"tolerances": ("1e-3",)},
        {"halvings": 1},
        {"halvings": 2.0},
        {"most_unknowns": 10},
        {"families": "uniform"},
        {"families": ()},
        {"families": ("hp",)},
    ],
)
def test_a_bad_plan_is_refused_from_python_as_well(values: dict[str, Any]) -> None:
    with pytest.raises(SceneError, match=next(iter(values))):
        StudyPlan(**values)


@pytest.mark.slow
def test_the_command_prints_and_writes_what_was_asked(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    arguments = ["study", "sloshing", "--families", "uniform,tolerance", "--degrees", "2", "--tolerances", "1e-4"]
    arguments += ["--halvings", "3", "--set", "accuracy.modes=2", "--out", str(folder)]
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, result.output
    assert "Uniform meshes" in result.stdout
    assert "geometric rings" not in result.stdout
    assert {path.name for path in folder.iterdir()} == {
        *("study.csv", "study.txt", "study.png"),
        *("summary.json", "manifest.json"),
    }
    assert (folder / "study.txt").read_text(encoding="utf-8").strip() in result.stdout


def test_a_folder_that_is_not_ours_is_refused_before_anything_is_solved(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    result = CliRunner().invoke(main, ["study", "sloshing", "--out", str(tmp_path)])
    assert result.exit_code == 2
    assert "not a result folder" in result.stderr
