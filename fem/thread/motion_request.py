"""Request of a motion of a thread, in space and independent of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Literal

from hydroelastic.physics.thread_motion import EndDisplacement, Vector, VortexShedding


@dataclass(frozen=True, kw_only=True)
class MotionRequest:
    """A motion in time."""

    times: tuple[float, ...]  # at which it is reported, s, increasing from 0 or later
    # from the equilibrium, from that in the liquid at rest, or straight and at rest
    start: Literal["equilibrium", "still_liquid", "straight"] = "equilibrium"
    direction: Vector = (0.0, 0.0, -1.0)  # of a straight start, from end A to end B, of any length
    # of the fixed ends A and B, which add up
    displacements: tuple[tuple[EndDisplacement, ...], tuple[EndDisplacement, ...]] = ((), ())
    releases: tuple[float, float] = (inf, inf)  # when A and B are released, s; infinite for never
    shedding: VortexShedding | None = None  # vortices, if any
    # of the generalised-α method at infinite frequency; ``None`` for the midpoint rule
    spectral_radius: float | None = None
    step: float | None = None  # constant step, s; ``None`` for steps that adapt
    tolerance: float = 1e-3  # error of positions, relative to the length
