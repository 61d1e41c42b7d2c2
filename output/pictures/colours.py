"""Colours that colour-blind readers can tell apart: of curves, of tanks, and scales of them."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.colors import ListedColormap

# Okabe and Ito's colours; curves differ in dashes or markers besides.
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"

INK, GREY = "#1a1a1a", "#5a5a5a"
FREE_SURFACE, INTERFACE, BODY, BODY_EDGE = "#0a58a8", "#00747c", "#d9660a", "#5c2a00"
LOWER_WASH, UPPER_WASH = "#bcd7ef", "#f0dca4"
"""Of liquids beyond their still levels."""
SEQUENCE = "viridis"
"""Of values from small to large: its lightness grows in equal steps."""

# Equal steps of a scale.
_SHADES = 256


@cache
def mode_colours() -> ListedColormap:
    """Colours of ψ from negative to positive: purple, white, green of ColorBrewer's scheme PRGn.

    Blue and orange stay free for the surfaces. The ends are left out: they are too dark for vectors and lines.
    """
    return part_of_colours("PRGn", 0.17, 0.83)


def diverging_colours(low: float, high: float) -> ListedColormap:
    """Colours from blue at −1 by white at 0 to red at 1, or the part of them from `low` to `high`."""
    return part_of_colours("RdBu_r", 0.5 + 0.5 * low, 0.5 + 0.5 * high)


def part_of_colours(name: str, first: float, last: float) -> ListedColormap:
    """A part of one of matplotlib's scales, whose ends are at 0 and 1."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    return ListedColormap(colormaps[name](np.linspace(first, last, _SHADES))[:, :3])
