"""Pages are written while the next ones are drawn; what several pages share is made once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mode_pictures import pixels, sloshing_picture

from hydroelastic.output.pictures import tank
from hydroelastic.output.pictures.modes import draw_mode, draw_overview
from hydroelastic.output.pictures.page import save, saving

PAGE = np.random.default_rng(1).integers(0, 256, (300, 400, 4), dtype=np.uint8)


def test_pages_written_beside_are_those_written_at_once(tmp_path: Path) -> None:
    picture = sloshing_picture()
    with saving():
        for name, sign in (("one", 1.0), ("other", -1.0)):
            draw_mode(picture.times(sign), tmp_path / f"{name}_beside.png", width=800)
    for name, sign in (("one", 1.0), ("other", -1.0)):
        draw_mode(picture.times(sign), tmp_path / f"{name}.png", width=800)
        assert (tmp_path / f"{name}.png").read_bytes() == (tmp_path / f"{name}_beside.png").read_bytes()


def write_beside(*paths: Path, error: Exception | None = None) -> None:
    """Write a page to each path, then fail with an error, if one is given."""
    with saving():
        for path in paths:
            save(PAGE, path)
        if error is not None:
            raise error


def test_an_error_of_writing_is_raised_by_the_next_page_or_the_end(tmp_path: Path) -> None:
    absent, after = tmp_path / "absent" / "page.png", tmp_path / "after.png"
    for paths in ((absent,), (absent, after)):
        with pytest.raises(FileNotFoundError, match="absent"):
            write_beside(*paths)
    assert not after.exists()


def test_an_error_of_drawing_leaves_whole_files(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError):
        write_beside(tmp_path / "page.png", error=ZeroDivisionError())
    assert (pixels(tmp_path / "page.png") == PAGE[:, :, :3]).all()


def test_panels_of_one_size_share_their_raster(tmp_path: Path) -> None:
    """Rounding errors would make some of them a pixel wider."""
    picture = sloshing_picture()
    tank._raster.cache_clear()
    draw_overview([picture.times(sign) for sign in (1.0, -1.0) * 4], tmp_path / "sheet.png", columns=3)
    assert tank._raster.cache_info().misses == 1
