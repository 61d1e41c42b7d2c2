"""Animations: pages of one size as a GIF file that repeats itself."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from PIL import Image

FRAMES = 24
"""Pages of a period of an animation."""
SECONDS = 1.92
"""That a period of an animation lasts on the screen."""

# Colours of large areas that are kept as they are, besides those that are asked for. One of the 256 colours of a GIF
# file stands for what does not change from page to page.
_FREQUENT, _ALL = 40, 255
# Pages from which the colours are chosen; those of a motion to and fro are all among four quarters of it.
_JUDGED = 4


def write_gif(
    pages: Sequence[NDArray[np.uint8]], path: Path, *, seconds: float, kept: NDArray[np.float64] | None = None
) -> None:
    """Write pages one after the other, with the same colours for all.

    Args:
        pages: shape (height, width, 3) each, red, green, blue in 0…255; two or more.
        path: of the file in an existing folder.
        seconds: that all pages together last; a page lasts whole hundredths of a second.
        kept: up to 150 colours that mean something, red, green, blue in 0…1, shape (colours, 3).
    """
    from PIL import Image

    chosen = np.linspace(0, len(pages), min(_JUDGED, len(pages)), endpoint=False).astype(int)
    colours = np.empty((0, 3)) if kept is None else kept
    palette = _palette(np.vstack([pages[place] for place in chosen]), np.round(255.0 * colours).astype(np.uint8))
    # Without dithering a colour that stays is the same on all pages.
    images = [Image.fromarray(page).quantize(palette=palette, dither=Image.Dither.NONE) for page in pages]
    hundredths = max(round(100.0 * seconds / len(pages)), 2)
    images[0].save(
        path, save_all=True, append_images=images[1:], duration=10 * hundredths, loop=0, optimize=False, disposal=1
    )


def _palette(pixels: NDArray[np.uint8], kept: NDArray[np.uint8]) -> Image.Image:
    """An image that holds the colours to use: those kept, frequent ones, and what stands for all others.

    Of the others each counts like the root of its area: thin lines keep their colours.
    """
    from PIL import Image

    red, green, blue = np.moveaxis(pixels.astype(np.uint32), 2, 0)
    packed, count = np.unique((red << 16) + (green << 8) + blue, return_counts=True)
    order = np.argsort(-count, kind="stable")
    distinct = np.stack([packed >> 16, packed >> 8 & 255, packed & 255], axis=1).astype(np.uint8)[order]
    colours = np.concatenate([distinct[:_FREQUENT], kept])
    if len(distinct) > _FREQUENT:
        weights = np.ceil(np.sqrt(count[order][_FREQUENT:])).astype(int)
        room = _ALL - len(colours)
        shared = Image.fromarray(distinct[_FREQUENT:].repeat(weights, axis=0)[None]).quantize(room)
        colours = np.concatenate([colours, np.array(shared.getpalette(), dtype=np.uint8).reshape(-1, 3)[:room]])
    palette = Image.new("P", (1, 1))
    palette.putpalette(colours.ravel().tobytes())
    return palette
