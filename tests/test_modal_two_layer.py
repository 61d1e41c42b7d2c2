"""Interface waves: against the determinant in 60 digits, the reference tank, and limits."""

from __future__ import annotations

import json
import math
from decimal import Decimal, localcontext
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.modal.liquid.two_layer import InterfacePlate, TwoLayers, interface_frequencies, tank_modes

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_liquid_beam.json").read_text(encoding="utf-8"))
ROUNDING = 8 * np.finfo(float).eps
"""A dozen operations, halved by the square root."""


def layers(**changes: object) -> TwoLayers:
    values = {"density_below": 1.0, "density_above": 0.8, "depth_below": 2.0, "depth_above": 1.5, "gravity": 9.81}
    return TwoLayers(**(values | {"top": "free"} | changes))


def exact_roots(two: TwoLayers, wavenumber: float, plate: InterfacePlate | None) -> list[Decimal]:
    """Both ω² of the free-top determinant, slow one first, in 60 digits from the floats as given."""
    with localcontext() as context:
        context.prec = 60
        k, g = Decimal(wavenumber), Decimal(two.gravity)
        lower, upper = Decimal(two.density_below), Decimal(two.density_above)
        coth, cosech = [], []
        for depth in (two.depth_below, two.depth_above):
            growth, decay = (k * Decimal(depth)).exp(), (-k * Decimal(depth)).exp()
            coth.append((growth + decay) / (growth - decay))
            cosech.append(2 / (growth - decay))
        stiffness, mass = (lower - upper) * g, Decimal(0)
        if plate is not None:
            stiffness = stiffness * plate.hydrostatic + Decimal(plate.flexural_rigidity) * k**4
            mass = Decimal(plate.mass_per_length)
        total = mass + (upper * coth[1] + lower * coth[0]) / k
        a = total * coth[1] / k - upper * cosech[1] ** 2 / k**2
        b = stiffness * coth[1] / k + g * total
        c = stiffness * g
        root = (b * b - 4 * a * c).sqrt()
        return [(b - root) / (2 * a), (b + root) / (2 * a)]


@pytest.mark.parametrize("density_above", [0.999_9, 1 - 1e-9, 0.8, 1e-3, 1e-9])
@pytest.mark.parametrize(("below", "above"), [(1.0, 1.0), (1.0, 100.0), (100.0, 1.0), (1.0, 1.0 + 1e-9)])
@pytest.mark.parametrize("wavenumber", [1e-6, 0.01, 1.0, 30.0])
def test_free_top_keeps_its_relative_precision(
    density_above: float, below: float, above: float, wavenumber: float
) -> None:
    two = layers(density_above=density_above, depth_below=below, depth_above=above)
    found = interface_frequencies(two, wavenumber)
    slow, fast = exact_roots(two, wavenumber, None)
    assert float(found["internal"]) == pytest.approx(float(slow.sqrt()), rel=ROUNDING)
    assert float(found["surface"]) == pytest.approx(float(fast.sqrt()), rel=ROUNDING)


@pytest.mark.parametrize("hydrostatic", [True, False])
@pytest.mark.parametrize("rigidity", [1e-6, 0.3, 1e5])
def test_plate_under_a_free_top(rigidity: float, hydrostatic: bool) -> None:
    plate = InterfacePlate(flexural_rigidity=rigidity, mass_per_length=0.2, hydrostatic=hydrostatic)
    for wavenumber in (0.01, 1.0, 20.0):
        found = interface_frequencies(layers(), wavenumber, plate)
        slow, fast = exact_roots(layers(), wavenumber, plate)
        assert float(found["internal"]) == pytest.approx(float(slow.sqrt()), rel=ROUNDING)
        assert float(found["surface"]) == pytest.approx(float(fast.sqrt()), rel=ROUNDING)


def test_roots_are_the_eigenvalues_of_the_motions_and_the_fast_ones_move_in_phase() -> None:
    # The pencil of the theory, § 1, from the potential itself: ψ₁ with the slopes ζ at y = 0 and η at y = h₁.
    two, k = layers(density_above=0.7), 1.3
    plane = np.array([0.0, two.depth_above])
    values = []
    for slopes in ((1.0, 0.0), (0.0, 1.0)):
        # ψ₁ = A cosh ky + B sinh ky
        matrix = k * np.array([np.sinh(k * plane), np.cosh(k * plane)]).T
        first, second = np.linalg.solve(matrix, slopes)
        values.append(first * np.cosh(k * plane) + second * np.sinh(k * plane))
    upper = two.density_above * np.array([[-values[0][0], -values[1][0]], [values[0][1], values[1][1]]])
    lower = np.diag([two.density_below / (k * math.tanh(k * two.depth_below)), 0.0])
    stiffness = 9.81 * np.diag([two.density_below - two.density_above, two.density_above])
    squares, shapes = np.linalg.eig(np.linalg.solve(upper + lower, stiffness))
    order = np.argsort(squares)
    found = interface_frequencies(two, k)
    np.testing.assert_allclose(np.sqrt(squares[order]), [found["internal"], found["surface"]], rtol=1e-13)
    slow, fast = shapes[:, order].T
    assert slow[0] * slow[1] < 0
    assert fast[0] * fast[1] > 0


def test_limits_of_one_liquid() -> None:
    k = np.array([0.01, 0.7, 40.0])
    single = np.sqrt(9.81 * k * np.tanh(2 * k))
    for top in ("free", "rigid", "pressure_release"):
        none = interface_frequencies(layers(density_above=0.0, top=top), k)
        assert list(none) == ["surface"]
        np.testing.assert_allclose(none["surface"], single, rtol=ROUNDING)
        # First order in ρ₁/ρ₂ except where both waves of a free top coincide; the lid has coth kh₁/kh₁ besides.
        light = interface_frequencies(layers(density_above=1e-14, top=top), k)
        nearest = np.min([np.abs(values / single - 1) for values in light.values()], axis=0)
        assert nearest.max() < 1e-6
    # Equal liquids under a free top are one, of depth h₁ + h₂; ρ₂ − ρ₁ = 1e-12 changes it in proportion.
    both = interface_frequencies(layers(density_above=1 - 1e-12), k)["surface"]
    np.testing.assert_allclose(both, np.sqrt(9.81 * k * np.tanh(3.5 * k)), rtol=1e-11)


def test_limits_of_long_and_short_waves() -> None:
    # Long: √(g' h₁h₂/(h₁ + …)) of the lid, error (kh)²/6; the two speeds under a free top solve Stoner's quadratic.
    k = 1e-5
    lid = interface_frequencies(layers(top="rigid"), k)["internal"] / k
    assert float(lid) == pytest.approx(math.sqrt(0.2 * 9.81 / (0.8 / 1.5 + 1 / 2)), rel=1e-9)
    free = interface_frequencies(layers(), k)
    speeds = [float(free[branch] / k) ** 2 for branch in ("internal", "surface")]
    assert sum(speeds) == pytest.approx(9.81 * 3.5, rel=1e-9)
    assert speeds[0] * speeds[1] == pytest.approx(9.81**2 * 0.2 * 3.0, rel=1e-9)
    # Short and deep: g* k inside, g k on top, whatever closes the upper liquid.
    for top in ("free", "rigid", "pressure_release"):
        deep = layers(depth_below=math.inf, depth_above=math.inf, top=top)
        for two, number in ((deep, 0.3), (layers(top=top), 400.0)):
            found = interface_frequencies(two, number)
            assert float(found["internal"]) == pytest.approx(math.sqrt(9.81 * 0.2 / 1.8 * number), rel=ROUNDING)
            if top == "free":
                assert float(found["surface"]) == pytest.approx(math.sqrt(9.81 * number), rel=ROUNDING)


def test_reference_tank_without_a_beam() -> None:
    row = next(row for row in REFERENCE["rows"] if row["case"] == "K_no_beam")
    two = TwoLayers(
        density_below=row["rho2"],
        density_above=row["rho1"],
        depth_below=row["h2_bottom"],
        depth_above=row["h1_top"],
        gravity=9.81,
    )
    modes = tank_modes(two, row["L"], 8)
    expected = [row[f"w{number}"] for number in range(1, 9)]
    # Eight significant digits are given.
    np.testing.assert_allclose([mode.omega for mode in modes], expected, rtol=5e-8)
    assert [(mode.branch, mode.number) for mode in modes] == [("internal", number) for number in range(1, 9)]


@pytest.mark.parametrize("top", ["rigid", "pressure_release"])
def test_guided_plate_on_the_interface(top: str) -> None:
    plate = InterfacePlate(flexural_rigidity=2.0, mass_per_length=0.3)
    k = 2 * math.pi / 4
    upper = 0.8 / math.tanh(1.5 * k) if top == "rigid" else 0.8 * math.tanh(1.5 * k)
    loads = (upper + 1 / math.tanh(2 * k)) / k
    expected = math.sqrt((2.0 * k**4 + 0.2 * 9.81) / (0.3 + loads))
    modes = tank_modes(layers(top=top), 4.0, 2, plate)
    assert modes[1].omega == pytest.approx(expected, rel=ROUNDING)
