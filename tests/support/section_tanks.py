"""Closed tanks per metre of width as scenes, made from a few changed values, or read from the exact reference cases."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import hydroelastic as he

GRAVITY = 9.81
REFERENCES = Path(__file__).parents[1] / "reference"
AQUARIUM: dict[str, Any] = json.loads((REFERENCES / "aquarium.json").read_text(encoding="utf-8"))
CASES: dict[str, dict[str, Any]] = {case["name"]: case for case in AQUARIUM["cases"]}


def beam(**changes: Any) -> he.Beam:
    """The beam of the case base_s0, but for what is changed."""
    values = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0, "hydrostatic": False}
    return he.Beam(**(values | changes))


def tank(*bodies: Any, **changes: Any) -> he.TankScene:
    """The tank of the case base_s0 with the given bodies, but for what is changed."""
    values = {"length": 10.0, "gravity": GRAVITY, "top": "free", "depth": 5.0, "density": 1000.0}
    values |= {"tolerance": 1e-6, "modes": 8} | changes
    return he.TankScene(
        tank={key: values[key] for key in ("length", "gravity", "top")},
        liquid=[{key: values[key] for key in ("density", "depth")}],
        body=bodies,
        accuracy={key: values[key] for key in ("tolerance", "modes")},
    )


def case_scene(name: str, **changes: Any) -> he.TankScene:
    """A reference case of one beam as a scene."""
    given = CASES[name]["inputs"]
    body = {"start": given["x1"], "length": given["l"], "hydrostatic": bool(given["s"]), "ends": given["ends"]}
    body |= {"flexural_rigidity": given["EI"], "mass_per_length": given["m"]}
    whole = {"length": given["L"], "gravity": given["g"], "depth": given["H"], "density": given["rho"]}
    return tank(*([he.Beam(**body)] if given["l"] else []), **(whole | changes))


def layered(
    *bodies: Any,
    densities: tuple[float, ...] = (1000.0, 850.0),
    depths: tuple[float, ...] = (0.3, 0.2),
    length: float = 1.0,
    top: str = "rigid",
    tolerance: float = 1e-8,
    modes: int = 6,
    **keys: Any,
) -> he.TankScene:
    """A tank with liquids from the bottom up."""
    return he.TankScene(
        tank={"length": length, "gravity": GRAVITY, "top": top},
        liquid=[{"density": density, "depth": depth} for density, depth in zip(densities, depths, strict=False)],
        body=bodies,
        accuracy={"tolerance": tolerance, "modes": modes},
        **keys,
    )


def rigid(shape: str, position: float, motions: str = "heave", **keys: Any) -> he.Float:
    """A float; its motions as one word each."""
    return he.Float(kind="float", shape=shape, position=position, motions=tuple(motions.split()), **keys)
