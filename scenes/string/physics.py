"""The motion of the upper end of a hanging string, from the words of a scene."""

from __future__ import annotations

import numpy as np

from hydroelastic.physics.string_motions import Given, Ramp, Sine, Smooth, Step, tabulated
from hydroelastic.scenes.models.string import RampMotion, SineMotion, SmoothMotion, StepMotion, StringScene, TableMotion


def end_motion(scene: StringScene) -> Ramp | Sine | Smooth | Step | Given:
    """Return how the upper end moves."""
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
