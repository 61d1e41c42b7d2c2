"""Resonances of open water are as many as an independent count finds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hydroelastic as he

LIGHT_BEAM = {
    "kind": "beam",
    "start": 0.5761972462192491,
    "length": 0.6594348607522386,
    "flexural_rigidity": 0.43910236390906504,
    "mass_per_length": 9.44182150098125,
}
BEAM = {"kind": "beam", "start": 4.0, "length": 5.0, "flexural_rigidity": 1e4, "mass_per_length": 60.0}
CIRCLE = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0, "position": 0.0}
BOX = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 2.0,
    "draught": 1.0,
    "half_height": 1.0,
    "motions": ["heave"],
}
BODIES: dict[str, list[dict[str, Any]]] = {
    "light beam": [LIGHT_BEAM],
    "two floats": [CIRCLE, CIRCLE | {"position": 6.0}],
    "ellipse and beam": [CIRCLE | {"half_width": 1.5}, BEAM],
    "damped floats far apart": [BOX | {"position": 0.0}, BOX | {"position": 60.0}],
}


def resonances(bodies: list[dict[str, Any]], depth: float = np.inf, tolerance: float = 1e-2, **asked: Any) -> he.Result:
    held = [{"damping": [3e3, 0.0, 0.0]}] if bodies[0] is not LIGHT_BEAM and "motions" in bodies[0] else []
    return he.solve(
        {
            "kind": "sea",
            "liquid": [{"density": 1025.0, "depth": depth}],
            "body": bodies,
            "attachment": held,
            "analysis": [{"kind": "resonance", **asked}],
            "accuracy": {"tolerance": tolerance},
        }
    )


@pytest.mark.slow_but("two floats-0.01")
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("kind", list(BODIES))
def test_as_many_resonances_are_listed_as_are_counted(kind: str, tolerance: float) -> None:
    """Water between bodies has resonances of its own, which are poles of the added mass."""
    result = resonances(BODIES[kind], 12.0 if "apart" in kind else np.inf, tolerance)
    (table,) = result.summary["resonance"]
    assert result.summary["status"] == "ok"
    assert table["counted"] == len(result.modes)


@pytest.mark.slow
def test_resonances_of_the_water_between_far_bodies_are_among_the_lowest() -> None:
    """Waves between two bodies come back in phase where k d is about a multiple of π: far apart, at low frequencies."""
    result = resonances(BODIES["damped floats far apart"], 12.0, count=4)
    table = result.modes
    assert len(table) == result.summary["resonance"][0]["counted"] == 4
    # Of a mesh to 1e-4, which the search near the motions of the bodies alone leaves out: it begins at 1.35.
    assert table.omega[:3] == pytest.approx([0.93514 - 0.31702j, 1.15609 - 0.18567j, 1.35096 - 0.12210j], rel=1e-3)


def test_elastic_tones_far_above_any_wave_are_sought_only_if_asked_for() -> None:
    """The first tone of 67 rad/s bends among waves of 14 mm; a mesh for these took minutes and gigabytes."""
    stiff = {"kind": "beam", "start": 0.0, "length": 10.0, "flexural_rigidity": 1e8, "mass_per_length": 100.0}
    result = resonances([stiff])
    (table,) = result.summary["resonance"]
    assert result.summary["status"] == "ok"
    assert table["counted"] == len(result.modes) >= 1
    # (4.73/l)² √(EI/m) with the added mass of a strip on waves far shorter than it; of a coarse mesh, for one digit.
    assert table["not_sought"] == pytest.approx(67.0, rel=0.05)
    assert "were not sought" in str(result)
    assert result.summary["size"]["dofs"] < 10_000
