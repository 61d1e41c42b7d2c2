"""Threads as scenes: reference cases, what is known of them, and shapes by marching or shooting, without elements."""

from __future__ import annotations

from math import inf, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray
from thread_cases import inputs
from thread_shooting import shoot

import hydroelastic as he
from hydroelastic.modal.thread.march import march_back, march_tail
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.stream import ShearedStream, Stream, TabulatedStream, VeeringStream
from hydroelastic.physics.thread_load import ThreadLoad

Floats = NDArray[np.float64]
Document = dict[str, Any]

DENSITY, DIAMETER = 1025.0, 0.024


def fixed(*position: float, **more: Any) -> Document:
    """An end held at (x, y, z), of which the last may be left out."""
    return {"kind": "fixed", "position": [*map(float, position), 0.0, 0.0, 0.0][:3], **more}


def free(**more: Any) -> Document:
    return {"kind": "free", **more}


def scene(thread: Document, b: Document, *analysis: Document, a: Document | None = None, **parts: Any) -> Document:
    """A thread held at the origin, unless another end A is given."""
    ends = {"a": a or fixed(), "b": b}
    parts = {"output": {"frames": 0}} | parts
    return {"kind": "thread", "thread": {"weight": 0.0, **thread}, "ends": ends, "analysis": [*analysis], **parts}


def coefficients(given: Document) -> Document:
    """Drag and added mass per length of a case as those of a line of one diameter, and its masses."""
    area = 0.25 * pi * DENSITY * DIAMETER**2
    return {
        "diameter": DIAMETER,
        "normal_drag": 2.0 * given.get("kn", 0.0) / (DENSITY * DIAMETER),
        "tangential_drag": 2.0 * given.get("kt", 0.0) / (pi * DENSITY * DIAMETER),
        "added_mass": given.get("ma", given.get("M", 0.0)) / area,
        "mass": given.get("m", 0.0),
    }


def case(name: str, *analysis: Document, tolerance: float = 1e-8) -> Document:
    """A case of the catalogue."""
    given = inputs(name)
    current = given["current"]
    stream: Document = {"density": DENSITY}
    if current["type"] == "uniform":
        stream["velocity"] = current["U"][:2]
    elif current["type"] == "linear":
        stream |= {"velocity": current["U0"][:2], "shear": current["G"][:2]}
    elif current["type"] == "veer":
        stream["veer"] = {"speed": current["U"], "rate": current["rate"]}
    thread = {"length": given["L"], "weight": given["w"], "axial_rigidity": given.get("EA"), **coefficients(given)}
    thread |= {"reactive": given.get("ma_reactive", "none"), "flexural_rigidity": given.get("EI", 0.0)}
    first = fixed(*given.get("A", ()))
    if "clamp_A" in given:
        first["clamp"] = given["clamp_A"]
    if "B" in given:
        second = fixed(*given["B"])
    elif "body_B" in given:
        body = given["body_B"]
        second = free(weight=-body["net_buoyancy"], drag_area=2.0 * body["kb"] / DENSITY)
    elif "T_B" in given:
        angle = given["phi_B"]
        second = free(force=[given["T_B"] * np.cos(angle), 0.0, given["T_B"] * np.sin(angle)])
    else:
        second = free(force=given["F_B"], mass=given.get("M_tip", 0.0))
    output = {"positions": [0.0, 0.5 * given["L"], given["L"]]}
    return scene(thread, second, *analysis, a=first, stream=stream, output=output, accuracy={"tolerance": tolerance})


def along(document: Document, places: Any, tolerance: float | None = None) -> he.Result:
    """Solve a scene, and report it at places along the thread."""
    changes: Document = {"output": {"positions": [float(place) for place in places], "frames": 0}}
    if tolerance is not None:
        changes["accuracy"] = {"tolerance": tolerance}
    return he.solve(document | changes)


def roots(result: he.Result, kind: str = "oscillating", analysis: int = 0) -> NDArray[np.complex128]:
    """Roots λ of the free motions of an analysis."""
    modes = result.summary["modes"][analysis][kind]
    return np.array([complex(-mode["decay"], mode["damped_omega"]) for mode in modes])


def load_on(document: Document) -> ThreadLoad:
    """What acts on the thread of a scene, per length."""
    thread, liquid = document["thread"], document.get("stream", {"density": 0.0})
    area = liquid["density"] * thread.get("diameter", 0.0)
    stream: Stream | None = None
    if liquid.get("velocity"):
        shear = liquid.get("shear", (0.0, 0.0))
        stream = ShearedStream((*liquid["velocity"], 0.0), (*shear, 0.0), level=liquid.get("level", 0.0))
    elif liquid.get("veer"):
        stream = VeeringStream(liquid["veer"]["speed"], liquid["veer"]["rate"])
    elif liquid.get("profile"):
        rows = np.array(liquid["profile"])
        velocities = tuple((float(x), float(y), 0.0) for x, y in rows[:, 1:])
        stream = TabulatedStream(tuple(rows[:, 0]), velocities, liquid.get("interpolation", "linear"))
    return ThreadLoad(
        weight=thread["weight"],
        normal_drag=0.5 * area * thread.get("normal_drag", 0.0),
        tangential_drag=0.5 * pi * area * thread.get("tangential_drag", 0.0),
        viscous_drag=thread.get("viscous_drag", 0.0),
        stream=stream,
    )


def integrated(document: Document, places: Floats, guess: Any = (0.0, 0.0, 1.0)) -> ThreadShape:
    """The thread of a scene by marching from its free end B, or by shooting from a guess of the force at A to B."""
    load, thread, end = load_on(document), document["thread"], document["ends"]["b"]
    length, rigidity = thread["length"], thread.get("axial_rigidity") or inf
    start = document["ends"].get("a", {}).get("position", (0.0, 0.0, 0.0))
    if end["kind"] == "fixed":
        shot = shoot(load, length, start, end["position"], rigidity, guess)
        assert shot.miss < 1e-9
        return ThreadShape(s=places, positions=shot.positions(places), forces=shot.forces(places))

    def force_on(body: Document) -> Any:
        dead = np.array(body.get("force", (0.0, 0.0, 0.0))) - [0.0, 0.0, body.get("weight", 0.0)]
        drag = 0.5 * document.get("stream", {"density": 0.0})["density"] * body.get("drag_area", 0.0)

        def force(place: Floats) -> Floats:
            velocity = np.zeros(3) if load.stream is None else load.stream.velocity_at(np.asarray(place)[None])[0]
            return np.asarray(dead + drag * np.linalg.norm(velocity) * velocity)

        return force

    options: Document = {"axial_rigidity": rigidity, "start": start, "tolerance": 1e-12}
    if not np.any(force_on(end)(np.zeros(3))):
        return march_tail(load, length, **options).at(places)
    points = [(body["at"], force_on(body)) for body in document.get("load", ())]
    return march_back(load, length, force_on(end), point_forces=points, **options).at(places)


def true_error(document: Document, result: he.Result) -> float:
    """The largest error of positions, of the length, or of tensions, of the largest one, at the places reported."""
    data = result.dataset
    exact = integrated(document, data.s.values, data.contact_force.values[0])
    moved = np.linalg.norm(data.position.values - exact.positions, axis=1).max() / document["thread"]["length"]
    tension = np.abs(data.tension.values - exact.tensions).max() / exact.tensions.max()
    return float(max(moved, tension))
