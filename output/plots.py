"""Pictures: their options, colours and style, sheets of curves, pages around fields, animations, rendering by VTK.

matplotlib and pyvista are imported where something is drawn.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, fields
from math import log10
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args
from warnings import catch_warnings, filterwarnings

import numpy as np

if TYPE_CHECKING:
    import pyvista
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.colorbar import Colorbar
    from matplotlib.colors import Colormap, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.text import Text
    from PIL import Image

CurveFormat: TypeAlias = Literal["png", "svg", "pdf"]
PictureOption: TypeAlias = Literal["formats", "dpi", "scale", "width", "animate"]

CURVE_FORMATS: tuple[CurveFormat, ...] = get_args(CurveFormat)
DPI_LIMITS, SCALE_LIMITS, WIDTH_LIMITS = (50, 1200), (0.8, 4.0), (400, 8000)
# Options that pictures of curves, rendered pictures of fields and lines, and animations heed.
OF_CURVES: frozenset[PictureOption] = frozenset(("formats", "dpi", "scale"))
OF_FIELDS: frozenset[PictureOption] = frozenset(("formats", "width"))
OF_MOTIONS: frozenset[PictureOption] = frozenset(("animate",))

_NO_CURVES = "this scene has only pictures of fields, which are as wide as width (--image-width) says"
_WITHOUT_EFFECT: dict[PictureOption, str] = {
    "dpi": "a resolution of curves has no effect: " + _NO_CURVES,
    "scale": "a scale of curves has no effect: " + _NO_CURVES,
    "width": "a width of rendered pictures has no effect: this scene has none, only curves, which dpi "
    "and scale (--dpi, --image-scale) size",
    "animate": "an animation has no effect: nothing of this scene can be animated",
}


@dataclass(frozen=True, kw_only=True)
class PictureOptions:
    """How pictures are made.

    Attributes:
        formats: files that are written of each picture: ``"png"``, ``"svg"``, ``"pdf"``; numbered frames are PNG.
        dpi: pixels per inch of curves in PNG, and of coloured maps inside SVG and PDF; 50 to 1200.
        scale: size of the page of curves over its usual one, 0.8 to 4; letters and strokes keep their size.
        width: of pictures of fields, pixels, 400 to 8000.
        animate: whether what moves is drawn as an animation too.

    Raises:
        ValueError: naming the option that cannot be used, its value and what is allowed.
    """

    formats: tuple[CurveFormat, ...] = ("png",)
    dpi: int = 130
    scale: float = 1.0
    width: int = 1600
    animate: bool = False

    def __post_init__(self) -> None:
        if not self.formats or not set(self.formats) <= set(CURVE_FORMATS):
            raise ValueError(f"formats = {self.formats}: allowed are one or more of {', '.join(CURVE_FORMATS)}")
        limits = {"dpi": DPI_LIMITS, "scale": SCALE_LIMITS, "width": WIDTH_LIMITS}
        for name, (low, high) in limits.items():
            # The comparison fails for NaN as well.
            if not low <= getattr(self, name) <= high:
                raise ValueError(f"{name} = {getattr(self, name)}: allowed are numbers from {low:g} to {high:g}")

    @property
    def animation_width(self) -> int:
        """Half of that of pictures, which keeps files small."""
        return max(self.width // 2, WIDTH_LIMITS[0])

    def without_effect(self, used: frozenset[PictureOption]) -> tuple[str, ...]:
        """Say which options were changed in vain."""
        changed = [field.name for field in fields(self) if getattr(self, field.name) != field.default]
        return tuple(words for name, words in _WITHOUT_EFFECT.items() if name in changed and name not in used)


DEFAULT_PICTURES = PictureOptions()

# Okabe and Ito's colours, which colour-blind readers can tell apart; curves differ in dashes or markers besides.
COLOURS = BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
)  # fmt: skip
INK, GREY, BODY, BODY_EDGE = "#1a1a1a", "#555555", "#d9660a", "#5c2a00"
SEQUENCE = "viridis"
DASHES = ("-", "--", "-.", ":")

PAGE = 16.0
"""Width in inches of the page of a field: lengths and letters of all of them refer to it."""
FRAMES, SECONDS = 24, 1.92
"""Pages of a period of an animation, and how long it lasts."""

_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 11.0,
    "axes.titlesize": 11.0,
    "axes.labelsize": 11.0,
    "xtick.labelsize": 10.0,
    "ytick.labelsize": 10.0,
    "legend.fontsize": 10.0,
    "legend.title_fontsize": 10.0,
    "legend.frameon": False,
    "legend.handlelength": 3.0,
    "figure.titlesize": 13.0,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 5),
    "axes.formatter.use_mathtext": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "lines.markersize": 5.0,
    # Text in SVG and PDF is stored as text; names inside of SVG files are reproducible.
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "hydroelastic",
}
_PAGE_STYLE: dict[str, Any] = {
    "font.size": 14.5,
    "axes.labelsize": 16.5,
    "xtick.labelsize": 15.0,
    "ytick.labelsize": 15.0,
    "legend.fontsize": 14.5,
    "figure.titlesize": 21.0,
    "text.hinting": "no_hinting",
    "axes.grid": False,
    # matplotlib's own letters of formulas are slow.
    "axes.formatter.use_mathtext": False,
}


def part_of_colours(name: str, first: float, last: float) -> ListedColormap:
    """A part of one of matplotlib's scales, whose ends are at 0 and 1."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    return ListedColormap(colormaps[name](np.linspace(first, last, 256))[:, :3])


def mode_colours() -> ListedColormap:
    """From purple by white to green: blue and orange stay free for surfaces; the dark ends would hide vectors."""
    return part_of_colours("PRGn", 0.17, 0.83)


def sequence_colours(count: int) -> list[tuple[float, float, float, float]]:
    """Colours of curves in an order, from light to dark."""
    shades = part_of_colours(SEQUENCE, 0.9, 0.0)
    return [shades(place / max(count - 1, 1)) for place in range(count)]


@contextmanager
def style(**changes: Any) -> Iterator[None]:
    """Draw in the style of the project, independently of the user's settings of matplotlib."""
    from matplotlib import style as styles

    with styles.context(["default", _STYLE | changes]):
        yield


@dataclass(frozen=True, kw_only=True)
class Sheets:
    """Pictures in an existing folder; the title, which may be empty, says what all curves are of."""

    folder: Path
    title: str
    options: PictureOptions = DEFAULT_PICTURES

    @contextmanager
    def sheet(self, name: str, heading: str, *, width: float, height: float = 5.4) -> Iterator[Figure]:
        """Provide a figure for curves; at the end of the block it is written as ``<name>.png`` and so on."""
        from matplotlib.figure import Figure

        width, height = width * self.options.scale, height * self.options.scale
        title, letters = f"{self.title}: {heading}", round(8.5 * width)
        if not self.title:
            title = fill(heading[:1].upper() + heading[1:], letters)
        elif len(title) > letters:
            title = f"{fill(self.title, letters)}\n{fill(heading, letters)}"
        with style():
            figure = Figure(figsize=(width, height), dpi=self.options.dpi, layout="constrained")
            yield figure
            # A dollar sign would begin a formula.
            figure.suptitle(title, parse_math=False)
            for axes in figure.axes:
                _label_decades(axes.xaxis)
                _label_decades(axes.yaxis)
            self.save(figure, name)

    def save(self, figure: Figure, name: str, image: Callable[[], Image.Image] | None = None) -> None:
        """Write a figure as ``<name>.png`` and so on; its pixels may be known."""
        with catch_warnings():
            # Where long labels leave no room, matplotlib warns and draws them over each other.
            filterwarnings("ignore", message="constrained_layout not applied", category=UserWarning)
            for kind in self.options.formats:
                file = self.folder / f"{name}.{kind}"
                if kind == "png":
                    # Without opacities, which matplotlib would write; runs of equal bytes are found the soonest.
                    drawn = image() if image else pixels(figure)
                    drawn.save(file, compress_type=3, dpi=(figure.dpi, figure.dpi))
                else:
                    # Without the time of writing, files of the same picture are the same.
                    dated = "Date" if kind == "svg" else "CreationDate"
                    figure.savefig(file, dpi=figure.dpi, metadata={dated: None})


def page_style() -> AbstractContextManager[None]:
    """The style of pages around fields."""
    return style(**_PAGE_STYLE)


def new_page(width: int, height: float) -> Figure:
    """An empty page of a width in pixels and a height in inches of `PAGE`."""
    from matplotlib.figure import Figure

    return Figure(figsize=(PAGE, height), dpi=width / PAGE)


def write_title(figure: Figure, words: str) -> Text:
    """Write a title at the top of a page, smaller if it would not fit."""
    return _write(figure, words, figure.get_figheight() - 0.42, 21.6, INK)


def write_caption(figure: Figure, words: str) -> Text:
    """Write what the reader must know to measure at the bottom of a page."""
    return _write(figure, words, 0.3, 13.7, GREY)


def _write(figure: Figure, words: str, y: float, size: float, colour: str) -> Text:
    # Letters are 0.58 of their size wide.
    size, y = min(size, 72.0 * (PAGE - 0.4) / (0.58 * max(len(words), 1))), y / figure.get_figheight()
    return figure.text(0.5, y, words, size=size, color=colour, ha="center", va="center", parse_math=False)


def write_keys(figure: Figure, keys: Sequence[Line2D], height: float = 1.72) -> None:
    """Write keys with their names in one row at a height in inches."""
    y = height / figure.get_figheight()
    figure.legend(handles=keys, loc="center", bbox_to_anchor=(0.5, y), ncols=len(keys), handlelength=2.8)


def arrow_key(colour: str, name: str) -> Line2D:
    """The key of vectors."""
    from matplotlib.lines import Line2D
    from matplotlib.markers import MarkerStyle
    from matplotlib.path import Path as Outline

    corners = (-1, 0.06), (0.4, 0.06), (0.4, 0.24), (1, 0), (0.4, -0.24), (0.4, -0.06), (-1, -0.06), (-1, 0.06)
    return Line2D([], [], color=colour, ls="", marker=MarkerStyle(Outline(corners)), ms=32.0, mew=0.0, label=name)


def add_colour_bar(figure: Figure, colours: ScalarMappable) -> Colorbar:
    """A horizontal scale of colours below the keys of a page."""
    from matplotlib.ticker import MaxNLocator

    axes = figure.add_axes(page_box(figure, 2.8, 1.02, 6.4, 0.2))
    axes.tick_params(length=5.0)
    return figure.colorbar(colours, cax=axes, orientation="horizontal", ticks=MaxNLocator(8, steps=(1, 2, 5, 10)))


def write_meaning(figure: Figure, words: str) -> Text:
    """Say what colours mean, beside their scale."""
    return figure.text(9.7 / PAGE, 1.12 / figure.get_figheight(), words, size=15.0, va="center", parse_math=False)


def page_box(
    figure: Figure, left: float, bottom: float, width: float, height: float
) -> tuple[float, float, float, float]:
    """A place in inches of a page in parts of it."""
    across, up = figure.get_size_inches()
    return left / across, bottom / up, width / across, height / up


def pixels(figure: Figure) -> Image.Image:
    """A figure as it is seen."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return without_opacity(canvas)


def without_opacity(canvas: FigureCanvasAgg) -> Image.Image:
    """What was drawn on a canvas."""
    from PIL import Image

    return Image.frombuffer("RGBA", canvas.get_width_height(), canvas.buffer_rgba()).convert("RGB")


def write_gif(
    pages: Iterable[Image.Image], path: Path, *, seconds: float = SECONDS, kept: Colormap | None = None
) -> None:
    """Write pages one after the other, with the same colours for all, as a GIF that repeats itself; a scale is kept."""
    from PIL import Image

    images = list(pages)
    scale = b"" if kept is None else kept(np.arange(0, 256, 2), bytes=True)[:, :3].tobytes()
    # Chosen from four quarters to cover all colours: the most frequent ones alone would turn thin lines grey.
    judged = np.vstack([np.asarray(images[number]) for number in range(0, len(images), max(len(images) // 4, 1))])
    chosen = Image.fromarray(judged).quantize(255 - len(scale) // 3, method=Image.Quantize.MAXCOVERAGE).getpalette()
    palette = Image.new("P", (1, 1))
    palette.putpalette(scale + bytes(chosen or ()))
    first, *others = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    time = 10 * max(round(100.0 * seconds / len(images)), 2)
    first.save(path, save_all=True, append_images=others, duration=time, loop=0, optimize=False, disposal=1)


def label_axes(
    axes: Axes, across: str, up: str, *, legend: Literal["below", "beside", ""] = "below", heading: str = ""
) -> None:
    """Name the axes, with units, and put a legend, which may have a heading, below or at the right."""
    from matplotlib.transforms import ScaledTranslation

    axes.set_xlabel(across)
    axes.set_ylabel(up)
    if legend == "beside":
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), title=heading)
    elif legend:
        assert axes.figure is not None
        lower = axes.transAxes + ScaledTranslation(0.0, -0.55, axes.figure.dpi_scale_trans)
        labels = axes.get_legend_handles_labels()[1]
        longest = max(map(len, labels), default=0)
        columns = 1 if longest > 26 else 3 if len(labels) == 3 and longest <= 13 else 2
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=lower, ncols=columns, title=heading)


def plot_curve(axes: Axes, x: np.ndarray, y: np.ndarray, number: int, label: str) -> None:
    """A curve, with markers at its points where they are few."""
    marker, size = ("o", 5) if len(x) <= 20 else (".", 4) if len(x) <= 200 else (None, 4)
    dashes, colour = DASHES[number // len(COLOURS) % len(DASHES)], COLOURS[number % len(COLOURS)]
    axes.plot(x, y, dashes, color=colour, marker=marker, markersize=size, label=label)


def few(count: int, most: int) -> np.ndarray:
    """Numbers of at most so many of `count` things, evenly spread."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def _label_decades(axis: Axis) -> None:
    """Number a logarithmic axis at its decades; a short one at 2 and 5 besides, which then are the only small ticks."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    if axis.get_scale() != "log":
        return
    low, high = axis.get_view_interval()
    if log10(high / low) >= 2.0:
        axis.set_minor_formatter(NullFormatter())
        return
    plain = FuncFormatter(lambda value, _place: _power(value))
    axis.set_major_formatter(plain)
    axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
    axis.set_minor_formatter(plain)
    axis.set_tick_params(which="minor", length=3.5)


def _power(value: float) -> str:
    if 1e-4 <= value < 1e5:
        return f"{value:g}"
    digit, power = f"{value:.0e}".split("e")
    return rf"${digit}\times10^{{{int(power)}}}$"


class NoRendererError(RuntimeError):
    """Neither an X server nor EGL nor OSMesa can render on this computer."""


def plotter(size: Sequence[int]) -> pyvista.Plotter:
    """A white scene without perspective off the screen, of a size in pixels; VTK itself is silent."""
    # The first one provides the classes that render; VTK tries X, EGL and OSMesa in turn.
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkCommonCore import vtkLogger
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    # Without a library VTK would end the process when it renders.
    if vtkRenderWindow().GetClassName() == "vtkOSOpenGLRenderWindow" and not _has_mesa():
        raise NoRendererError(
            "pictures need a library that renders without a screen: install EGL (libegl1 on Debian and Ubuntu) "
            "or OSMesa (libosmesa6)"
        )
    import pyvista

    scene = pyvista.Plotter(off_screen=True, window_size=list(size))
    scene.set_background("white")
    scene.enable_parallel_projection()
    return scene


def show_image(figure: Figure, scene: pyvista.Plotter, left: float, bottom: float, width: float, height: float) -> None:
    """Render a scene into a rectangle of a page, in inches."""
    axes = figure.add_axes(page_box(figure, left, bottom, width, height))
    axes.set_axis_off()
    axes.imshow(scene.screenshot(return_img=True), aspect="auto")
    scene.close()


def _has_mesa() -> bool:
    for name in ("libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "osmesa.dll", "libOSMesa.dll"):
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return True
    return False
