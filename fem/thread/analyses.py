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
    """Results of all analyses of a thread.

    Attributes:
        thread: in SI units.
        frame: coordinates of the model.
        rest: the equilibrium.
        modes: of each analysis of modes.
        stability: of each analysis of stability.
        motions: of each analysis of motion.
        size: cells, degree and unknowns of the equilibrium, steps of motions.
    """

    thread: Thread
    frame: Frame
    rest: RestingThread
    modes: tuple[ThreadModes, ...]
    stability: tuple[Stability, ...]
    motions: tuple[MotionInSpace, ...]
    size: dict[str, int]
