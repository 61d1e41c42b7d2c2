"""Pages of matplotlib for fields and lines in space: title, keys, colour bar and caption around what is drawn.

Sizes are in pixels of a page that is 1600 pixels wide; wider pages have the same proportions and finer pixels.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.backend_bases import RendererBase
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.markers import TICKDOWN, MarkerStyle
from matplotlib.path import Path as PathOfMarker
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import IdentityTransform
from numpy.typing import NDArray
from PIL.PngImagePlugin import putchunk

from hydroelastic.output.pictures.colours import GREY, INK
from hydroelastic.output.pictures.letters import TextLine, unhinted_letters

WIDTH = 1600.0
"""Of the page to which sizes refer."""
FOOTER, HEADING, KEYS = 285.0, 85.0, 172.0
"""Heights below and above a drawing, for its axis, keys, colours and caption, and for its title; height of the keys."""
POINT = 0.72
"""Points, in which matplotlib measures strokes and letters, of a pixel."""

_PER_INCH = 72.0 / POINT
# Letters of DejaVu Sans are so wide in the mean, over their height.
_LETTER = 0.6
# Length of a tick of a colour bar, points.
_TICK = 7.0 * POINT
# What is placed in pixels of the image.
_IN_PIXELS: dict[str, Any] = {"color": "black", "transform": IdentityTransform(), "zorder": 0.0}


class FieldImage(Artist):
    """Pixels that go into a page as they are, below all else: resampling them would take longer than drawing.

    Args:
        image: red, green, blue in 0…255, and opacity if it is there, shape (height, width, 3 or 4), the uppermost row
            first.
        left: where they begin, in pixels of the page.
        bottom: where they end.
    """

    zorder = 0.0

    def __init__(self, image: NDArray[np.uint8], left: int, bottom: int) -> None:
        super().__init__()
        self._image, self._left, self._bottom = image, left, bottom

    def draw(self, renderer: RendererBase) -> None:
        """Write the pixels over those of the page."""
        assert isinstance(renderer, RendererAgg)
        page = np.asarray(renderer.buffer_rgba())
        height, width, channels = self._image.shape
        left, top = self._left, len(page) - self._bottom - height
        page[top : top + height, left : left + width, :channels] = self._image


def new_page(height: float, width: int) -> Figure:
    """An empty page: height in pixels of the page to which sizes refer, width in those of the image."""
    figure = Figure(figsize=(WIDTH / _PER_INCH, height / _PER_INCH), dpi=width / WIDTH * _PER_INCH)
    FigureCanvasAgg(figure)
    return figure


def place(figure: Figure, left: float, bottom: float, width: float, height: float) -> tuple[float, float, float, float]:
    """Where something stands on a page, as matplotlib has it: in parts of its width and height."""
    across, up = figure.get_size_inches() * _PER_INCH
    return left / across, bottom / up, width / across, height / up


def pixels(figure: Figure) -> NDArray[np.uint8]:
    """Red, green, blue in 0…255, and opacity, shape (height, width, 4), the uppermost row first.

    They are those of the page itself: drawing it anew changes them.
    """
    canvas = figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    # The canvas would be cleared before, though its background, or what covers it all, is drawn.
    with unhinted_letters():
        figure.draw(canvas.get_renderer())
    return np.asarray(canvas.buffer_rgba())


def titled(figure: Figure, titles: Sequence[str]) -> list[NDArray[np.uint8]]:
    """The pixels of a page under one title after the other, drawn anew for none of them."""
    page, pages = pixels(figure), []
    heading = page[: round(HEADING * figure.bbox.width / WIDTH)]
    untitled = heading.copy()
    for title in titles:
        heading[:] = untitled
        line = write_title(figure, title)
        figure.draw_artist(line)
        line.remove()
        pages.append(page.copy())
    return pages


def save(page: NDArray[np.uint8], path: Path) -> None:
    """Write the pixels of a page, which are not changed any more, as PNG in full colour; within `saving` beside others.

    Rows as they are compress better than the differences that Pillow would choose for each, and in a third of the time.
    They repeat in these pictures: a compression of 4 takes twice as long as 3 and saves 2 %.
    """
    thread = _THREAD.get()
    if thread is None:
        _write(page, path)
    else:
        thread.wait()
        thread.last = thread.pool.submit(_write, page, path)


def _write(page: NDArray[np.uint8], path: Path) -> None:
    height, width, _ = page.shape
    # Each row begins with its filter: none.
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)
    for channel in range(3):
        rows[:, 1 + channel :: 3] = page[:, :, channel]
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        putchunk(file, b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        putchunk(file, b"IDAT", zlib.compress(rows, 3))
        putchunk(file, b"IEND")


@dataclass
class _Thread:
    pool: ThreadPoolExecutor
    last: Future[None] | None = None

    def wait(self) -> None:
        """Wait for the last page, and raise its error."""
        if self.last is not None:
            self.last.result()


_THREAD: ContextVar[_Thread | None] = ContextVar("writes pages", default=None)


@contextmanager
def saving() -> Iterator[None]:
    """Write each page in a thread while the next one is drawn: compression leaves Python to others.

    Each page waits for the one before, whose error it raises; the end does so for the last one.
    """
    with ThreadPoolExecutor(max_workers=1) as pool:
        thread = _Thread(pool)
        before = _THREAD.set(thread)
        try:
            yield
            thread.wait()
        finally:
            _THREAD.reset(before)


def write(
    figure: Figure,
    text: str,
    y: float,
    *,
    size: float,
    colour: str = INK,
    x: float = 0.5 * WIDTH,
    room: float = WIDTH - 40.0,
) -> TextLine:
    """Write a centred line at a height of a page, smaller if it would not fit into its room."""
    scale = figure.bbox.width / WIDTH
    line = TextLine(text, scale * x, scale * y, size=scale * size, colour=colour, room=scale * room)
    figure.add_artist(line)
    return line


def write_title(figure: Figure, text: str) -> TextLine:
    """Write a title at the top of a page."""
    _, height = figure.get_size_inches() * _PER_INCH
    return write(figure, text, height - 42.0, size=30.0)


def write_caption(figure: Figure, text: str) -> TextLine:
    """Write what the reader must know to measure at the bottom of a page."""
    return write(figure, text, 30.0, size=19.0, colour=GREY)


def write_keys(figure: Figure, keys: Sequence[Artist], y: float) -> None:
    """Write keys with their names in one centred row, smaller if they would not fit."""
    _, height = figure.get_size_inches() * _PER_INCH
    # A key, its two gaps, and a name.
    wide = sum(5.5 + _LETTER * len(str(key.get_label())) for key in keys)
    size = min(20.0, (WIDTH - 40.0) / wide)
    figure.legend(
        handles=keys,
        loc="center",
        bbox_to_anchor=(0.5, y / height),
        ncols=len(keys),
        fontsize=size * POINT,
        frameon=False,
        handlelength=2.8,
        handletextpad=0.6,
        columnspacing=2.1,
        borderpad=0.0,
    )


def arrow_key(colour: str, name: str) -> Line2D:
    """The key of vectors."""
    corners = (
        (-1.0, 0.06),
        (0.4, 0.06),
        (0.4, 0.24),
        (1.0, 0.0),
        (0.4, -0.24),
        (0.4, -0.06),
        (-1.0, -0.06),
        (-1.0, 0.06),
    )
    marker = MarkerStyle(PathOfMarker(corners, closed=True))
    size = 44.0 * POINT
    return Line2D([], [], color=colour, linestyle="none", marker=marker, markersize=size, mew=0.0, label=name)


class ColourBar:
    """Colours between two limits with round ticks, what they mean on the right, all centred.

    Args:
        figure: receives them.
        colours: from the first to the last.
        meaning: of the values.
        measure: their unit, with anything that is said beside it.
        exponent: of the power of ten that the numbers leave out, see `exponent_of`.
    """

    def __init__(self, figure: Figure, colours: Colormap | str, *, meaning: str, measure: str, exponent: int) -> None:
        self._exponent = exponent
        width, gap = 640.0, 40.0
        left = 0.5 * (WIDTH - width - gap - _LETTER * 21.0 * len(f"{meaning}, {measure}"))
        # Pixels of the image. Axes would take several times as long to make and to draw.
        scale = figure.bbox.width / WIDTH
        ends, levels = scale * np.array([left, left + width]), scale * np.array([102.0, 122.0])
        self._ends, self._bottom = ends, float(levels[0])
        (x, right), (y, top) = ends.round().astype(int), levels.round().astype(int)
        row = colormaps.get_cmap(colours)(np.linspace(0.0, 1.0, right - x), bytes=True)
        figure.add_artist(FieldImage(np.tile(row, (top - y, 1, 1)), x, y))
        around = ends[[0, 1, 1, 0, 0]], levels[[0, 0, 1, 1, 0]]
        figure.add_artist(Line2D(*around, linewidth=0.8, solid_joinstyle="miter", **_IN_PIXELS))
        power = f"$10^{{{exponent}}}$ " if exponent else ""
        x, y = float(ends[1]) + scale * gap, float(levels.mean())
        figure.text(x, y, f"{meaning}, {power}{measure}", size=21.0 * POINT, va="center", **_IN_PIXELS)

    def span(self, figure: Figure, low: float, high: float) -> list[Artist]:
        """Put ticks on the colours, which span these values, in the same figure or another one on top of it."""
        power = 10.0**self._exponent
        ticks = round_ticks(low / power, high / power, 8)
        left, right = self._ends
        x = left + (right - left) * (ticks * power - low) / (high - low)
        y = np.full(len(x), self._bottom)
        marks = Line2D(x, y, ls="none", marker=MarkerStyle(TICKDOWN), markersize=_TICK, mew=0.8, **_IN_PIXELS)
        figure.add_artist(marks)
        scale, size = figure.bbox.width / WIDTH, 20.0
        middle = self._bottom / scale - (_TICK + 3.5) / POINT - 0.5 * size
        numbers = [
            write(figure, label, middle, size=size, colour="black", x=at / scale)
            for at, label in zip(x, tick_labels(ticks), strict=True)
        ]
        return [marks, *numbers]


def exponent_of(low: float, high: float) -> int:
    """The power of ten that numbers between two limits are written without: 0 if they are neither small nor large."""
    exponent = int(np.floor(np.log10(max(abs(low), abs(high)))))
    return 0 if -3 <= exponent <= 3 else exponent


def round_ticks(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Multiples of 1, 2 or 5 times a power of ten in [low, high], about ``count`` of them and never many more."""
    ticks = np.asarray(MaxNLocator(count, steps=(1, 2, 5, 10)).tick_values(low, high))
    rounding = 1e-9 * (high - low)
    return ticks[(ticks >= low - rounding) & (ticks <= high + rounding)]


def tick_labels(ticks: NDArray[np.float64]) -> list[str]:
    """Numbers with a true minus sign."""
    return [f"{tick + 0.0:.6g}".replace("-", "−") for tick in ticks]
