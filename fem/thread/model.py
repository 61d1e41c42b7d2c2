"""A flexible thread, what holds it and what it carries, in any consistent units.

s in [0, L] is the arc length of the thread without stretch, r(s, t) its position in two (x, z) or three dimensions, the
last axis up; end A is s = 0, end B is s = L. N = T τ is the force with which the part beyond s pulls on the part before
it, so that a dead force F at end B makes N(L) = F, and at end A N(0) = −F.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf, isfinite
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

# What of the liquid's reaction is more than the inertia of the added mass: nothing, the added mass as a load that moves
# along the thread with the stream, or Lighthill's momentum (the gradient of a kinetic energy).
Reactive = Literal["none", "moving_load", "lighthill"]
StretchDrag = Literal["none", "volume"]


class Stream(Protocol):
    """Velocity u(r) of the undisturbed liquid, steady."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Heights at which a derivative of u jumps, increasing."""
        ...

    def velocity_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """u at points of shape (n, 3), shape (n, 3)."""
        ...

    def gradient_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """∂u_i/∂x_j at points of shape (n, 3), shape (n, 3, 3)."""
        ...


@dataclass(frozen=True, kw_only=True)
class PointLoad:
    """What the thread carries at one point.

    Attributes:
        force: dead force on the thread, weight less buoyancy among it, shape (dimension,).
        drag: k in k|u − v|(u − v).
        mass: M, in all directions.
        added_mass: of the liquid that moves along, in all directions.
    """

    force: NDArray[np.float64]
    drag: float = 0.0
    mass: float = 0.0
    added_mass: float = 0.0


@dataclass(frozen=True, kw_only=True)
class ThreadEnd:
    """How an end is held.

    Attributes:
        load: what it carries; the components that are held take their reactions besides.
        held: which components of the position are given, shape (dimension,).
        position: the end's position, of which the held components are asked, shape (dimension,).
        clamp: unit tangent r_s in which the end is clamped; hinged or free without it. Needs flexural rigidity.
        taper: of a free end in a reactive liquid: 0 blunt, 1 tapered to nothing.
    """

    load: PointLoad
    held: tuple[bool, ...]
    position: NDArray[np.float64]
    clamp: NDArray[np.float64] | None = None
    taper: float = 0.0


@dataclass(frozen=True, kw_only=True)
class ThreadModel:
    """A thread in a steady stream.

    Attributes:
        dimension: 2 (x, z) or 3.
        length: L.
        ends: A and B.
        weight: w, submerged, per length, down positive.
        axial_rigidity: EA; infinite for a thread that does not stretch.
        flexural_rigidity: EI.
        normal_drag: kn = ρ Cn d/2 in kn|u_n|u_n.
        tangential_drag: kt = ρ π Ct d/2 in kt|u_t|u_t.
        viscous_drag: nv in nv u_n.
        mass: m per length.
        added_mass: ma per length, across the thread.
        reactive: what of the liquid's reaction is more than −ma P r_tt.
        stretch_drag: "volume" multiplies both drags by √|r_s|, for a diameter that keeps the volume.
        stream: u, nothing for a liquid at rest.
        loads: what hangs on the thread between its ends, by s.

    Raises:
        ValueError: where a number is out of range or shapes do not fit.
    """

    dimension: int
    length: float
    ends: tuple[ThreadEnd, ThreadEnd]
    weight: float = 0.0
    axial_rigidity: float = inf
    flexural_rigidity: float = 0.0
    normal_drag: float = 0.0
    tangential_drag: float = 0.0
    viscous_drag: float = 0.0
    mass: float = 0.0
    added_mass: float = 0.0
    reactive: Reactive = "none"
    stretch_drag: StretchDrag = "none"
    stream: Stream | None = None
    loads: dict[float, PointLoad] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse what is no thread."""
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
        for load in (*self.loads.values(), *(end.load for end in self.ends)):
            if load.force.shape != (self.dimension,):
                raise ValueError(f"a force has shape {load.force.shape}: it must be ({self.dimension},)")

    @property
    def drags(self) -> bool:
        """Whether the liquid drags at the thread or at what it carries."""
        bodies = (*self.loads.values(), *(end.load for end in self.ends))
        return self.normal_drag + self.tangential_drag + self.viscous_drag + sum(body.drag for body in bodies) > 0.0

    @property
    def bends(self) -> bool:
        """Whether the thread resists bending."""
        return self.flexural_rigidity > 0.0


@dataclass(frozen=True)
class _ScaledStream:
    """A stream in other units of length and time."""

    stream: Stream
    length: float
    time: float

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(height / self.length for height in self.stream.breaks)

    def velocity_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.stream.velocity_at(points * self.length) * (self.time / self.length)

    def gradient_at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.stream.gradient_at(points * self.length) * self.time


@dataclass(frozen=True, kw_only=True)
class Units:
    """Units in which a thread is solved.

    Attributes:
        length: m.
        force: N.
        time: s.
    """

    length: float
    force: float
    time: float = 1.0

    @property
    def mass(self) -> float:
        """kg."""
        return self.force * self.time**2 / self.length

    def scaled(self, model: ThreadModel) -> ThreadModel:
        """The same thread in these units."""
        length, force, time = self.length, self.force, self.time
        drag = force * time**2 / length**3
        return replace(
            model,
            length=model.length / length,
            ends=(self._end(model.ends[0]), self._end(model.ends[1])),
            weight=model.weight * length / force,
            axial_rigidity=model.axial_rigidity / force,
            flexural_rigidity=model.flexural_rigidity / (force * length**2),
            normal_drag=model.normal_drag / drag,
            tangential_drag=model.tangential_drag / drag,
            viscous_drag=model.viscous_drag * length**2 / (force * time),
            mass=model.mass * length / self.mass,
            added_mass=model.added_mass * length / self.mass,
            stream=None if model.stream is None else _ScaledStream(model.stream, length, time),
            loads={position / length: self._load(load) for position, load in model.loads.items()},
        )

    def _load(self, load: PointLoad) -> PointLoad:
        return PointLoad(
            force=np.asarray(load.force / self.force, dtype=np.float64),
            drag=load.drag * self.length**2 / (self.force * self.time**2),
            mass=load.mass / self.mass,
            added_mass=load.added_mass / self.mass,
        )

    def _end(self, end: ThreadEnd) -> ThreadEnd:
        return replace(
            end, load=self._load(end.load), position=np.asarray(end.position / self.length, dtype=np.float64)
        )
