"""The problems on this solver, through `hydroelastic` as a user has it: from numbers to the whole of a result.

What each function returns takes the numbers out of the result, which is not timed.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from itertools import count
from math import tau
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

import hydroelastic as he

Given = Mapping[str, Any]
Numbers = Callable[[], tuple[Any, int, str]]

_ROUND = count(1)
_CACHE = TemporaryDirectory()


def command(given: Given, arguments: list[str]) -> Numbers:
    """Run Python in a process of its own; its first run finds an empty cache of compiled forms."""
    environment = os.environ | {"XDG_CACHE_HOME": _CACHE.name}
    with TemporaryDirectory() as out:
        words = [sys.executable, *(word.format(out=Path(out) / "result") for word in arguments)]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=environment)
    return lambda: ([], 0, "")


def _tank(given: Given, tolerance: float) -> Any:
    # What an earlier round left of the same liquid would be no work of this one: the depth differs by rounding.
    depth = given["depth"] * (1.0 + 1e-15 * next(_ROUND))
    body = {"start": given["start"], "length": given["beam_length"], "flexural_rigidity": given["rigidity"]}
    body |= {"kind": "beam", "mass_per_length": given["mass"], "hydrostatic": given["hydrostatic"]}
    return he.TankScene(
        tank={"length": given["length"], "gravity": given["gravity"]},
        liquid=[{"density": given["density"], "depth": depth}],
        body=[body],
        accuracy={"tolerance": tolerance, "modes": 10},
    )


def tank(given: Given, tolerance: float) -> Numbers:
    """The ten lowest frequencies, with estimates, count, both tones, and what older theories say."""
    return _modes(he.solve(_tank(given, tolerance)))


def sweep(given: Given, tolerance: float) -> Numbers:
    """The same for many values of a key, without the older theories."""
    named = {"start": "body.1.start", "rigidity": "body.1.flexural_rigidity"}[given["key"]]
    data = he.sweep(_tank(given, tolerance), {named: given["values"]}, follow=False).dataset
    return lambda: (data.omega.values[:: given["compared"]].ravel(), int(data.size_dofs.max()), "")


def circle(given: Given, tolerance: float) -> Numbers:
    """a + ib/ω of heave and sway of the section, kg/m, with excitation and estimates."""
    body = {"kind": "float", "position": 5.0, "shape": "ellipse", "half_width": 1.0, "half_height": 1.0}
    scene = he.TankScene(
        tank={"length": 10.0, "gravity": 9.81, "ends": "open"},
        liquid=[{"density": 1000.0, "depth": float("inf")}],
        body=[body | {"motions": ["heave", "sway"]}],
        analysis=[{"kind": "radiation", "omega": [given["omega"]]}],
        accuracy={"tolerance": tolerance},
    )
    return _impedance(he.solve(scene), given["omega"])


def buoy(given: Given, tolerance: float) -> Numbers:
    """a + ib/ω of heave, kg, with excitation and estimates."""
    body = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": given["draught"], "motions": ["heave"]}
    if given["draught"] is None:
        body |= {"shape": "sphere"}
        del body["draught"]
    scene = he.SeaScene(
        sea={"gravity": 9.81},
        liquid=[{"density": 1000.0, "depth": given["depth"]}],
        body=[body],
        analysis=[{"kind": "radiation", "omega": [given["omega"]]}],
        accuracy={"tolerance": tolerance},
    )
    return _impedance(he.solve(scene), given["omega"])


def volume(given: Given, tolerance: float) -> Numbers:
    """The lowest frequencies of a tank in three dimensions, with estimates and count."""
    keys = {"length": given["length"], "width": given["width"], "gravity": given["gravity"]}
    plate: dict[str, Any] = {
        "kind": "plate",
        "outline": "rectangle",
        "position": [given["length"] / 2.0, given["width"] / 2.0],
    }
    plate |= {"size": given["plate"], "flexural_rigidity": given.get("rigidity"), "mass_per_area": given.get("mass")}
    scene = {
        "kind": "tank",
        # A bed that is named, if level, has the liquid meshed in its volume.
        "tank": keys if given["plate"][0] else keys | {"bed": {"slope": [0.0, 0.0]}},
        "liquid": [{"density": given["density"], "depth": given["depth"]}],
        "body": [plate] if given["plate"][0] else [],
        "accuracy": {"tolerance": tolerance, "modes": given["modes"]},
    }
    return _modes(he.solve(he.read(scene)))


def string(given: Given, method: str, tolerance: float) -> Numbers:
    """Displacements of a hanging string by its series or as a field, its free motions, and estimates."""
    scene = he.StringScene(
        string={"length": 1.0, "linear_density": 1.0, "resistance": 0.5},
        motion=given["motion"],
        output={"positions": [(place / 6) ** 2 for place in range(7)], "times": [0.15 * k for k in range(1, 14)]},
        accuracy={"tolerance": tolerance, "method": method},
    )
    result = he.solve(scene)
    error = result.summary["response"]["relative_error"]
    unknowns = result.summary["size"].get("dofs") or result.summary["size"].get("terms")
    return lambda: (result.dataset.displacement.values.ravel(), unknowns, f"estimate {error:.1e}")


def line(given: Given, tolerance: float) -> Numbers:
    """x + iz of the contact force on both ends, N, with estimates."""
    result = he.solve(_line(given, tolerance))
    equilibrium = result.summary["equilibrium"]
    forces = np.array(equilibrium["reactions"]) * [[-1.0], [1.0]]
    note = f"estimate {equilibrium['relative_error']:.1e}"
    return lambda: (forces[:, 0] + 1j * forces[:, 2], result.summary["size"]["dofs"], note)


def moved(given: Given, tolerance: float) -> Numbers:
    """The top tension of the jumper in its third period, N, with estimates, from steps and elements halved."""
    motion = {"end": "b", "amplitude": [given["amplitude"], 0.0, 0.0], "omega": tau / given["period"]}
    analysis: dict[str, Any] = {
        "kind": "motion",
        "times": [0.0, *given["times"]],
        "move": [motion | {"rise": given["period"]}],
    }
    analysis |= {"integrator": "generalized_alpha", "tolerance": tolerance}
    result = he.solve(_line(given, 1e-6, analysis))
    error = result.summary["motion"][0]["tension_error"]
    note = f"{result.summary['size']['steps']} steps, estimate {error / given['largest']:.1e}"
    return lambda: (
        result.dataset.motion_tension.values[-len(given["times"]) :, -1],
        result.summary["size"]["dofs"],
        note,
    )


def _line(given: Given, tolerance: float, *analyses: Given) -> Any:
    keys = ("length", "diameter", "mass", "gravity", "normal_drag", "tangential_drag")
    stream = {"density": given["density"]}
    if given["stream"]:
        stream |= {"velocity": [given["stream"], 0.0]}
    if given["shear"]:
        stream |= {"shear": [given["shear"], 0.0], "level": given["a"][1]}
    return he.ThreadScene(
        thread={key: given[key] for key in keys} | {"axial_rigidity": given["rigidity"], "added_mass": 1.0},
        stream=stream,
        ends={end: {"kind": "fixed", "position": [given[end][0], 0.0, given[end][1]]} for end in "ab"},
        analysis=list(analyses),
        accuracy={"tolerance": tolerance},
    )


def _modes(result: Any) -> Numbers:
    note = f"estimate {result.modes.relative_error.max():.1e}"
    return lambda: (result.modes.omega, result.summary["size"]["dofs"], note)


def _impedance(result: Any, omega: float) -> Numbers:
    found = result.summary["radiation"][0]
    added, damping = (np.diagonal(np.array(found[key])[0]) for key in ("added_mass", "radiation_damping"))
    places = [found["dofs"].index(name) for name in ("heave", "sway") if name in found["dofs"]]
    return lambda: ((added + 1j * damping / omega)[places], result.summary["size"]["dofs"], "")
