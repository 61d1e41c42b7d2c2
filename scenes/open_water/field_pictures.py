"""The waves of open water as pictures, and as animations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hydroelastic.fem.open_water.field_samples import SampledField
from hydroelastic.fem.pictures.gif import FRAMES
from hydroelastic.fem.pictures.modes import Canvas, animate_motion, draw_mode, phase_words
from hydroelastic.fem.pictures.options import PictureOptions

_PREFIX = "waves_"


def draw_fields(fields: Sequence[SampledField], folder: Path, options: PictureOptions) -> None:
    """Draw each field at t = 0 as ``waves_<name>.png``, and a period of it as ``waves_<name>.gif`` if asked.

    A motion that dies out is animated as if it did not: it goes on without a jump.
    """
    if not fields:
        return
    with Canvas() as canvas:
        for field in fields:
            largest = field.picture.largest
            path = folder / f"{_PREFIX}{field.name}.png"
            draw_mode(field.picture.at(0.0), path, width=options.width, canvas=canvas, largest=largest)
            if options.animate:
                instants = [
                    replace(field.picture.at(part), title=f"{largest.title}, {phase_words(part)}")
                    for part in np.arange(FRAMES) / FRAMES
                ]
                path = path.with_suffix(".gif")
                animate_motion(instants, largest, path, width=options.animation_width, canvas=canvas)
