"""Bodies far smaller than the waves."""

from __future__ import annotations

import resource

import pytest

import hydroelastic as he


def test_the_spectrum_of_a_plate_of_five_centimetres_takes_little_memory() -> None:
    """Its drift is rounding: orders are not added for its sake without an end, as they were up to gigabytes."""
    plate = {"kind": "plate", "outline": "disc", "radius": 0.05, "youngs_modulus": 3e9, "thickness": 0.004}
    before = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    result = he.solve(
        {
            "kind": "sea",
            "liquid": [{"density": 1000.0, "depth": float("inf")}],
            "body": [plate | {"density": 900.0}],
            "analysis": [
                {"kind": "spectrum", "waves": "jonswap", "significant_height": 2.0, "peak_period": 8.0}
                | {"highest_omega": 3.0}
            ],
            "accuracy": {"tolerance": 1e-2},
        }
    )
    (table,) = result.summary["spectrum"]
    heave = next(one for one in table["responses"] if one["quantity"] == "heave")
    # It follows the waves: Hs/2, but for the 1 % of the waves above 3 rad/s, nearly four times the peak's frequency.
    assert heave["significant_amplitude"] == pytest.approx(1.0, rel=1e-2)
    assert abs(table["mean_drift_force"]) <= table["mean_drift_error"]
    # 250 MiB in a process of its own, 200 of them libraries; without a bound of the orders it was 6.8 GB.
    assert result.summary["memory_peak"] - before < 0.6e9
    # Much of what bends so small a plate comes from shorter waves: that is told, with what to do.
    assert result.summary["status"] == "unconverged"
    assert any("raise highest_omega" in reason for reason in result.summary["reasons"])
