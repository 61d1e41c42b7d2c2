"""Threads that move, for tests of their motion."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.special import j0, y0
from thread_cases import inputs, results

from hydroelastic.fem.thread.motion import InitialMotion, move_thread
from hydroelastic.fem.thread.motion_plan import MotionPlan
from hydroelastic.fem.thread.motion_results import ThreadMotion
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd


def held(position: Any, **rest: Any) -> ThreadEnd:
    """An end that is held."""
    place = np.array(position, dtype=float)
    return ThreadEnd(load=PointLoad(force=0.0 * place), held=(True,) * len(place), position=place, **rest)


def free(force: Any, **rest: Any) -> ThreadEnd:
    """A free end with a dead force, and what a body there has besides."""
    pull = np.array(force, dtype=float)
    return ThreadEnd(load=PointLoad(force=pull, **rest), held=(False,) * len(pull), position=0.0 * pull)


def chain(dimension: int = 2, **changes: Any) -> Thread:
    """The hanging thread of case D05 with its body, without liquid unless it is given."""
    given = inputs("D05")
    down = np.zeros(dimension)
    down[-1] = -given["W_tip"]
    options: dict[str, Any] = {"weight": given["w"], "mass": given["m"]} | changes
    ends = (held(np.zeros(dimension)), free(down, mass=given["M_tip"]))
    return Thread(dimension=dimension, length=given["L"], ends=ends, **options)


def liquid() -> dict[str, Any]:
    """The still liquid of case D05."""
    given = inputs("D05")
    return {"normal_drag": given["kn"], "tangential_drag": given["kt"], "added_mass": given["ma"]}


def swing(speed: float = 2.5, azimuth: float = 0.0, dimension: int = 2) -> InitialMotion:
    """The hanging chain with velocities of its first mode without liquid."""
    given = inputs("D05")
    omega = CHAIN_OMEGA

    def argument(s: NDArray[np.float64]) -> NDArray[np.float64]:
        return 2.0 * omega * np.sqrt((given["W_tip"] + given["w"] * (1.0 - s)) * given["m"]) / given["w"]

    top = np.array([0.0])
    part = -j0(argument(top)) / y0(argument(top))

    def shape(s: NDArray[np.float64]) -> NDArray[np.float64]:
        values: NDArray[np.float64] = j0(argument(s)) + part * y0(argument(s))
        return values

    across, down = np.zeros(dimension), np.zeros(dimension)
    down[-1] = -1.0
    across[0] = np.cos(azimuth)
    if dimension == 3:
        across[1] = np.sin(azimuth)
    return InitialMotion(
        position=lambda s: np.outer(s, down),
        velocity=lambda s: speed * np.outer(shape(s) / shape(np.array([1.0])), across),
    )


CHAIN_OMEGA = 3.40352409229
"""First frequency of the chain without liquid, as case D05 states it."""


def follow(model: Thread, elements: int, start: InitialMotion, times: Any, step: float, **rest: Any) -> ThreadMotion:
    """The motion on equal elements of second degree."""
    degree = rest.pop("degree", 2)
    comm = rest.pop("comm", MPI.COMM_WORLD)
    plan = MotionPlan(times=np.array(times, dtype=float), step=step, **rest)
    return move_thread(comm, model, np.linspace(0.0, model.length, elements + 1), start, plan, degree=degree)


def tip_of(name: str) -> NDArray[np.float64]:
    """Positions of the tip of a case, shape (times, 2)."""
    return np.array(results(name)["tip"]).reshape(-1, 2)


def extrapolated(coarse: NDArray[np.float64], fine: NDArray[np.float64]) -> NDArray[np.float64]:
    """What two results of second order, the second with halved steps, tend to."""
    return (4.0 * fine - coarse) / 3.0
