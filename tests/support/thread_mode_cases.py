"""Threads about whose equilibria the tests look at small motions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.straight import straight_equilibrium
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import PointLoad, Reactive, Thread, ThreadEnd

COMM = MPI.COMM_WORLD


def straight_thread(
    direction: tuple[float, ...] = (1.0, 0.0),
    *,
    length: float = 1.0,
    clamped: tuple[bool, bool] = (False, False),
    held: tuple[bool, bool] = (True, True),
    load: PointLoad | None = None,
    taper: float = 0.0,
    **options: Any,
) -> Thread:
    """A thread from the origin in a direction, `load` at its end B."""
    along = np.array(direction)

    def end(number: int) -> ThreadEnd:
        carried = load if number == 1 and load is not None else PointLoad(force=np.zeros(len(along)))
        return ThreadEnd(
            load=carried,
            held=(held[number],) * len(along),
            position=number * length * along,
            clamp=along if clamped[number] else None,
            taper=taper if number == 1 else 0.0,
        )

    return Thread(dimension=len(along), length=length, ends=(end(0), end(1)), **options)


def in_axial_flow(speed: float, share: float, reactive: Reactive = "lighthill", **options: Any) -> Thread:
    """A thread of unit length and EI along x in a stream along it, U L √(M/EI) = `speed`, M/(m + M) = `share`."""
    return straight_thread(
        mass=1.0 - share,
        added_mass=share,
        flexural_rigidity=1.0,
        reactive=reactive,
        stream=UniformStream((speed / np.sqrt(share), 0.0, 0.0)),
        **options,
    )


def straight_pair(
    model: Thread,
    tension: float | Callable[[NDArray[np.float64]], NDArray[np.float64]],
    elements: int = 40,
    degree: int = 3,
) -> tuple[Equilibrium, Equilibrium]:
    """The straight equilibrium on a mesh and on one half as fine."""
    fine, coarse = (
        straight_equilibrium(COMM, model, np.linspace(0.0, model.length, count + 1), tension, degree=degree)
        for count in (elements, elements // 2)
    )
    return fine, coarse
