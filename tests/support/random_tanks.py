"""Tanks drawn at random over the range of ordinary use, for claims that no catalogue of chosen tanks can support."""

from __future__ import annotations

from math import exp, log

import numpy as np
from hard_cases import TOLERANCES

import hydroelastic as he

TANK_TO_BEAM = (1.02, 30.0)
DEPTH_TO_LENGTH = (0.003, 10.0)
RIGIDITY = (1e-6, 1e3)
MASS = (1e-6, 10.0)
MOST_MODES = 12
TWO_BEAMS, MIRROR_IMAGES, AT_A_WALL = 0.3, 0.5, 0.25
"""Parts of the tanks with two beams, of those that are their own mirror image, and of the rest that begin at a wall."""


def draw_tanks(seed: int, count: int) -> list[he.TankScene]:
    """Tanks of unit length, density and gravity, each with a tolerance and a number of modes of its own.

    Args:
        seed: of the random numbers.
        count: how many tanks.
    """
    random = np.random.default_rng(seed)
    return [_draw(random) for _ in range(count)]


def _draw(random: np.random.Generator) -> he.TankScene:
    depth = _between(random, DEPTH_TO_LENGTH)
    mirror = random.random() < MIRROR_IMAGES
    beams = _two(random, mirror) if random.random() < TWO_BEAMS else (_one(random, mirror),)
    return he.TankScene(
        tank=he.Tank(length=1.0, gravity=1.0),
        liquid=(he.Liquid(density=1.0, depth=depth),),
        body=beams,
        accuracy=he.Accuracy(
            tolerance=float(random.choice(TOLERANCES)), modes=int(random.integers(1, MOST_MODES, endpoint=True))
        ),
    )


def _between(random: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Uniform in the logarithm."""
    return exp(random.uniform(log(bounds[0]), log(bounds[1])))


def _beam(random: np.random.Generator, start: float, length: float) -> he.Beam:
    return he.Beam(
        start=start,
        length=length,
        flexural_rigidity=_between(random, RIGIDITY) * length**4,
        mass_per_length=_between(random, MASS) * length,
        hydrostatic=bool(random.random() < 0.5),
    )


def _one(random: np.random.Generator, mirror: bool) -> he.Beam:
    length = 1.0 / _between(random, TANK_TO_BEAM)
    if mirror:
        return _beam(random, 0.5 * (1.0 - length), length)
    if random.random() < AT_A_WALL:
        return _beam(random, 0.0 if random.random() < 0.5 else 1.0 - length, length)
    return _beam(random, random.uniform(0.0, 1.0 - length), length)


def _two(random: np.random.Generator, mirror: bool) -> tuple[he.Beam, he.Beam]:
    if mirror:
        length = 0.5 / _between(random, TANK_TO_BEAM)
        start = random.uniform(0.0, 0.99) * (0.5 - length)
        left = _beam(random, start, length)
        return left, left.model_copy(update={"start": 1.0 - start - length})
    middle = random.uniform(0.2, 0.8)
    first, second = middle * random.uniform(0.1, 0.98), (1.0 - middle) * random.uniform(0.1, 0.98)
    left = _beam(random, random.uniform(0.0, 0.99) * (middle - first), first)
    right = _beam(random, middle + random.uniform(0.01, 1.0) * (1.0 - middle - second), second)
    return left, right
