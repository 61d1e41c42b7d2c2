"""A hundred valid scenes of all kinds, drawn at random and cheap to run; the same ones each time."""

from __future__ import annotations

from math import exp, log
from typing import Any

import numpy as np
from random_floats import draw_floats
from random_tanks import draw_tanks
from random_threads import all_numbers, random_thread

import hydroelastic as he

SEED = 20240
HOW_MANY = {"beams": 30, "floats": 20, "open": 6, "string": 14, "thread": 20, "roll": 10}


def hundred_scenes() -> list[tuple[str, Any]]:
    """Return names and scenes: tanks with beams and with floats, open water, strings, threads, ships."""
    random = np.random.default_rng(SEED)
    threads = all_numbers(0.2)
    chosen = [threads[place] for place in np.linspace(0, len(threads) - 1, HOW_MANY["thread"]).astype(int)]
    documents: list[tuple[str, Any]] = [("open", _circle(random)) for _ in range(HOW_MANY["open"])]
    documents += [("string", _string(random)) for _ in range(HOW_MANY["string"])]
    documents += [("thread", random_thread(*one) | {"kind": "thread"}) for one in chosen]
    documents += [("roll", _ship(random)) for _ in range(HOW_MANY["roll"])]
    scenes: list[tuple[str, Any]] = [("beams", coarse(scene)) for scene in draw_tanks(SEED, HOW_MANY["beams"])]
    scenes += [("floats", coarse(scene)) for scene in draw_floats(SEED, HOW_MANY["floats"], wide=True)]
    scenes += [(name, he.read(document)) for name, document in documents]
    return scenes


def coarse(scene: he.TankScene) -> he.TankScene:
    """The same tank, asked for four modes at most to 1e-4."""
    accuracy = scene.accuracy.model_copy(update={"tolerance": 1e-4, "modes": min(scene.accuracy.modes, 4)})
    return scene.model_copy(update={"accuracy": accuracy})


def _between(random: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return exp(random.uniform(log(low), log(high)))


def _circle(random: np.random.Generator) -> dict[str, Any]:
    """An ellipse in open water, radiating and moved by waves about as long as it."""
    half_width = _between(random, 0.2, 5.0)
    half_height = half_width * _between(random, 0.5, 2.0)
    omega = float(np.sqrt(9.81 / half_width)) * np.array([0.5, 1.0])
    body = {"kind": "float", "shape": "ellipse", "position": 5.0 * half_width}
    kinds = ("radiation", "response")
    return {
        "kind": "tank",
        "tank": {"length": 10.0 * half_width, "ends": "open"},
        "liquid": [{"density": 1000.0, "depth": half_height * _between(random, 3.0, 30.0)}],
        "body": [body | {"half_width": half_width, "half_height": half_height}],
        "analysis": [{"kind": str(random.choice(kinds)), "omega": omega.tolist()}],
        "accuracy": {"tolerance": 1e-2},
    }


def _string(random: np.random.Generator) -> dict[str, Any]:
    """A string, half of them with something on the end or a resistance that varies, moved in one of four ways."""
    length, density = _between(random, 0.1, 100.0), _between(random, 0.01, 10.0)
    rate = float(np.sqrt(9.81 / length))
    resistance = float(random.choice([0.0, 1.0])) * density * rate * _between(random, 0.01, 2.0)
    string: dict[str, Any] = {"length": length, "linear_density": density, "resistance": resistance}
    if random.random() < 0.5:
        string |= {"tip_mass": density * length * _between(random, 0.01, 10.0)}
        string["resistance"] = {"bottom": resistance, "top": 2.0 * resistance}
    amplitude = length * _between(random, 1e-3, 0.1)
    motions = (
        {"kind": "ramp", "speed": amplitude * rate},
        {"kind": "sine", "amplitude": amplitude, "omega": rate * _between(random, 0.2, 5.0)},
        {"kind": "smooth", "amplitude": amplitude, "rate": rate * _between(random, 0.2, 5.0)},
        {"kind": "step", "amplitude": amplitude},
    )
    return {
        "kind": "string",
        "string": string,
        "motion": motions[int(random.integers(len(motions)))],
        "output": {"frames": 0},
        "accuracy": {"tolerance": 1e-3, "modes": 4},
    }


def _ship(random: np.random.Generator) -> dict[str, Any]:
    """A ship on one to twelve waves, a third of them with quadratic damping."""
    period = _between(random, 1.0, 30.0)
    waves = [
        {"period": period * _between(random, 0.5, 2.0), "slope": random.uniform(0.01, 0.1)}
        for _ in range(int(random.integers(1, 13)))
    ]
    roll = {"natural_period": period, "damping_ratio": _between(random, 1e-3, 1.5), "angle": random.uniform(-0.2, 0.2)}
    if random.random() < 1.0 / 3.0:
        roll["quadratic_damping"] = _between(random, 0.01, 1.0)
    return {"kind": "roll", "roll": roll, "wave": waves, "accuracy": {"tolerance": 1e-6}}
