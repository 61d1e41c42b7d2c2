"""Results of all analyses of a thread."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.resting_thread import RestingThread
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.physics.thread import Thread


@dataclass(frozen=True, kw_only=True)
class ThreadAnalyses:
    """Results of all analyses of a thread."""

    thread: Thread  # in SI units
    frame: Frame  # coordinates of the model
    rest: RestingThread  # the equilibrium
    modes: tuple[ThreadModes, ...]  # of each analysis of modes
    stability: tuple[Stability, ...]  # of each analysis of stability
    motions: tuple[MotionInSpace, ...]  # of each analysis of motion
    size: dict[str, int]  # cells, degree and unknowns of the equilibrium, steps of motions
