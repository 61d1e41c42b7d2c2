"""Released floats in open water: closed forms of circle and thin float, tails, what is refused."""

from __future__ import annotations

from math import inf, pi
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from open_cases import answer, sea, stored

import hydroelastic as he
from hydroelastic.modal.floats.open_float import released_float
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile

STORED = stored("open_circle.json")["release"]
G = 9.81


def _scene(
    tolerance: float, *, densities: tuple[float, ...] = (1000.0,), depth: float = inf, **keys: Any
) -> dict[str, Any]:
    given = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0} | keys
    return sea(given, liquid=[{"density": density, "depth": depth} for density in densities], tolerance=tolerance)


def _released(scene: dict[str, Any], times: Any, **release: float) -> SimpleNamespace:
    """The table, with the largest error as a part of the displacement at first."""
    asked = release or {"heave": 0.1}
    (table,) = answer(scene, {"kind": "decay", "displacement": asked, "times": [float(t) for t in times]}).decay
    table.error = table.absolute_error.max() / sum(asked.values())
    return table


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_circle_in_deep_water(tolerance: float) -> None:
    times = np.array(STORED["t"]) / np.sqrt(G)
    found = _released(_scene(tolerance), times)
    error = np.abs(found.displacement[:, 0] / 0.1 - STORED["s"])
    # In parts of the displacement at first; the reference has 8e-12.
    assert error.max() < found.error < tolerance
    assert np.all(error < 3.0 * found.absolute_error / 0.1)
    # Ursell: -(4/pi) a/(g t^2) of the displacement, from the series of long waves.
    assert found.tail == pytest.approx(-4.0 / pi / G * 0.1, rel=1e-3)


@pytest.mark.slow
def test_motions_that_nothing_restores_add_no_error() -> None:
    """A circle that may sway: by symmetry it does not, and the error of the heave is as without."""
    times = np.array(STORED["t"]) / np.sqrt(G)
    found = _released(_scene(1e-4, motions=["heave", "sway"]), times)
    assert found.dofs == ["heave", "sway"]
    assert np.abs(found.displacement[:, 0] / 0.1 - STORED["s"]).max() < found.error < 1e-4


@pytest.mark.slow_on_ranks_but
@pytest.mark.slow_but("densities0")
@pytest.mark.mpi
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0)])
def test_thin_float_with_its_tail(densities: tuple[float, ...]) -> None:
    scene = _scene(1e-3, densities=densities, shape="parabola", half_width=0.1, boundary="thin")
    layers = TwoLayers(density_below=densities[0], density_above=sum(densities[1:]), depth_below=inf, gravity=G)
    reduced = G * (densities[0] - sum(densities[1:])) / sum(densities)
    times = np.array([0.0, 0.5, 3.0, 20.0, 100.0, 5000.0]) / np.sqrt(reduced)
    found = _released(scene, times)
    expected = released_float(float_profile("parabola", 0.1, 1.0), layers, times).heave
    error = np.abs(found.displacement[:, 0] / 0.1 - expected)
    assert error.max() < 1e-3
    # Long after the oscillation has gone the inverse square is left, with its sign, to a few per mille.
    assert expected[-1] < 0.0
    assert error[-1] < 5e-3 * abs(expected[-1])
    assert found.tail == pytest.approx(-4.0 / pi * 0.1 / reduced * 0.1, rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_long_exponential_between_two_liquids(tolerance: float) -> None:
    """Twenty decay lengths on either side: the basin is tall, and waves above those of the mesh count."""
    layers = TwoLayers(density_below=1000.0, density_above=800.0, depth_below=inf, gravity=G)
    times = np.array([0.0, 0.5, 3.0, 20.0, 100.0, 10000.0])
    scene = _scene(
        tolerance, densities=(1000.0, 800.0), shape="exponential", half_width=0.554, tail=1e-9, boundary="thin"
    )
    found = _released(scene, times)
    expected = released_float(float_profile("exponential", 0.554, 1.0, 1e-9), layers, times).heave
    error = np.abs(found.displacement[:, 0] / 0.1 - expected)
    # Never below the error, and not far above it: of a sum of magnitudes a twentieth counts, at 1e-3 a sixtieth.
    assert error.max() < found.error < tolerance
    assert np.all(error < 3.0 * found.absolute_error / 0.1)
    assert found.error < 100.0 * error.max()


@pytest.mark.slow
def test_no_such_tail_over_a_bed() -> None:
    scene = _scene(1e-3, depth=2.0, shape="parabola", half_width=0.1, boundary="thin")
    assert _released(scene, np.array([1.0])).tail is None


@pytest.mark.slow
def test_roll_dies_out_too() -> None:
    scene = _scene(1e-2, half_width=2.0, motions=("heave", "roll"), centre_of_mass=-0.2)
    found = _released(scene, np.array([0.0, 2.0, 40.0]), roll=0.05)
    heave, roll = found.displacement.T
    assert roll[0] == pytest.approx(0.05, abs=5e-5)
    # A symmetric section rolls without heaving.
    assert np.abs(heave).max() < 1e-6
    assert abs(roll[-1]) < abs(roll[1]) < 0.05


@pytest.mark.parametrize(
    ("keys", "release", "words"),
    [
        ({"motions": ["heave", "roll"], "centre_of_mass": 0.5, "unstable": "solve"}, {"heave": 0.1}, "capsize"),
        (
            {"half_width": 2.0, "motions": ["heave", "sway", "roll"], "centre_of_mass": -0.2},
            {"roll": 0.05},
            "excites sway, without restoring force",
        ),
    ],
)
def test_what_does_not_come_back_is_refused(keys: dict[str, Any], release: dict[str, float], words: str) -> None:
    with pytest.raises(he.SceneError, match=words):
        _released(_scene(1e-3, **keys), [1.0], **release)
