"""Limits of added mass in WAMIT's file: all finite entries at ω = 0 and ω = ∞, and no others."""

from __future__ import annotations

from math import inf
from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

CYLINDER = {"shape": "cylinder", "radius": 5.0, "draught": 4.0, "motions": ["heave", "surge"]}
SECTION = {"shape": "rectangle", "half_width": 5.0, "half_height": 4.0, "motions": ["heave", "sway"]}


@pytest.mark.slow_but("*cylinder*", "*inf")
@pytest.mark.parametrize(("body", "depth"), [(CYLINDER, 30.0), (SECTION, 30.0), (SECTION, inf)], ids=str)
def test_finite_added_mass_of_the_limits_is_written(body: dict[str, Any], depth: float, tmp_path: Path) -> None:
    width = {} if "radius" in body else {"width": 20.0}
    result = he.solve(
        {
            "kind": "sea",
            "liquid": [{"density": 1000.0, "depth": depth}],
            "body": [{"kind": "float", "vertical_centre_of_gravity": -2.0} | body],
            "analysis": [{"kind": "radiation", "omega": [0.0, 0.5, 1.0, inf]}],
            "export": {"formats": ["wamit"]} | width,
            "accuracy": {"tolerance": 1e-2},
        }
    )
    result.save(tmp_path / "result", images=None)
    rows = [line.split() for line in (tmp_path / "result" / "export" / "bodies.1").read_text().splitlines()]
    written = {(float(row[0]), int(row[1]), int(row[2])): float(row[3]) for row in rows}
    table = result.summary["radiation"][0]
    assert table["dofs"] == ["heave", body["motions"][1]]
    # PER = −1 is ω = 0, PER = 0 is ω = ∞; mode 1 is surge, 3 heave.
    for period, row in ((-1.0, 0), (0.0, 3)):
        (heave, _), (_, along) = table["added_mass"][row]
        # Ten digits are written.
        assert written[period, 1, 1] == pytest.approx(width.get("width", 1.0) * along / 1000.0, rel=1e-8)
        if heave in (None, "inf", inf):
            assert (period, row) == (-1.0, 0)
            assert (period, 3, 3) not in written
        else:
            assert written[period, 3, 3] == pytest.approx(width.get("width", 1.0) * heave / 1000.0, rel=1e-8)
    assert {period for period, _, _ in written} >= {-1.0, 0.0}
