"""Pictures of lines in space: measured in the pixels that were written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib import colormaps
from mode_pictures import gif_pages, has_colour, pixels

from hydroelastic.output.pictures.colours import BODY, INK, SEQUENCE
from hydroelastic.output.pictures.line import animate_line, draw_lines
from hydroelastic.output.pictures.line_view import DrawnLine, LineView, line_view

WIDTH = 800
UNIT = WIDTH / 1600
FOOTER = round(285 * UNIT)
STREAM = "#56B4E9"


def line(points: np.ndarray, values: np.ndarray) -> DrawnLine:
    return DrawnLine(points=points, values=values, fixed=points[:1], bodies=points[-1:], title="A thread ρ²")


def hanging(*, sideways: float = 0.0) -> np.ndarray:
    """A parabola of 10 m by 3 m, that leaves the plane by as much as is asked."""
    along = np.linspace(0.0, 1.0, 60)
    return np.column_stack([10.0 * along, sideways * np.sin(np.pi * along), 12.0 * along * (along - 1.0)])


def drawn(view: LineView, one: DrawnLine, folder: Path, width: int = WIDTH) -> np.ndarray:
    draw_lines(view, [one], [folder / "line.png"], width=width)
    return pixels(folder / "line.png")


def middle(where: np.ndarray) -> np.ndarray:
    """Column and row of the middle of an area."""
    rows, columns = np.nonzero(where)
    return np.array([columns.mean(), rows.mean()])


def drawing_part(image: np.ndarray) -> np.ndarray:
    """The image without the axis below and the legend."""
    return image[: len(image) - FOOTER]


def test_a_plane_line_is_drawn_to_scale(tmp_path: Path) -> None:
    points = hanging() + np.array([2.0, 5.0, 7.0])
    points[-1, 2] += 4.0
    values = np.linspace(3.0, 8.0, len(points))
    view = line_view(points, values, "tension", "N")
    assert view.flat
    image = drawn(view, line(points, values), tmp_path)
    part = drawing_part(image)
    # The held end's square is larger than the body's disc, and has the colour of letters.
    start, end = points[0], points[-1]
    across, _, up = view.high - view.low
    per_metre = min((WIDTH - 210 * UNIT) / across, 0.62 * WIDTH / up)
    body = middle(has_colour(part, BODY))
    block = part[:, round(150 * UNIT) :]
    inks = has_colour(block, INK)
    square = inks & (np.cumsum(inks, axis=0) > 0)
    held = middle(square & (np.abs(np.arange(block.shape[0])[:, None] - (body[1] + 4.0 * per_metre)) < 20))
    held[0] += round(150 * UNIT)
    step = (end - start)[[0, 2]] * [1.0, -1.0] * per_metre
    # A disc and a square of 20 pixels: their middles are known to a pixel.
    assert body - held == pytest.approx(step, abs=1.0)


def test_colours_are_those_of_the_values(tmp_path: Path) -> None:
    points = np.column_stack([np.linspace(0.0, 10.0, 50), np.zeros(50), np.zeros(50)])
    values = np.linspace(-1.0, 1.0, 50)
    view = line_view(points, values, "tension", "N")
    bare = DrawnLine(points=points, values=values, fixed=points[:0], bodies=points[:0], title="")
    image = drawn(view, bare, tmp_path)
    per_metre = (WIDTH - 210 * UNIT) / (view.high - view.low)[0]
    for x, place in ((0.1, 2), (5.0, 127), (9.9, 253)):
        column = int(150 * UNIT + per_metre * (x - view.low[0]))
        row = len(image) - 1 - int(FOOTER - per_metre * view.low[2])
        # One piece of the line spans five of 256 colours.
        expected = 255 * np.array(colormaps[SEQUENCE](place)[:3])
        assert np.abs(image[row, column] - expected).max() < 12


@pytest.mark.parametrize("sideways", [0.0, 2.0, 9.0])
@pytest.mark.parametrize("tall", [1.0, 6.0])
def test_nothing_is_cut_off(tmp_path: Path, sideways: float, tall: float) -> None:
    points = hanging(sideways=sideways) * [1.0, 1.0, tall]
    values = np.full(len(points), 12345.6)
    view = line_view(points, values, "tension", "kN", lambda at: np.tile([1.0, 0.5, 0.0], (len(at), 1)))
    image = drawn(view, line(points, values), tmp_path)
    assert image.shape[1] == WIDTH
    for edge in (image[:3], image[-3:], image[:, :3], image[:, -3:]):
        assert (edge == 255).all()
    assert has_colour(drawing_part(image), BODY).any()
    assert has_colour(drawing_part(image), STREAM).any()
    assert np.all(view.low <= points.min(axis=0) + 1e-12)
    assert np.all(view.high >= points.max(axis=0) - 1e-12)


def test_nothing_is_shown_below_the_lowest_point() -> None:
    """There may be the bed: the stream does not go on below it."""
    points = np.column_stack([np.linspace(0.0, 57.0, 9), np.zeros(9), np.linspace(3.0, 104.0, 9)])
    view = line_view(points, np.arange(9.0), "tension", "N", lambda places: np.ones_like(places))
    # The box leaves room for half the width of the line.
    assert view.low[2] == pytest.approx(3.0 - 0.04 * 101.0)
    assert view.stream is not None
    heights, _ = view.stream
    assert 3.0 < heights.min() < heights.max() < 104.0
    # Of a thread that hardly rises a slit would be seen.
    level = line_view(points * [1.0, 1.0, 0.01], np.arange(9.0), "tension", "N")
    assert level.high[2] - level.low[2] > 10.0


def test_a_view_is_the_same_on_all_pages(tmp_path: Path) -> None:
    points = hanging()
    view = line_view(points, np.array([0.0, 1.0]), "tension", "N")
    lines = [line(points + np.array([0.0, 0.0, shift]), np.zeros(len(points))) for shift in (0.0, 0.1)]
    animate_line(view, lines, tmp_path / "line.gif", width=WIDTH)
    one, other = gif_pages(tmp_path / "line.gif")
    assert one.shape == other.shape
    # Half of the line that touches the floor of the box lies below it.
    footer = slice(len(one) - FOOTER + round(10 * UNIT), None)
    assert (one[footer] == other[footer]).all()
    assert (one != other).any()


def test_the_size_of_everything_grows_with_the_width(tmp_path: Path) -> None:
    points, values = hanging(), np.linspace(0.0, 1.0, 60)
    view = line_view(points, values, "tension", "N")
    small, large = (drawn(view, line(points, values), tmp_path, width) for width in (600, 1200))
    assert large.shape[:2] == pytest.approx(2.0 * np.array(small.shape[:2]), abs=2)
    # Discs have four times as many pixels, but for their edges.
    areas = [has_colour(drawing_part(image), BODY).sum() for image in (small, large)]
    assert 3.5 < areas[1] / areas[0] < 5.5


def test_scales_of_one_value_and_of_no_stream(tmp_path: Path) -> None:
    points = hanging()
    assert line_view(points, np.zeros(3), "tension", "N").colours == (-1.0, 1.0)
    assert line_view(points, np.full(3, 4.0), "tension", "N").colours == (2.0, 6.0)
    still = line_view(points, np.zeros(3), "tension", "N", np.zeros_like)
    assert still.stream is not None
    image = drawn(still, line(points, np.zeros(60)), tmp_path)
    assert not has_colour(image, STREAM).any()
