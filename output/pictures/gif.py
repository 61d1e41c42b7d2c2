"""Animations: pages of one size as a GIF file that repeats itself."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.colors import Colormap

FRAMES = 24
"""Pages of a period of an animation."""
SECONDS = 1.92
"""That a period of an animation lasts on the screen."""

# One of the 256 colours of a GIF file stands for what does not change from page to page.
_COLOURS = 255
# Pages from which the colours are chosen; those of a motion to and fro are all among four quarters of it.
_JUDGED = 4


def write_gif(pages: Sequence[NDArray[np.uint8]], path: Path, *, seconds: float, kept: Colormap | None = None) -> None:
    """Write pages one after the other, with the same colours for all."""
    from PIL import Image

    colours = b"" if kept is None else kept(np.arange(0, 256, 2), bytes=True)[:, :3].tobytes()
    chosen = np.linspace(0, len(pages), min(_JUDGED, len(pages)), endpoint=False).astype(int)
    judged = Image.fromarray(np.vstack([pages[place] for place in chosen])).convert("RGB")
    # Chosen to cover all colours: the most frequent ones alone would turn thin lines grey.
    others = judged.quantize(_COLOURS - len(colours) // 3, method=Image.Quantize.MAXCOVERAGE).getpalette()
    assert others is not None
    palette = Image.new("P", (1, 1))
    palette.putpalette(colours + bytes(others))
    # Without dithering a colour that stays is the same on all pages.
    images = [
        Image.fromarray(page).convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE) for page in pages
    ]
    hundredths = max(round(100.0 * seconds / len(pages)), 2)
    images[0].save(
        path, save_all=True, append_images=images[1:], duration=10 * hundredths, loop=0, optimize=False, disposal=1
    )
