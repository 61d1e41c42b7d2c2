"""A flexible thread, its ends, the bodies that it carries, and the stream around it. SI units.

s in [0, L] is the arc length of the unstretched thread and r(s, t) its position, in space (x, y, z) or in a vertical
plane (x, z), the last axis upwards; end A is s = 0, end B is s = L. N = T τ is the force with which the part beyond s
pulls on the part before it, so that a dead force F at end B makes N(L) = F, and at end A N(0) = −F.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf, isfinite
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import Stream
from hydroelastic.physics.thread_load import ThreadLoad

Reactive = Literal["none", "moving_load", "lighthill"]
"""Reaction of the liquid beyond the inertia of the added mass: none, the added mass as a load that moves along the
thread with the stream, or Lighthill's momentum (the gradient of a kinetic energy)."""

StretchDrag = Literal["none", "volume"]
"""Whether the drag follows the diameter of a thread that stretches at constant volume."""


@dataclass(frozen=True, kw_only=True)
class PointLoad:
    """A body at one point of the thread, or a force on it."""

    # dead force on the thread, N, shape (dimension,); zero in space without it
    force: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    weight: float = 0.0  # weight in the liquid, N; negative for a buoy
    drag: float = 0.0  # k = ρ C A/2 in the drag k|u − v|(u − v), N·s²/m²
    mass: float = 0.0  # M, kg, in all directions
    added_mass: float = 0.0  # mass of the liquid that moves along, kg, in all directions

    @property
    def dead_force(self) -> NDArray[np.float64]:
        """Force and weight together, N, shape (dimension,)."""
        down = np.zeros(len(self.force))
        down[-1] = -self.weight
        return down + self.force

    def force_at(self, position: FloatArray, stream: Stream | None) -> FloatArray:
        """Return force, weight and drag on the body at rest, N, shape (3,).

        Args:
            position: of the body, m, shape (3,).
            stream: steady velocity of the liquid; ``None`` for a liquid at rest.
        """
        dead = self.dead_force
        if stream is None or self.drag == 0.0:
            return dead
        velocity = stream.velocity_at(np.asarray(position, dtype=float)[None])[0]
        return np.asarray(dead + self.drag * np.linalg.norm(velocity) * velocity)


@dataclass(frozen=True, kw_only=True)
class ThreadEnd:
    """How an end is held."""

    load: PointLoad  # body at the end and force on it; reactions act along the held components
    held: tuple[bool, ...]  # which components of the position are prescribed, shape (dimension,)
    position: NDArray[np.float64]  # position of the end, m, of which the held components are used, shape (dimension,)
    # unit tangent r_s of a clamped end, dimensionless, shape (dimension,); without it the end is hinged or free. Needs
    # flexural rigidity.
    clamp: NDArray[np.float64] | None = None
    taper: float = 0.0  # dimensionless shape of a free end in a reactive liquid: 0 blunt, 1 tapered to a point

    @classmethod
    def fixed_at(cls, position: Sequence[float], clamp: Sequence[float] | None = None) -> ThreadEnd:
        """Return an end fixed at a position, m, hinged or clamped along a direction of any length; shapes (3,)."""
        direction = None if clamp is None else np.asarray(clamp, dtype=float) / np.linalg.norm(clamp)
        return cls(load=PointLoad(), held=(True,) * 3, position=np.asarray(position, dtype=float), clamp=direction)

    @classmethod
    def free_with(cls, load: PointLoad, *, taper: float = 0.0) -> ThreadEnd:
        """Return a free end that carries a body."""
        return cls(load=load, held=(False,) * 3, position=np.zeros(3), taper=taper)

    @classmethod
    def at_surface(cls, level: float, load: PointLoad) -> ThreadEnd:
        """Return an end kept at a height z, m, by a buoy that drifts."""
        return cls(load=load, held=(False, False, True), position=np.array([0.0, 0.0, level]))

    @property
    def is_fixed(self) -> bool:
        """Whether all components of the position are held."""
        return all(self.held)

    @property
    def is_free(self) -> bool:
        """Whether no component of the position is held."""
        return not any(self.held)


@dataclass(frozen=True, kw_only=True)
class Thread:
    """A thread in a steady stream.

    Raises:
        ValueError: where a number is out of range or shapes do not fit.
    """

    length: float  # L, m, unstretched
    ends: tuple[ThreadEnd, ThreadEnd]  # A and B
    dimension: int = 3  # 3 in space, or 2 in a vertical plane (x, z)
    weight: float = 0.0  # w, weight per length in the liquid, N/m, downwards positive
    axial_rigidity: float = inf  # EA, N; infinite for an inextensible thread
    flexural_rigidity: float = 0.0  # EI, N·m²
    normal_drag: float = 0.0  # kn = ρ Cn d/2 in kn|u_n|u_n, N·s²/m³
    tangential_drag: float = 0.0  # kt = ρ π Ct d/2 in kt|u_t|u_t, N·s²/m³
    viscous_drag: float = 0.0  # nv in nv u_n, N·s/m²
    mass: float = 0.0  # m per length, kg/m
    added_mass: float = 0.0  # ma per length, across the thread, kg/m
    reactive: Reactive = "none"  # reaction of the liquid beyond −ma P r_tt
    # "volume" multiplies both quadratic drags by √|r_s|, for a diameter at constant volume
    stretch_drag: StretchDrag = "none"
    stream: Stream | None = None  # u, ``None`` for a liquid at rest
    loads: dict[float, PointLoad] = field(default_factory=dict)  # bodies between the ends, by s in m
    # given tension at end B, N, of a straight inextensible thread between fixed ends, whose length does not determine
    # it
    tension: float | None = None

    def __post_init__(self) -> None:
        if self.dimension not in (2, 3):
            raise ValueError(f"dimension is {self.dimension}: it must be 2 or 3")
        if not (isfinite(self.length) and self.length > 0.0):
            raise ValueError(f"length is {self.length}: it must be finite and positive")
        if not self.axial_rigidity > 0.0:
            raise ValueError(f"axial_rigidity is {self.axial_rigidity}: it must be positive, or infinite")
        names = ("flexural_rigidity", "normal_drag", "tangential_drag", "viscous_drag", "mass", "added_mass")
        for name in names:
            value = getattr(self, name)
            if not (isfinite(value) and value >= 0.0):
                raise ValueError(f"{name} is {value}: it must be finite and not negative")
        for position in self.loads:
            if not 0.0 < position < self.length:
                raise ValueError(f"loads: {position} is not between 0 and the length {self.length}")
        for load in self.bodies:
            if load.force.shape != (self.dimension,):
                raise ValueError(f"a force has shape {load.force.shape}: it must be ({self.dimension},)")

    @property
    def bodies(self) -> tuple[PointLoad, ...]:
        """All point loads, those between the ends first."""
        return (*self.loads.values(), *(end.load for end in self.ends))

    @property
    def drags(self) -> bool:
        """Whether the thread or one of its bodies has drag."""
        return self.has_line_drag or any(body.drag > 0.0 for body in self.bodies)

    @property
    def has_line_drag(self) -> bool:
        """Whether the thread itself has drag."""
        return self.normal_drag + self.tangential_drag + self.viscous_drag > 0.0

    @property
    def bends(self) -> bool:
        """Whether the thread resists bending."""
        return self.flexural_rigidity > 0.0

    @property
    def distributed_load(self) -> ThreadLoad:
        """Weight and steady drag per length of the unstretched thread, in space."""
        return ThreadLoad(
            weight=self.weight,
            normal_drag=self.normal_drag,
            tangential_drag=self.tangential_drag,
            viscous_drag=self.viscous_drag,
            stream=self.stream,
        )

    def with_stream_factor(self, factor: float) -> Thread:
        """Return the thread with the velocities of its stream multiplied by a factor, 0 for a liquid at rest."""
        if self.stream is None or factor == 1.0:
            return self
        return replace(self, stream=None if factor == 0.0 else self.stream.times(factor))
