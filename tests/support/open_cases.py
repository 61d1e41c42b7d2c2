"""Scenes of open water whose answers are stored in `reference/`, and the answers of the solver as arrays."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hydroelastic as he
from hydroelastic.modal.liquid.two_layer import TwoLayers

FOLDER = Path(__file__).parents[1] / "reference"
DENSITY = 1000.0
GRAVITY = 9.81
RADIUS = 0.5
DISPLACED = DENSITY * math.pi * RADIUS**2 / 2.0
SLOW = pytest.mark.slow
# An estimate is the energy missed, which errors reach where it is all of one sign: at Ka = 1e-3 it is 0.97 of the
# error, and over a bed 0.71 of it at the worst.
TOO_SMALL = 1.5

Scene = dict[str, Any]
_COMPLEX = {"excitation_force", "froude_krylov_force", "diffraction_force", "reflection", "transmission"}
_COMPLEX |= {"amplitudes", "partial_waves", "deflection", "bending_moment", "shear_force", "body_amplitudes"}


def stored(name: str) -> dict[str, Any]:
    """Return a file of references."""
    content: dict[str, Any] = json.loads((FOLDER / name).read_text(encoding="utf-8"))
    return content


def complex_of(values: Any) -> np.ndarray:
    """Return pairs of real and imaginary parts as complex numbers."""
    array = np.array(values, dtype=float)
    return np.asarray(array[..., 0] + 1j * array[..., 1])


def numbered(rows: list[dict[str, Any]]) -> list[Any]:
    """Return rows as parameters of a test, named by their numbers from 1."""
    return [pytest.param(row, id=str(number)) for number, row in enumerate(rows, 1)]


def arrays(table: Mapping[str, Any]) -> SimpleNamespace:
    """Return a table of the summary with its numbers as arrays; `null` is NaN."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            found[key] = arrays(value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            found[key] = [arrays(one) for one in value]
        elif value is not None and (key in _COMPLEX or (key == "omega" and "residuals" in table)):
            found[key] = complex_of(value) if value else np.zeros(0, dtype=complex)
        elif isinstance(value, list) and value and key not in ("dofs", "labels", "waves"):
            found[key] = np.array(value, dtype=float)
        else:
            found[key] = value
    return SimpleNamespace(**found)


def answer(scene: Scene, *analyses: Scene, **keys: Any) -> SimpleNamespace:
    """Solve a scene, with these analyses and changed keys if there are any; the tables of its summary as `arrays`."""
    result = he.solve(scene | ({"analysis": list(analyses)} if analyses else {}) | keys)
    kinds = ("radiation", "response", "resonance", "decay", "spectrum", "impulse_response", "motion", "bodies")
    tables = {kind: [arrays(table) for table in result.summary[kind]] for kind in kinds}
    return SimpleNamespace(result=result, status=result.summary["status"], summary=result.summary, **tables)


def in_dataset(result: he.Result, name: str, **at: Any) -> np.ndarray:
    """Return a variable of the dataset, complex if it has both parts."""
    values = result.dataset[name].sel(**at)
    if "complex" in values.dims:
        values = values.sel(complex="re") + 1j * values.sel(complex="im")
    return np.asarray(values.values)


def curves(result: he.Result) -> SimpleNamespace:
    """Return what the dataset alone has of a spectrum: frequencies, transfer functions and densities by response."""
    names = [str(one) for one in result.dataset["spectrum_quantity"].values]
    found = (in_dataset(result, name).T for name in ("spectrum_transfer_function", "response_spectrum"))
    transfer, density = (dict(zip(names, values, strict=True)) for values in found)
    return SimpleNamespace(omega=in_dataset(result, "spectrum_omega"), transfer=transfer, density=density)


def radiation(scene: Scene, *omega: float, **asked: Any) -> SimpleNamespace:
    """Return added mass, damping and excitation of a scene."""
    asked = {"elastic_modes": 0} | asked if any("shape" not in body for body in scene["body"]) else asked
    (table,) = answer(scene, {"kind": "radiation", "omega": list(omega)} | asked).radiation
    return table


def response(scene: Scene, *omega: float, **asked: Any) -> SimpleNamespace:
    """Return what a scene does in waves."""
    (table,) = answer(scene, {"kind": "response", "omega": list(omega), "positions": 11} | asked).response
    return table


def hydrodynamic(table: SimpleNamespace) -> np.ndarray:
    """Return a + ib/ω, shape (frequencies, motions, motions), for finite ω > 0."""
    return np.asarray(table.added_mass + 1j * table.radiation_damping / table.omega[:, None, None])


def open_scene(body: Scene, *, liquids: Any = None, tolerance: float, length: float = 10.0, **tank: Any) -> Scene:
    """Return a scene with open ends; deep water unless liquids are given."""
    return {
        "kind": "tank",
        "tank": {"length": length, "ends": "open"} | tank,
        "liquid": list(liquids or [{"density": DENSITY, "depth": math.inf}]),
        "body": [body],
        "accuracy": {"tolerance": tolerance},
    }


def sea(*bodies: Scene, depth: float = math.inf, tolerance: float, density: float = DENSITY, **keys: Any) -> Scene:
    """Return a scene of the sea."""
    water = [{"density": density, "depth": depth}]
    return {"kind": "sea", "liquid": water, "body": list(bodies), "accuracy": {"tolerance": tolerance}} | keys


def circle(tolerance: float, *motions: str, body: Scene | None = None, **more: Any) -> Scene:
    """Return a half-immersed circle in deep water."""
    round_one = {"kind": "float", "shape": "ellipse", "half_width": RADIUS, "half_height": RADIUS, "position": 5.0}
    return open_scene(
        round_one | {"motions": list(motions or ("heave", "sway"))} | (body or {}), tolerance=tolerance, **more
    )


def circle_omega(ka: float) -> float:
    """Return ω of Ka = ω²a/g."""
    return math.sqrt(ka * GRAVITY / RADIUS)


def section(row: dict[str, Any], tolerance: float, position: float = 4.0) -> Scene:
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
    return open_scene(body, liquids=liquids, tolerance=tolerance)


def plate(row: dict[str, Any], tolerance: float, start: float = 0.0, *, turned: bool = False) -> Scene:
    """Return a stored plate; turned, its right end is on the left."""
    depth = math.inf if row["depth"] is None else row["depth"]
    liquids = ({"density": row["density"], "depth": depth},)
    segments, joints = (part[::-1] if turned else part for part in (row["segments"], row["joints"]))
    body = beam(segments, joints) | {"start": start}
    length = start + sum(segment["length"] for segment in segments)
    return open_scene(body, liquids=liquids, length=2 * length, tolerance=tolerance)


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


def two_liquids(row: dict[str, Any], tolerance: float, start: float = 0.0) -> Scene:
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
        tolerance=tolerance,
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


def slender(shape: str, liquids: str, tolerance: float, *, slenderness: float = 0.1, boundary: str = "thin") -> Scene:
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
    return open_scene(body, liquids=liquid, tolerance=tolerance, **more)


def thin_omega(liquids: str, kappa: float) -> float:
    """Return ω of κ = ω²h/g*."""
    layers = THIN_LIQUIDS[liquids]
    total = layers.density_below + layers.density_above
    reduced = layers.gravity * (layers.density_below - layers.density_above) / total
    return math.sqrt(kappa * reduced / RADIUS)
