"""Request of a motion of a thread, in space and independent of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Literal

from hydroelastic.physics.thread_motion import EndDisplacement, Vector, VortexShedding


@dataclass(frozen=True, kw_only=True)
class MotionRequest:
    """A motion in time.

    Attributes:
        times: at which it is reported, s, increasing from 0 or later.
        start: from the equilibrium, from that in the liquid at rest, or straight and at rest.
        direction: of a straight start, from end A to end B, of any length.
        displacements: of the fixed ends A and B, which add up.
        releases: when A and B are released, s; infinite for never.
        shedding: vortices, if any.
        spectral_radius: of the generalised-α method at infinite frequency; ``None`` for the midpoint rule.
        step: constant step, s; ``None`` for steps that adapt.
        tolerance: error of positions, relative to the length.
    """

    times: tuple[float, ...]
    start: Literal["equilibrium", "still_liquid", "straight"] = "equilibrium"
    direction: Vector = (0.0, 0.0, -1.0)
    displacements: tuple[tuple[EndDisplacement, ...], tuple[EndDisplacement, ...]] = ((), ())
    releases: tuple[float, float] = (inf, inf)
    shedding: VortexShedding | None = None
    spectral_radius: float | None = None
    step: float | None = None
    tolerance: float = 1e-3
