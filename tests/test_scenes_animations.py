"""Animations of runs: which there are when they are asked for, and what they show."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mode_pictures import gif_pages

from hydroelastic.output.pictures.gif import FRAMES
from hydroelastic.output.pictures.line_view import DrawnLine, LineView
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.thread import line_pictures
from hydroelastic.scenes.thread.run import run_thread

ANIMATED = PictureOptions(width=800, animate=True)
HALF = FRAMES // 2
MOTION = '{kind="motion",times=[0.0,0.1,0.2],move=[{end="b",amplitude=[0.2,0.0,0.0],omega=3.0}]}'


def animations(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "images").glob("*.gif"))


@pytest.mark.slow
def test_tanks_are_animated_when_asked(tanks: Any, tmp_path: Path) -> None:
    scene = tanks.scene(modes=2, tolerance=1e-3)
    outcome = run_scene(scene, out=tmp_path / "moving", images=ANIMATED)
    assert outcome.warnings == ()
    # The lowest two, both of a kind; one of them bends most.
    assert animations(tmp_path / "moving")[:2] == ["mode_001.gif", "mode_002.gif"]
    pages = gif_pages(tmp_path / "moving" / "images" / "mode_001.gif")
    assert (len(pages), pages[0].shape[1]) == (FRAMES, 400)
    run_scene(scene, out=tmp_path / "still")
    assert animations(tmp_path / "still") == []


@pytest.mark.slow
def test_strings_are_animated_when_asked(tmp_path: Path) -> None:
    scene = read_scene("string_smooth", ["output.times={start=0.0,stop=1.0,number=9}"])
    run_scene(scene, out=tmp_path / "moving", images=ANIMATED)
    assert animations(tmp_path / "moving") == ["motion.gif"]
    # A series is summed at times of its own where few are asked.
    assert len(gif_pages(tmp_path / "moving" / "images" / "motion.gif")) == 60


def hanging_chain(*analyses: str) -> ThreadScene:
    overrides = ["accuracy.tolerance=1e-4", "output.frames=0", f"analysis=[{','.join(analyses)}]"]
    scene = read_scene("catenary", overrides)
    assert isinstance(scene, ThreadScene)
    return scene


@pytest.mark.slow
def test_threads_are_animated_when_asked(tmp_path: Path) -> None:
    run_scene(hanging_chain('{kind="modes",count=1}', MOTION), out=tmp_path / "moving", images=ANIMATED)
    assert animations(tmp_path / "moving") == ["motion.gif", "oscillation_001.gif"]
    assert len(gif_pages(tmp_path / "moving" / "images" / "motion.gif")) == 3


def test_a_mode_of_a_thread_swings_about_its_equilibrium(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[LineView, list[DrawnLine]]] = []

    def keep(view: LineView, lines: list[DrawnLine], path: Path, *, width: int) -> None:
        assert (path.name, width) == ("oscillation_001.gif", 400)
        seen.append((view, lines))

    monkeypatch.setattr(line_pictures, "animate_line", keep)
    outcome = run_thread(hanging_chain('{kind="modes",count=1}'), out=tmp_path / "moving", images=ANIMATED)
    ((view, lines),) = seen
    rest = outcome.solution.rest.positions
    assert len(lines) == FRAMES
    shifts = np.array([line.points - rest for line in lines])
    assert shifts[HALF] == pytest.approx(-shifts[0], abs=1e-12)
    largest = np.linalg.norm(shifts[0], axis=1).max()
    # 0.08 of the extent of 10 m, as the caption says; a mode of an undamped chain is real.
    assert largest == pytest.approx(0.8)
    assert "largest displacement drawn as 0.8 m (arbitrary amplitude)" in lines[0].note
    assert "left out" not in lines[0].note
    # Ends stay, and all of it is within the view.
    assert np.abs(shifts[:, [0, -1]]).max() < 1e-9
    points = np.concatenate([line.points for line in lines])
    assert np.all(points.min(axis=0) >= view.low - 1e-9)
    assert np.all(points.max(axis=0) <= view.high + 1e-9)
    assert [line.title[-10:] for line in lines[:2]] == ["t = 0.00 T", "t = 0.04 T"]
