"""The waves of open water as pictures, and as animations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hydroelastic.fem.open_water.field_samples import SampledField
from hydroelastic.output.pictures.gif import FRAMES
from hydroelastic.output.pictures.modes import animate_motion, draw_mode, phase_words
from hydroelastic.output.pictures.options import PictureOptions

_PREFIX = "waves_"


def draw_fields(fields: Sequence[SampledField], folder: Path, options: PictureOptions) -> None:
    """Draw each field at t = 0 as ``waves_<name>.png``, and a period of it as ``waves_<name>.gif`` if asked.

    A motion that dies out is animated as if it did not: it goes on without a jump.
    """
    for field in fields:
        largest = field.picture.largest
        path = folder / f"{_PREFIX}{field.name}.png"
        draw_mode(field.picture.at(0.0), path, width=options.width, largest=largest)
        if options.animate:
            instants = [
                replace(field.picture.at(part), title=f"{largest.title}, {phase_words(part)}")
                for part in np.arange(FRAMES) / FRAMES
            ]
            animate_motion(instants, largest, path.with_suffix(".gif"), width=options.animation_width)
