"""How far an exponential float with an end is from the paper's one of infinite draught, and the poles of that one."""

from __future__ import annotations

import json
from math import inf
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.modal.floats.infinite_draught import infinite_draught_float
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))[
        "cases"
    ]
}


@pytest.mark.parametrize("name", ["pole_exp_eps0.1", "pole_exp_eps1"])
def test_poles_and_residues(name: str) -> None:
    case = CASES[name]
    height, gravity = 2.0, 9.81
    profile = Profile(
        shape="exponential", half_width=height * float(case["inputs"]["tau"]), half_height=height, tail=1e-3
    )
    layers = TwoLayers(density_below=1000.0, density_above=800.0, depth_below=inf, depth_above=inf, gravity=gravity)
    found = infinite_draught_float(profile, layers)
    rate = np.sqrt(gravity / 9.0 / height)
    for number in (1, 2):
        pole, residue = (complex(*map(float, case["values"][f"{key}{number}"])) for key in ("z", "res"))
        # The reference has 20 digits, Newton's method 15.
        assert found.resonances[number - 1] == pytest.approx(1j * pole.conjugate() * rate, rel=1e-13)
        assert found.residues[number - 1] == pytest.approx(residue.conjugate(), rel=1e-12)
