"""Dimensionless form of a thread."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.physics.stream import ScaledStream
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd


@dataclass(frozen=True, kw_only=True)
class Units:
    """Units of length, force and time that make a thread dimensionless."""

    length: float  # m
    force: float  # N
    time: float = 1.0  # s

    @property
    def mass(self) -> float:
        """kg."""
        return self.force * self.time**2 / self.length

    def scaled(self, model: Thread) -> Thread:
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
            stream=None if model.stream is None else ScaledStream(model.stream, length, time),
            loads={position / length: self._load(load) for position, load in model.loads.items()},
            tension=None if model.tension is None else model.tension / force,
        )

    def _load(self, load: PointLoad) -> PointLoad:
        return PointLoad(
            force=np.asarray(load.force / self.force, dtype=np.float64),
            weight=load.weight / self.force,
            drag=load.drag * self.length**2 / (self.force * self.time**2),
            mass=load.mass / self.mass,
            added_mass=load.added_mass / self.mass,
        )

    def _end(self, end: ThreadEnd) -> ThreadEnd:
        return replace(
            end, load=self._load(end.load), position=np.asarray(end.position / self.length, dtype=np.float64)
        )
