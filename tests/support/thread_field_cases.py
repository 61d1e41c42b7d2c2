"""Reference cases of a flexible thread as models of the field solution, and where to begin with them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from thread_cases import inputs, load_of, stream_of

from hydroelastic.fem.thread.equilibrium import Start
from hydroelastic.modal.thread.catenary import catenary_between
from hydroelastic.modal.thread.march import march_back, march_tail
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd


def axes_of(dimension: int) -> list[int]:
    """Which of x, y, z there are."""
    return [0, 2] if dimension == 2 else [0, 1, 2]


def held_at(position: Any, clamp: Any = None) -> ThreadEnd:
    """An end that is fixed."""
    place = np.array(position, dtype=float)
    return ThreadEnd(load=PointLoad(force=np.zeros(len(place))), held=(True,) * len(place), position=place, clamp=clamp)


def free_with(force: Any, drag: float = 0.0, taper: float = 0.0) -> ThreadEnd:
    """An end that nothing holds."""
    pull = np.array(force, dtype=float)
    return ThreadEnd(
        load=PointLoad(force=pull, drag=drag), held=(False,) * len(pull), position=np.zeros(len(pull)), taper=taper
    )


def model_of(name: str, dimension: int = 2, **changes: Any) -> Thread:
    """The thread of a reference case."""
    given = inputs(name)
    axes = axes_of(dimension)
    clamp = np.array(given["clamp_A"], dtype=float)[axes] if "clamp_A" in given else None
    first = held_at(np.array(given.get("A", [0, 0, 0]), dtype=float)[axes], clamp)
    if "B" in given:
        second = held_at(np.array(given["B"], dtype=float)[axes])
    elif "body_B" in given:
        second = free_with(np.array([0, 0, given["body_B"]["net_buoyancy"]])[axes], given["body_B"]["kb"])
    elif "T_B" in given:
        angle = given["phi_B"]
        second = free_with(given["T_B"] * np.array([np.cos(angle), 0.0, np.sin(angle)])[axes])
    else:
        second = free_with(np.array(given["F_B"], dtype=float)[axes])
    options: dict[str, Any] = {
        "dimension": dimension,
        "length": given["L"],
        "ends": (first, second),
        "weight": given["w"],
        "axial_rigidity": given.get("EA", np.inf),
        "flexural_rigidity": given.get("EI", 0.0),
        "normal_drag": given["kn"],
        "tangential_drag": given["kt"],
        "added_mass": given.get("ma", 0.0),
        "reactive": given.get("ma_reactive", "none"),
        "stream": stream_of(name),
    }
    return Thread(**(options | changes))


def start_of(name: str, dimension: int = 2) -> Start:
    """A catenary between held ends, a march from a free one, a straight line where the thread bends."""
    given = inputs(name)
    axes = axes_of(dimension)
    if "EI" in given:
        line = np.array(given["clamp_A"], dtype=float)[axes]
        return Start(position=lambda s: np.outer(s, line), force=np.zeros_like)
    load = load_of(name)
    if "B" in given:
        a, b = (np.array(given[end], dtype=float) for end in "AB")
        chord = (b - a) / np.linalg.norm(b - a)
        whole = load.load((a + b)[None] / 2, chord[None])[0]
        return start_by(lambda s: catenary_between(a, b, given["L"], whole, s), dimension)
    force: Any = given.get("F_B")
    if "body_B" in given:
        stream = stream_of(name)
        assert stream is not None

        def force(place: NDArray[np.float64]) -> NDArray[np.float64]:
            velocity = stream.velocity_at(place[None])[0]
            drag = given["body_B"]["kb"] * np.linalg.norm(velocity) * velocity
            return np.array([0.0, 0.0, given["body_B"]["net_buoyancy"]]) + drag

    if "T_B" in given:
        angle = given["phi_B"]
        force = given["T_B"] * np.array([np.cos(angle), 0.0, np.sin(angle)])
    if callable(force) or np.any(force):
        return start_by(march_back(load, given["L"], force, tolerance=1e-6).at, dimension)
    return start_by(march_tail(load, given["L"], tolerance=1e-6).at, dimension)


def start_by(shape: Any, dimension: int) -> Start:
    """A start from a shape in space by s."""
    axes = axes_of(dimension)

    def at(s: NDArray[np.float64]) -> ThreadShape:
        found: ThreadShape = shape(s)
        return found

    return Start(position=lambda s: at(s).positions[:, axes], force=lambda s: at(s).tensions)
