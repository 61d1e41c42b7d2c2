"""The motion of the upper end in a scene of a hanging string, in SI units; `string.physical` is the string."""

from __future__ import annotations

import numpy as np

from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step, TabulatedMotion, tabulated
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.models.string_parts import RampMotion, SineMotion, SmoothMotion, StepMotion, TableMotion


def end_motion(scene: StringScene) -> Ramp | Sine | Smooth | Step | TabulatedMotion:
    """Return the motion of the upper end."""
    motion = scene.motion
    if isinstance(motion, RampMotion):
        return Ramp(speed=motion.speed)
    if isinstance(motion, SineMotion):
        return Sine(amplitude=motion.amplitude, omega=motion.omega)
    if isinstance(motion, SmoothMotion):
        return Smooth(amplitude=motion.amplitude, rate=motion.rate)
    if isinstance(motion, StepMotion):
        return Step(amplitude=motion.amplitude)
    assert isinstance(motion, TableMotion)
    assert scene.table is not None
    table = np.array(scene.table)
    return tabulated(table[:, 0], table[:, 1], interpolation=motion.interpolation)
