"""Lines of text are where matplotlib would write them, as large, and in their room."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from hydroelastic.output.pictures.letters import unhinted_letters
from hydroelastic.output.pictures.page import POINT, WIDTH, new_page, pixels, write

TEXT = "Mode 3: ω = 3.42795 rad/s, ψ, $ 10 %"
HEIGHT = 200.0


def ink(page: NDArray[np.uint8]) -> tuple[int, int, int, int]:
    """Left, right, top and bottom of what is not white."""
    rows, columns = np.nonzero((page[:, :, :3] < 240).any(axis=2))
    return int(columns.min()), int(columns.max()), int(rows.min()), int(rows.max())


@pytest.mark.parametrize("width", [1600, 800])
def test_a_line_is_where_matplotlib_would_write_it(width: int) -> None:
    ours, theirs = new_page(HEIGHT, width), new_page(HEIGHT, width)
    write(ours, TEXT, 60.0, size=30.0, colour="black")
    line = theirs.text(0.5, 60.0 / HEIGHT, TEXT, size=30.0 * POINT, ha="center", va="center")
    line.set_parse_math(False)
    with unhinted_letters():
        expected = ink(pixels(theirs))
    # Each places letters on whole pixels.
    assert ink(pixels(ours)) == pytest.approx(expected, abs=2)


def test_a_long_line_is_as_small_as_fits_into_its_room() -> None:
    page, room = new_page(HEIGHT, 800), 600.0
    short, long = (write(page, text, 60.0, size=30.0, room=room) for text in ("short", 5 * TEXT))
    assert short.size == 15.0
    assert long.size < 15.0
    short.remove()
    left, right, *_ = ink(pixels(page))
    assert 0.98 * room * 800 / WIDTH < right - left <= room * 800 / WIDTH


def test_letters_have_their_colour_and_keep_what_is_behind() -> None:
    page = new_page(HEIGHT, 800)
    page.patch.set_facecolor("#00ff00")
    write(page, "█", 100.0, size=60.0, colour="#ff0000")
    found = pixels(page)[:, :, :3].reshape(-1, 3)
    # Edges are mixed of both.
    assert found[:, :2].sum(axis=1) == pytest.approx(255.0, abs=1.5)
    assert (found == (255, 0, 0)).all(axis=1).any()
    assert (found == (0, 255, 0)).all(axis=1).any()
