"""Scenes of open water whose answers are stored in `reference/`, and their solutions."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from mpi4py import MPI
from open_tables import open_scene

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.fem.open_water.requests import RadiationRequest, ResponseRequest
from hydroelastic.fem.open_water.response import ResponseSolution, solve_response
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.physics import open_water_problem

FOLDER = Path(__file__).parents[1] / "reference"
DENSITY = 1000.0
GRAVITY = 9.81
RADIUS = 0.5
DISPLACED = DENSITY * math.pi * RADIUS**2 / 2.0
SLOW = pytest.mark.slow
# An estimate is the energy missed, which errors reach where it is all of one sign: at Ka = 1e-3 it is 0.97 of the
# error, and over a bed 0.71 of it at the worst.
TOO_SMALL = 1.5


def stored(name: str) -> dict[str, Any]:
    """Return a file of references."""
    content: dict[str, Any] = json.loads((FOLDER / name).read_text(encoding="utf-8"))
    return content


def complex_of(values: Any) -> np.ndarray:
    """Return pairs of real and imaginary parts as complex numbers."""
    array = np.array(values)
    return np.asarray(array[..., 0] + 1j * array[..., 1])


def numbered(rows: list[dict[str, Any]]) -> list[Any]:
    """Return rows as parameters of a test, named by their numbers from 1."""
    return [pytest.param(row, id=str(number)) for number, row in enumerate(rows, 1)]


def problem_of(scene: TankScene, comm: MPI.Comm = MPI.COMM_WORLD) -> OpenWaterProblem:
    """Return the open water of a scene."""
    return open_water_problem(scene, comm, Stopwatch())


def radiation(
    scene: TankScene, *omega: float, elastic_modes: int = 0, comm: MPI.Comm = MPI.COMM_WORLD
) -> RadiationSolution:
    """Return added mass, damping and excitation of a scene."""
    return solve_radiation(problem_of(scene, comm), RadiationRequest(omega=omega, elastic_modes=elastic_modes))


def response(
    scene: TankScene, *omega: float, waves_from: Literal["left", "right"] = "left", positions: int = 11
) -> ResponseSolution:
    """Return what a scene does in waves."""
    asked = ResponseRequest(omega=omega, waves_from=waves_from, positions=positions)
    return solve_response(problem_of(scene), asked)


def hydrodynamic(solution: RadiationSolution) -> np.ndarray:
    """Return a + ib/ω, shape (frequencies, motions, motions), for finite ω > 0."""
    table = solution.table
    return np.asarray(table.added_mass + 1j * table.radiation_damping / table.omega[:, None, None])


def circle(tolerance: float, *motions: str, **more: Any) -> TankScene:
    """Return a half-immersed circle in deep water."""
    body = {"kind": "float", "shape": "ellipse", "half_width": RADIUS, "half_height": RADIUS, "position": 5.0}
    moving = body | {"motions": motions or ("heave", "sway")} | more.pop("body", {})
    return open_scene(moving, analyses=[], accuracy={"tolerance": tolerance}, **more)


def circle_omega(ka: float) -> float:
    """Return ω of Ka = ω²a/g."""
    return math.sqrt(ka * GRAVITY / RADIUS)


def section(row: dict[str, Any], tolerance: float, position: float = 4.0) -> TankScene:
    """Return a stored polygonal section; above water it goes on with vertical sides."""
    left, *_, right = corners = row["corners"]
    depth = math.inf if row["depth"] is None else row["depth"]
    body = {
        "kind": "float",
        "shape": "polygon",
        "vertices": [*corners, [right[0], 0.3], [left[0], 0.3]],
        "position": position,
        "centre_of_mass": 0.0,
        "radius_of_gyration": 0.5,
        "motions": ["sway", "heave", "roll"],
        "unstable": "solve",
    }
    liquids = ({"density": DENSITY, "depth": depth},)
    return open_scene(body, liquids=liquids, analyses=[], accuracy={"tolerance": tolerance})


def plate(row: dict[str, Any], tolerance: float, start: float = 0.0, *, turned: bool = False) -> TankScene:
    """Return a stored plate; turned, its right end is on the left."""
    depth = math.inf if row["depth"] is None else row["depth"]
    liquids = ({"density": row["density"], "depth": depth},)
    segments, joints = (part[::-1] if turned else part for part in (row["segments"], row["joints"]))
    body = beam(segments, joints) | {"start": start}
    length = start + sum(segment["length"] for segment in segments)
    return open_scene(body, liquids=liquids, length=2 * length, analyses=[], accuracy={"tolerance": tolerance})


def beam(segments: list[dict[str, float]], joints: list[float | None]) -> dict[str, Any]:
    """Return a beam of uniform segments, joined by springs; `None` is no joint."""
    parts = [
        {"length": part["length"], "flexural_rigidity": part["rigidity"], "mass_per_length": part["mass"]}
        for part in segments
    ]
    if len(parts) == 1:
        return parts[0]
    places = np.cumsum([part["length"] for part in parts])
    turning = [
        {"at": float(place), "rotational_stiffness": spring}
        for place, spring in zip(places, joints, strict=False)
        if spring is not None
    ]
    return {"sections": parts, "joints": turning}


def two_liquids(row: dict[str, Any], tolerance: float, start: float = 0.0) -> TankScene:
    """Return a stored plate on one of the levels of two liquids."""
    liquids = tuple(
        {"density": density, "depth": depth} for density, depth in zip(row["densities"], row["depths"], strict=True)
    )
    body = beam([row["plate"]], []) | {"start": start, "at": row["level"]}
    return open_scene(
        body,
        liquids=liquids,
        length=start + 2 * row["plate"]["length"],
        top="free" if row["top"] == "free" else "rigid",
        analyses=[],
        accuracy={"tolerance": tolerance},
    )


THIN_LIQUIDS: dict[str, TwoLayers] = {
    "water": TwoLayers(density_below=1000.0, depth_below=math.inf, gravity=GRAVITY),
    "deep": TwoLayers(density_below=1000.0, density_above=800.0, depth_below=math.inf, gravity=GRAVITY),
    "channel": TwoLayers(
        density_below=1000.0, density_above=800.0, depth_below=2.0, depth_above=1.5, gravity=GRAVITY, top="rigid"
    ),
    "bed": TwoLayers(density_below=1000.0, density_above=800.0, depth_below=3.0, gravity=GRAVITY),
    "roof": TwoLayers(
        density_below=1000.0, density_above=800.0, depth_below=math.inf, depth_above=3.0, gravity=GRAVITY, top="rigid"
    ),
}
"""Liquids in which thin floats have closed forms; bed and lid of the channel are not at the same distance."""


def slender(
    shape: str, liquids: str, tolerance: float, *, slenderness: float = 0.1, boundary: str = "thin"
) -> TankScene:
    """Return a float half a metre above and below y = 0, in some of `THIN_LIQUIDS`."""
    layers = THIN_LIQUIDS[liquids]
    below = {"density": layers.density_below, "depth": layers.depth_below}
    above = {"density": layers.density_above, "depth": layers.depth_above}
    body = {
        "kind": "float",
        "shape": shape,
        "half_width": slenderness * RADIUS,
        "half_height": RADIUS,
        "position": 5.0,
        "boundary": boundary,
    }
    more = {"top": "rigid"} if math.isfinite(layers.depth_above) else {}
    liquid = (below, above) if layers.density_above else (below,)
    return open_scene(body, liquids=liquid, analyses=[], accuracy={"tolerance": tolerance}, **more)


def thin_omega(liquids: str, kappa: float) -> float:
    """Return ω of κ = ω²h/g*."""
    layers = THIN_LIQUIDS[liquids]
    total = layers.density_below + layers.density_above
    reduced = layers.gravity * (layers.density_below - layers.density_above) / total
    return math.sqrt(kappa * reduced / RADIUS)
