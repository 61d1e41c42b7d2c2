"""One style for all pictures of curves, and the files they are written to."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import log10
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any, Literal
from warnings import catch_warnings, filterwarnings

import numpy as np

from hydroelastic.output.pictures.colours import BLUE, GREEN, ORANGE, PURPLE, SEQUENCE, SKY, VERMILLION, part_of_colours
from hydroelastic.output.pictures.options import DEFAULT_PICTURES, PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
DASHES = ("-", "--", "-.", ":")
GREY = "#555555"
"""Of what is beside the curves: theory, limits, notes."""
SHADE = "#dddddd"
"""Of what lies behind the curves."""

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
    "axes.grid.which": "major",
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 5),
    "axes.formatter.use_mathtext": True,
    "grid.color": SHADE,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "lines.markersize": 5.0,
    # Text in SVG and PDF is stored as text, which can be searched, copied and edited.
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    # Reproducible names inside SVG files.
    "svg.hashsalt": "hydroelastic",
}
# Without the time of writing, files of the same curves are the same.
_METADATA: dict[str, dict[str, Any]] = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}
# Letters of the title's size to an inch.
_LETTERS_PER_INCH = 8.5
# From the axes down to a legend: room for numbers and the name of the axis.
_LEGEND_BELOW = 0.55
# Labels of more letters do not stand two in a row.
_LONG = 26
# Curves with up to this number of points show markers.
_FEW, _SOME = 20, 200
# Axes of fewer decades have numbers at 2 and 5 besides.
_SHORT_AXIS = 2.0
# Length of a tick that has a number, points.
_TICK = 3.5


@contextmanager
def curve_style() -> Iterator[None]:
    """Draw in the style of the project, independently of the user's settings of matplotlib."""
    from matplotlib import style

    with style.context(["default", _STYLE]):
        yield


@dataclass(frozen=True, kw_only=True)
class Sheets:
    """Pictures of curves, in a folder.

    Attributes:
        folder: an existing folder.
        title: what all pictures are of; empty for none.
        options: formats, resolution and scale.
    """

    folder: Path
    title: str
    options: PictureOptions = DEFAULT_PICTURES

    @contextmanager
    def sheet(self, name: str, heading: str, *, width: float, height: float = 5.4) -> Iterator[Figure]:
        """Provide a figure to draw into; at the end of the block it is written as ``<name>.png`` and so on."""
        from matplotlib.figure import Figure

        width, height = width * self.options.scale, height * self.options.scale
        title = _title(self.title, heading, round(_LETTERS_PER_INCH * width))
        with curve_style():
            figure = Figure(figsize=(width, height), layout="constrained")
            yield figure
            # A dollar sign would begin a formula.
            figure.suptitle(title, parse_math=False)
            for axes in figure.axes:
                _label_decades(axes.xaxis)
                _label_decades(axes.yaxis)
            for kind in self.options.formats:
                path = self.folder / f"{name}.{kind}"
                metadata = {"Title": " ".join(title.split())} | _METADATA[kind]
                with catch_warnings():
                    # Where long labels leave no room, matplotlib warns and draws them over each other.
                    filterwarnings("ignore", message="constrained_layout not applied", category=UserWarning)
                    figure.savefig(path, dpi=self.options.dpi, metadata=metadata)


def _title(title: str, heading: str, letters: int) -> str:
    """The title and the heading, wrapped to lines of at most this number of letters."""
    if not title:
        return fill(heading[:1].upper() + heading[1:], letters)
    together = f"{title}: {heading}"
    return together if len(together) <= letters else f"{fill(title, letters)}\n{fill(heading, letters)}"


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
        lower = axes.transAxes + ScaledTranslation(0.0, -_LEGEND_BELOW, axes.figure.dpi_scale_trans)
        labels = axes.get_legend_handles_labels()[1]
        longest = max(map(len, labels), default=0)
        columns = 1 if longest > _LONG else 3 if len(labels) == 3 and longest <= _LONG // 2 else 2
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=lower, ncols=columns, title=heading)


def plot_curve(axes: Axes, x: np.ndarray, y: np.ndarray, number: int, label: str) -> None:
    """A curve, with markers at its points where they are few."""
    axes.plot(
        x,
        y,
        DASHES[number // len(COLOURS) % len(DASHES)],
        color=COLOURS[number % len(COLOURS)],
        marker="o" if len(x) <= _FEW else "." if len(x) <= _SOME else None,
        markersize=5 if len(x) <= _FEW else 4,
        label=label,
    )


def sequence_colours(count: int) -> list[tuple[float, float, float, float]]:
    """Colours of curves in an order, from light to dark."""
    shades = part_of_colours(SEQUENCE, 0.9, 0.0)
    return [shades(place / max(count - 1, 1)) for place in range(count)]


def _label_decades(axis: Axis) -> None:
    """Number a logarithmic axis at its decades; a short one at 2 and 5 besides, which then are the only small ticks."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    if axis.get_scale() != "log":
        return
    low, high = axis.get_view_interval()
    if log10(high / low) >= _SHORT_AXIS:
        axis.set_minor_formatter(NullFormatter())
        return
    plain = FuncFormatter(lambda value, _place: _power(value))
    axis.set_major_formatter(plain)
    axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
    axis.set_minor_formatter(plain)
    axis.set_tick_params(which="minor", length=_TICK)


def _power(value: float) -> str:
    """A number in decimal notation, or with a power of ten where it is very small or large."""
    if 1e-4 <= value < 1e5:
        return f"{value:g}"
    digit, power = f"{value:.0e}".split("e")
    return rf"${digit}\times10^{{{int(power)}}}$"
