"""`he.study`: the study of the command line, from Python."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import hydroelastic as he
from hydroelastic.scenes.command_line import main


def test_a_study_is_that_of_the_command(tmp_path: Path) -> None:
    study = he.study("sloshing", families=["uniform"], degrees=np.array([2]), halvings=2)
    given = ["study", "sloshing", "--families", "uniform", "--degrees", "2", "--halvings", "2"]
    told = CliRunner().invoke(main, [*given, "--out", str(tmp_path / "command")])
    assert told.exit_code == 0
    # Seconds and memory stand last, and the lines of the tables are as long as their digits.
    rows = [
        [row.split()[:5] for row in text.splitlines() if not row.startswith(" ─")] for text in (str(study), told.stdout)
    ]
    assert rows[0] == rows[1][: len(rows[0])]
    assert study.table["error"].tolist() == [row.error for row in study.measured.rows]
    assert repr(study) == f"<Study of {study.measured.scene.title!r}, 3 solutions: ok>"
    assert "<pre>" in study._repr_html_()
    study.save(tmp_path / "python")
    assert {file.name for file in (tmp_path / "python").iterdir()} == {
        file.name for file in (tmp_path / "command").iterdir()
    }


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: he.study("swell"), 'key "kind" = "roll": a study measures the errors of frequencies of closed tanks'),
        (lambda: he.study("sloshing", degrees=[0]), "degrees = 0: it is out of range. Allowed: whole numbers from 1"),
        (lambda: he.study("sloshing", families=["unifrm"]), 'families = "unifrm": it is not known. Allowed: one or'),
        (lambda: he.study("sloshing", halvings=1.5), "halvings = 1.5: it is not a whole number"),
    ],
)
def test_a_study_that_cannot_be_made_is_refused_in_words(call: Callable[[], object], said: str) -> None:
    with pytest.raises(he.SceneError, match=re.escape(said)):
        call()


@pytest.mark.slow
def test_a_study_in_three_dimensions_has_rows_of_each_model() -> None:
    study = he.study("rectangular_cover", tolerances=[1e-2])
    assert {row.model for row in study.measured.rows} == set(study.table["model"])
    assert study.status == "ok"
