"""Animations: a period in fixed scales that goes on without a jump, and is the same file each time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mode_pictures import gif_pages, has_colour, heave_picture, sloshing_picture
from PIL import Image

from hydroelastic.fem.pictures.mode import ModePicture
from hydroelastic.output.pictures.colours import BODY, mode_colours
from hydroelastic.output.pictures.gif import FRAMES, write_gif
from hydroelastic.output.pictures.modes import animate_mode, animate_motion
from hydroelastic.output.pictures.tank import drawn_vectors
from hydroelastic.output.pictures.view import view_of
from hydroelastic.output.reading import Reading
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.scenes.tank.shapes import animated_modes

WIDTH = 800
UNIT = WIDTH / 1600
HALF = FRAMES // 2
MEGABYTE = 1_000_000


def animated(picture: ModePicture, folder: Path) -> list[np.ndarray]:
    animate_mode(picture, folder / "mode.gif", width=WIDTH)
    return gif_pages(folder / "mode.gif")


def tank_part(page: np.ndarray) -> np.ndarray:
    """A page without its title and its legend."""
    return page[round(85 * UNIT) : -round(285 * UNIT)]


@pytest.fixture(scope="module")
def sloshing(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[np.ndarray]]:
    folder = tmp_path_factory.mktemp("sloshing")
    return folder / "mode.gif", animated(sloshing_picture(), folder)


@pytest.mark.slow
def test_a_period_repeats_itself_and_is_small(sloshing: tuple[Path, list[np.ndarray]]) -> None:
    path, pages = sloshing
    assert len(pages) == FRAMES
    assert path.stat().st_size < 2 * MEGABYTE
    with Image.open(path) as gif:
        assert (gif.width, gif.info["loop"]) == (WIDTH, 0)
        # A page lasts whole hundredths of a second.
        assert gif.info["duration"] == 80


@pytest.mark.slow
def test_the_motion_goes_on_without_a_jump(sloshing: tuple[Path, list[np.ndarray]]) -> None:
    pages = [tank_part(page) for page in sloshing[1]]
    steps = [np.abs(one - other).mean() for one, other in zip(pages, [*pages[1:], pages[0]], strict=True)]
    # From the last page to the first it moves as little as from the first to the second: cos is flat there.
    assert steps[-1] < 0.75 * max(steps)
    assert steps[-1] == pytest.approx(steps[0], rel=0.1)
    # To and fro: a page and the one as long before the end show the same.
    for place in (1, 5, 11):
        assert np.abs(pages[place] - pages[-place]).mean() < 0.1


@pytest.mark.slow
def test_half_a_period_later_the_body_is_on_the_other_side(tmp_path: Path) -> None:
    picture = heave_picture(1.0)
    rows = [np.nonzero(has_colour(tank_part(page), BODY))[0].mean() for page in animated(picture, tmp_path)]
    view = view_of(picture)
    largest = view.surface_scale * (WIDTH - 230 * UNIT) / view.length
    expected = -largest * np.cos(2.0 * np.pi * np.arange(FRAMES) / FRAMES)
    # Rows are counted downwards. The middle of a body of few rows is known to a pixel.
    assert np.array(rows) - np.mean(rows) == pytest.approx(expected, abs=1.0)


def test_half_a_period_later_the_field_has_the_other_sign(sloshing: tuple[Path, list[np.ndarray]]) -> None:
    def greenness(page: np.ndarray) -> np.ndarray:
        """Green less purple of coarse squares deep below the surface."""
        part = tank_part(page)[-120:]
        tint = part[:, :, 1] - 0.5 * (part[:, :, 0] + part[:, :, 2])
        return np.asarray(tint[:, : tint.shape[1] // 20 * 20].reshape(4, 30, -1, 20).mean(axis=(1, 3)))

    first, half = greenness(sloshing[1][0]), greenness(sloshing[1][HALF])
    assert np.abs(first).max() > 3.0
    # Purple and green are not exactly opposite, and 255 colours stand for all.
    assert np.corrcoef(first.ravel(), half.ravel())[0, 1] < -0.9


def test_colours_keep_their_meaning(sloshing: tuple[Path, list[np.ndarray]]) -> None:
    # The colour bar is the same on all pages, and its ends are those of the scale.
    bars = [page[-round(125 * UNIT) : -round(100 * UNIT)] for page in sloshing[1]]
    assert all((bar == bars[0]).all() for bar in bars)
    colours = np.round(255 * np.array(mode_colours().colors)).astype(int)
    for end in (colours[0], colours[-1]):
        # A few of 255 colours stand for an end of the scale.
        assert np.abs(bars[0] - end).sum(axis=2).min() <= 24


def test_the_file_is_the_same_each_time(tmp_path: Path, sloshing: tuple[Path, list[np.ndarray]]) -> None:
    pages = [page.astype(np.uint8) for page in sloshing[1][:4]]
    write_gif(pages, tmp_path / "one.gif", seconds=0.4)
    write_gif(pages, tmp_path / "other.gif", seconds=0.4)
    assert (tmp_path / "one.gif").read_bytes() == (tmp_path / "other.gif").read_bytes()


def test_few_colours_are_kept_exactly(tmp_path: Path) -> None:
    pages = [np.full((20, 30, 3), colour, dtype=np.uint8) for colour in (250, 240, 17)]
    write_gif(pages, tmp_path / "grey.gif", seconds=3.0)
    found = gif_pages(tmp_path / "grey.gif")
    assert all((page == expected).all() for page, expected in zip(found, pages, strict=True))


def test_vectors_of_an_instant_are_as_much_shorter_as_it_is() -> None:
    whole = np.array([[1.0, 0.0], [0.0, 30.0], [2.0, 2.0]])
    largest = drawn_vectors(whole, 10.0)
    lengths = np.hypot(*whole.T)
    assert drawn_vectors(-0.3 * whole, 10.0, lengths) == pytest.approx(-0.3 * largest)


def test_a_wrong_name_is_refused(tmp_path: Path) -> None:
    picture = sloshing_picture()
    with pytest.raises(ValueError, match=r"ends in \.gif"):
        animate_mode(picture, tmp_path / "mode.png")
    with pytest.raises(ValueError, match=r"ends in \.gif"):
        animate_motion([picture], picture, tmp_path / "mode.mp4")


def test_notable_modes_are_animated() -> None:
    kinds = ["sloshing", "sloshing", "heave", "sloshing", "heave", "hinge"]
    bending = [0.0, 0.1, 0.0, 0.4, 0.0, 0.0]
    modes = [{"kind": kind, "elastic_energy_fraction": share} for kind, share in zip(kinds, bending, strict=True)]
    # The lowest two, the lowest of each kind, the one with the largest share of bending.
    assert animated_modes(Reading(TANK, {"modes": modes})) == [0, 1, 2, 3, 5]
    assert animated_modes(Reading(TANK, {"modes": modes[:1]})) == [0]
    assert animated_modes(Reading(TANK, {"modes": []})) == []
