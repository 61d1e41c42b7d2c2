"""Random threads in a stream, by kind and number: scenes in wide ranges of load, stretch, slack and bending.

Lengths 1 to 1000 m, streams 0.1 to 3 m/s, diameters 5 to 300 mm; half of the streams of a kind are sheared, a third of
the threads stretch. Rn = kn U² is the drag of the unsheared stream per length across it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

KINDS = {"free": 200, "slack": 160, "taut": 60, "tail": 74, "bodies": 6, "bending": 60}
"""How many of each kind make up the whole sample."""

DENSITY, NORMAL_DRAG = 1025.0, 1.2
_SEED = 2718

Scene = dict[str, Any]


def random_thread(kind: str, number: int) -> Scene:
    """Return a scene of a kind, the same one for the same number."""
    makers = {"free": _free, "slack": _slack, "taut": _taut, "tail": _tail, "bodies": _bodies, "bending": _bending}
    return makers[kind](_Dice(np.random.default_rng([_SEED, list(KINDS).index(kind), number])))


def all_numbers(part: float = 1.0) -> list[tuple[str, int]]:
    """Return kinds and numbers of the sample, or of the first part of each kind, one of each at least."""
    return [(kind, number) for kind, count in KINDS.items() for number in range(max(round(part * count), 1))]


class _Dice:
    """Random numbers of one scene, and what all kinds have in common."""

    def __init__(self, random: np.random.Generator) -> None:
        self.random = random
        self.length = self.between(1.0, 1000.0)
        self.speed = self.between(0.1, 3.0)
        self.diameter = self.between(0.005, 0.3)

    @property
    def drag(self) -> float:
        return 0.5 * DENSITY * NORMAL_DRAG * self.diameter * self.speed**2

    def between(self, low: float, high: float) -> float:
        """A number whose logarithm is uniform."""
        return float(np.exp(self.random.uniform(np.log(low), np.log(high))))

    def either(self) -> float:
        return float(self.random.choice([-1.0, 1.0]))

    def chance(self, part: float) -> bool:
        return bool(self.random.random() < part)

    def level(self) -> tuple[float, float]:
        angle = self.random.uniform(0.0, 2.0 * np.pi)
        return float(np.cos(angle)), float(np.sin(angle))

    def way(self) -> np.ndarray:
        vector = self.random.normal(size=3)
        return np.asarray(vector / np.linalg.norm(vector))

    def thread(self, weight: float, *, stretches: float | None = None) -> Scene:
        """A thread; a third of them stretch, by less than 1/20 under a force."""
        thread = {
            "length": self.length,
            "diameter": self.diameter,
            "weight": weight,
            "normal_drag": NORMAL_DRAG,
            "tangential_drag": 0.0 if self.chance(0.5) else self.between(0.003, 0.05),
        }
        if stretches is not None and self.chance(1.0 / 3.0):
            thread["axial_rigidity"] = stretches * self.between(20.0, 1e6)
        return thread

    def stream(self) -> Scene:
        stream: Scene = {"density": DENSITY, "velocity": tuple(self.speed * part for part in self.level())}
        if self.chance(0.5):
            gradient = self.speed / self.length * self.random.uniform(0.0, 1.0)
            stream["shear"] = tuple(gradient * part for part in self.level())
        return stream


def _vector(values: Any) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _free(dice: _Dice) -> Scene:
    """A force at the free end, from a hundredth to a hundred times the load of the thread, any way."""
    weight = dice.either() * dice.drag * dice.between(0.01, 100.0)
    force = dice.between(0.01, 100.0) * max(abs(weight), dice.drag) * dice.length
    return {
        "thread": dice.thread(weight, stretches=force),
        "stream": dice.stream(),
        "ends": {"b": {"kind": "free", "force": _vector(force * dice.way())}},
    }


def _between_ends(dice: _Dice, chord: float) -> Scene:
    weight = dice.either() * dice.drag * dice.between(0.01, 10.0)
    return {
        "thread": dice.thread(weight, stretches=max(abs(weight), dice.drag) * dice.length),
        "stream": dice.stream(),
        "ends": {"b": {"kind": "fixed", "position": _vector(chord * dice.way())}},
    }


def _slack(dice: _Dice) -> Scene:
    """Both ends fixed, the thread 1.001 to 3 times as long as their distance."""
    return _between_ends(dice, dice.length / (1.0 + dice.between(0.001, 2.0)))


def _taut(dice: _Dice) -> Scene:
    """Both ends fixed, the thread stretched by up to a tenth, or as long as their distance."""
    scene = _between_ends(dice, dice.length * (1.0 + (0.0 if dice.chance(0.2) else dice.between(1e-6, 0.1))))
    load = max(abs(scene["thread"]["weight"]), dice.drag) * dice.length
    scene["thread"]["axial_rigidity"] = load * dice.between(20.0, 1e6)
    return scene


def _tail(dice: _Dice) -> Scene:
    """Nothing at the free end."""
    weight = dice.either() * dice.drag * dice.between(0.01, 100.0)
    return {
        "thread": dice.thread(weight, stretches=max(abs(weight), dice.drag) * dice.length),
        "stream": dice.stream(),
        "ends": {"b": {"kind": "free"}},
    }


def _bodies(dice: _Dice) -> Scene:
    """Bodies with drag along the thread and at its free end, or at both fixed ends."""
    weight = dice.either() * dice.drag * dice.between(0.01, 10.0)
    load = max(abs(weight), dice.drag) * dice.length

    def body(sign: float) -> Scene:
        area = dice.between(0.01, 1.0) * load / (0.5 * DENSITY * dice.speed**2)
        return {"weight": sign * load * dice.between(0.01, 1.0), "drag_area": area}

    sign = 1.0 if weight > 0.0 else -1.0
    places = np.sort(dice.random.uniform(0.1, 0.9, size=2)) * dice.length
    end: Scene = {"kind": "free", **body(sign)}
    if dice.chance(0.5):
        end = {"kind": "fixed", "position": _vector(dice.length / (1.0 + dice.between(0.01, 1.0)) * dice.way())}
    return {
        "thread": dice.thread(weight, stretches=load),
        "stream": dice.stream(),
        "load": [{"at": float(place), **body(sign)} for place in places],
        "ends": {"b": end},
    }


def _bending(dice: _Dice) -> Scene:
    """Flexural rigidity, √(EI/F)/L from 0.001 to 0.3, ends hinged or clamped; F is the end force or the load."""
    scene = (_free, _slack)[int(dice.chance(0.5))](dice)
    thread, end = scene["thread"], scene["ends"]["b"]
    force = max(abs(thread["weight"]), dice.drag) * dice.length
    if "force" in end:
        force = float(np.linalg.norm(end["force"]))
    thread["flexural_rigidity"] = force * (dice.between(1e-3, 0.3) * dice.length) ** 2
    if dice.chance(0.5):
        scene["ends"]["a"] = {"kind": "fixed", "clamp": _vector(dice.way())}
    return scene
