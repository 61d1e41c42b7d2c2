"""Lines of text as pixels.

matplotlib draws one letter after the other; FreeType, through matplotlib, makes a whole line in a quarter of the time.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.backend_bases import RendererBase
from matplotlib.backends.backend_agg import RendererAgg, get_hinting_flag
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import FT2Font

# Middle between the top of an "l" and the foot of a "p", over the size.
_MIDDLE = 0.26
# FreeType's parts of a pixel.
_PARTS = 64.0


class TextLine(Artist):
    """A line of text without formulas, smaller if it would not fit.

    Attributes:
        size: of the letters, in pixels of the image.

    Args:
        text: of the line.
        x: its middle, in pixels of the image from the left.
        y: its middle, in pixels from below.
        size: see there.
        colour: of the letters.
        room: width into which it must fit, in pixels.
    """

    zorder = 3.0

    def __init__(self, text: str, x: float, y: float, *, size: float, colour: str, room: float = np.inf) -> None:
        super().__init__()
        self._text, self._x, self._y = text, x, y
        self._colour = 255.0 * np.array(to_rgb(colour), dtype=np.float32)
        self.size = size
        width, _ = self._set().get_width_height()
        self.size *= min(1.0, room * _PARTS / max(width, 1))

    def _set(self) -> FT2Font:
        font = get_font(findfont(FontProperties()))
        font.set_size(self.size, 72.0)
        with unhinted_letters():
            font.set_text(self._text, 0.0, flags=get_hinting_flag())
        return font

    def draw(self, renderer: RendererBase) -> None:
        """Lay the letters over the page."""
        assert isinstance(renderer, RendererAgg)
        font = self._set()
        font.draw_glyphs_to_bitmap(antialiased=True)
        letters = font.get_image()
        height, width = letters.shape
        page = np.asarray(renderer.buffer_rgba())
        left = round(self._x - 0.5 * width)
        foot = round(len(page) - self._y + _MIDDLE * self.size + font.get_descent() / _PARTS)
        behind = page[foot - height : foot, left : left + width, :3]
        behind[:] = behind + letters[:, :, None] / np.float32(255.0) * (self._colour - behind)


@contextmanager
def unhinted_letters() -> Iterator[None]:
    """Draw letters where they belong: hinting would move small ones to whole pixels, a quarter nearer to each other.

    The context of matplotlib copies all settings, which takes longer than a line of text.
    """
    hinting = rcParams["text.hinting"]
    rcParams["text.hinting"] = "no_hinting"
    try:
        yield
    finally:
        rcParams["text.hinting"] = hinting
