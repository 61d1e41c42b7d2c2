"""Scales of colours that colour-blind readers can tell apart: one with two signs, one from little to much."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.pictures.shapes import Array

# The diverging scheme PRGn of ColorBrewer, by Cynthia Brewer, at equal steps.
_PURPLE_GREEN = (
    "40004b", "762a83", "9970ab", "c2a5cf", "e7d4e8", "f7f7f7", "d9f0d3", "a6dba0", "5aae61", "1b7837", "00441b",
)  # fmt: skip


def mode_colours() -> Array:
    """Colours of ψ from negative to positive, shape (256, 3): purple, white, green, distinct for colour-blind readers.

    Blue and orange stay free for the surfaces. The ends are left out: they are too dark for vectors and lines.
    """
    known = np.array([rgb(f"#{colour}") for colour in _PURPLE_GREEN])
    at = np.linspace(0.0, 1.0, len(known))
    return np.column_stack([np.interp(np.linspace(0.17, 0.83, 256), at, channel) for channel in known.T])


def magnitude_colours() -> Array:
    """Colours from small to large, shape (256, 3): viridis, whose lightness grows in equal steps."""
    from matplotlib import colormaps

    return np.asarray(colormaps["viridis"](np.arange(256))[:, :3])


def rgb(colour: str) -> Array:
    """Red, green, blue in 0…1 of a colour like #0a58a8."""
    return np.array([int(colour[place : place + 2], 16) / 255.0 for place in (1, 3, 5)])
