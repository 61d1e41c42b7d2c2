"""Tanks with rigid floats drawn at random, for claims that no catalogue of chosen tanks can support."""

from __future__ import annotations

from itertools import pairwise
from math import exp, log
from typing import Any

import numpy as np

import hydroelastic as he

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
LENGTH = (0.3, 100.0)
DENSITY_RATIO = (0.0005, 0.7)
"""(ρ₂ − ρ₁)/ρ₂ of two liquids."""
DEPTH = (0.1, 1.5)
"""Of each liquid, over the tank's length."""
HALF_WIDTH = (0.02, 0.2)
"""Of a float, over the tank's length."""
SLENDERNESS = (0.15, 4.0)
"""Half height over half width."""
MOST_MODES = 8

SMOOTH_OR_CORNERED = ("ellipse", "parabola", "wedge", "rectangle", "polygon")
ALL_SHAPES = (*SMOOTH_OR_CORNERED, "exponential")
MOTIONS = ("heave", "sway", "roll")


def draw_floats(seed: int, count: int, *, wide: bool = False) -> list[he.TankScene]:
    """Tanks with one float or two, perhaps beside a beam, each with a tolerance and a number of modes of its own.

    Args:
        seed: of the random numbers.
        count: how many tanks.
        wide: whether all is drawn that a scene can ask for; else what `float_reference` can solve too: no thin floats,
            no exponential ones, none that would turn over or that floats on the upper liquid, no ψ = 0 at the top.
    """
    random = np.random.default_rng(seed)
    scenes: list[he.TankScene] = []
    while len(scenes) < count:
        try:
            scenes.append(he.TankScene(**_draw(random, wide=wide)))
        except he.SceneError:
            # It sinks, capsizes, or has no room: the next one.
            continue
    return scenes


def _between(random: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Uniform in the logarithm."""
    return exp(random.uniform(log(bounds[0]), log(bounds[1])))


def _draw(random: np.random.Generator, *, wide: bool) -> dict[str, Any]:
    length = _between(random, LENGTH)
    density = float(random.choice([1000.0, 13600.0, 1.2]))
    liquids = [{"density": density, "depth": length * _between(random, DEPTH)}]
    two = bool(random.random() < 0.6)
    if two:
        ratio = 1.0 - _between(random, DENSITY_RATIO)
        liquids.append({"density": density * ratio, "depth": length * _between(random, DEPTH)})
    tops = ["free", "rigid", "pressure_release"] if wide else ["free", "rigid"] if two else ["free"]
    top = str(random.choice(tops))
    centred = random.random() < 0.3
    number = 1 if centred else int(random.integers(1, 3))
    cells = np.linspace(0.0, 1.0, number + 2)
    # A beam takes one of the places beside the floats.
    beam_place = int(random.integers(0, number + 1)) if not centred and random.random() < 0.4 else -1
    bodies = []
    for place, (start, end) in enumerate(pairwise(cells)):
        if place == beam_place:
            bodies.append(_beam(random, length, start, end, liquids))
    for place in [place for place in range(number + 1) if place != beam_place][:number]:
        middle = 0.5 if centred else random.uniform(0.3, 0.7) * (cells[place] + cells[place + 1])
        bodies.append(_float(random, length, middle, liquids, wide=wide))
        if wide and two and top != "rigid" and random.random() < 0.2:
            bodies[-1]["at"] = "surface"
    return {
        "tank": {"length": length, "gravity": 9.81, "top": top},
        "liquid": liquids,
        "body": bodies,
        "accuracy": {
            "tolerance": float(random.choice(TOLERANCES)),
            "modes": int(random.integers(2, MOST_MODES, endpoint=True)),
        },
    }


def _beam(
    random: np.random.Generator, length: float, start: float, end: float, liquids: list[dict[str, float]]
) -> dict[str, Any]:
    span = random.uniform(0.4, 0.8) * (end - start) * length
    density = liquids[0]["density"]
    weight = density * 9.81 * (1.0 - (liquids[1]["density"] / density if len(liquids) == 2 else 0.0))
    return {
        "kind": "beam",
        "start": start * length + random.uniform(0.1, 0.9) * ((end - start) * length - span),
        "length": span,
        "flexural_rigidity": _between(random, (1e-4, 1.0)) * weight * span**4,
        "mass_per_length": _between(random, (1e-3, 1.0)) * density * span,
        "hydrostatic": True,
    }


def _float(
    random: np.random.Generator, length: float, middle: float, liquids: list[dict[str, float]], *, wide: bool
) -> dict[str, Any]:
    half_width = length * _between(random, HALF_WIDTH)
    half_height = half_width * _between(random, SLENDERNESS)
    shape = str(random.choice(ALL_SHAPES if wide else SMOOTH_OR_CORNERED))
    body: dict[str, Any] = {"kind": "float", "shape": shape, "position": middle * length}
    if shape == "polygon":
        body["vertices"] = _polygon(random, half_width, half_height)
    else:
        body |= {"half_width": half_width, "half_height": half_height * (0.2 if shape == "exponential" else 1.0)}
    thin = wide and shape not in ("rectangle", "polygon") and random.random() < 0.25
    if thin:
        return body | {"boundary": "thin"}
    body["motions"] = [motion for motion in MOTIONS if random.random() < 0.6] or ["heave"]
    if random.random() < 0.4:
        lower = liquids[0]["density"]
        upper = liquids[1]["density"] if len(liquids) == 2 else 0.0
        area = {"ellipse": 3.14, "parabola": 8.0 / 3.0, "rectangle": 4.0}.get(shape, 2.0) * half_width * half_height
        body["mass"] = area * (upper + random.uniform(0.15, 0.85) * (lower - upper))
    if random.random() < 0.5:
        body["centre_of_mass"] = random.uniform(-0.5, 0.1) * half_height
    if random.random() < 0.3:
        body["radius_of_gyration"] = random.uniform(0.4, 1.0) * max(half_width, half_height)
    if wide and random.random() < 0.5:
        body["unstable"] = "solve"
    return body


def _polygon(random: np.random.Generator, half_width: float, half_height: float) -> list[list[float]]:
    """Corners on an ellipse, now and then one of them drawn inwards."""
    count = int(random.integers(3, 8))
    angles = np.sort((np.arange(count) + random.uniform(-0.35, 0.35, count)) * 2.0 * np.pi / count)
    radii = np.ones(count)
    if count > 4 and random.random() < 0.3:
        radii[int(random.integers(0, count))] = 0.6
    return np.column_stack([half_width * radii * np.cos(angles), half_height * radii * np.sin(angles)]).tolist()
