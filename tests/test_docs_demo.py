"""The page that shows a beam afloat in a tank in UFL and SLEPc gives the frequencies of the reference."""

import json
import runpy
from pathlib import Path

import numpy as np

DEMO = Path(__file__).parents[1] / "docs" / "demo_aquarium.py"
REFERENCE = Path(__file__).parent / "reference" / "aquarium.json"


def test_each_mode_is_within_its_estimate() -> None:
    cases = json.loads(REFERENCE.read_text(encoding="utf-8"))["cases"]
    exact = np.array(next(case for case in cases if case["name"] == "base_s0")["omega"])
    page = runpy.run_path(str(DEMO))
    error, estimate = np.abs(page["omega"][: len(exact)] / exact - 1.0), page["error"][: len(exact)]
    assert np.all(error <= estimate)
    # Ten digits: half a unit of the tenth.
    assert np.all(error[estimate < 1e-10] < 5e-11)
    assert np.count_nonzero(estimate < 1e-10) >= 5
