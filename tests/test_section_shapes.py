"""Shapes of modes with floats: what curves, sections and fields of results say of each other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from section_tanks import layered, rigid

import hydroelastic as he

LENGTH = 10.0
LOWER, UPPER = (1000.0, 4.0), (800.0, 3.0)
ALL = "heave sway roll"
BOX: dict[str, Any] = {"half_width": 1.2, "half_height": 0.5}
# Upright on the left, lopsided below: heave and roll are coupled.
KEEL = ((-1.0, 0.5), (-1.0, -0.4), (0.3, -0.7), (1.0, -0.4), (1.0, 0.5))
TALL: dict[str, Any] = {"half_width": 0.4, "half_height": 1.0, "unstable": "solve"}


def scene(*bodies: Any, one: bool = False, top: str = "free", **accuracy: Any) -> he.TankScene:
    layers = (LOWER,) if one else (LOWER, UPPER)
    densities, depths = zip(*layers, strict=True)
    accuracy = {"tolerance": 1e-6, "modes": 4} | accuracy
    return layered(*bodies, densities=densities, depths=depths, length=LENGTH, top=top, **accuracy)


def curves(data: Any, start: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """Places and values of the curves whose name starts so, values of shape (modes, places)."""
    found = []
    for name in data:
        if str(name).startswith(start):
            (place,) = [dim for dim in data[name].dims if str(dim).startswith("position")]
            found.append((data[place].values, data[name].values))
    return found


@pytest.mark.parametrize("half_width", [1.0, 0.7])
def test_a_heaving_float_moves_as_a_whole_and_the_water_makes_room(half_width: float) -> None:
    """∫η = −2b a for a heave a of a float 2b wide; a in metres at a generalized mass of 1 kg."""
    circle = rigid("ellipse", 5.0, half_width=half_width, half_height=1.0)
    result = he.solve(scene(circle, one=True))
    data = result.dataset
    contour = (data.contour_of_body_1.values - [5.0, 0.0]) / [half_width, 1.0]
    assert np.hypot(*contour.T) == pytest.approx(1.0, rel=1e-13)
    moved = data.displacement_of_body_1.values
    assert moved[..., 0] == pytest.approx(0.0, abs=1e-15 * np.abs(moved).max())
    heave = moved[:, 0, 1]
    assert moved[..., 1] == pytest.approx(np.tile(heave, (moved.shape[1], 1)).T, abs=1e-13 * np.abs(heave).max())
    volume = sum(np.trapezoid(eta, x, axis=1) for x, eta in curves(data, "elevation_of_free_surface"))
    largest = max(np.abs(eta).max() for _, eta in curves(data, "elevation_of_free_surface"))
    # Trapezoids between samples some 0.05 m apart of waves with k up to 1.3/m, (kh)²/12, of what moves.
    assert volume == pytest.approx(-2.0 * half_width * heave, abs=1e-3 * largest)
    assert np.abs(heave).max() > 0.05 * largest


@pytest.mark.parametrize("boundary", ["exact", "thin"])
def test_the_interface_makes_room_for_the_float(boundary: str) -> None:
    """Under a lid ∫η = −2b a for a heave a of a float 2b wide: the lower liquid keeps its volume."""
    lens = rigid("parabola", 5.0, half_width=0.3, half_height=1.2, boundary=boundary)
    data = he.solve(scene(lens, top="rigid")).dataset
    found = curves(data, "elevation_of_interface")
    volume = sum(np.trapezoid(eta, x, axis=1) for x, eta in found)
    heave = data.displacement_of_body_1.values[:, 0, 1]
    largest = max(np.abs(eta).max() for _, eta in found)
    assert volume == pytest.approx(-2.0 * 0.3 * heave, abs=1e-3 * largest)
    assert np.count_nonzero(np.abs(heave) > 1e-3 * largest) == 2


def liquid_of(result: he.Result, folder: Path) -> Any:
    """The field file of a result."""
    result.save(folder / "result", images=None)
    return meshio.read(folder / "result" / "fields" / "modes.vtu")


@pytest.mark.parametrize(
    "body",
    [rigid("rectangle", 3.7, ALL, **BOX), rigid("polygon", 3.7, ALL, vertices=KEEL)],
    ids=["box", "keel"],
)
def test_liquids_follow_the_side_of_a_float_and_their_levels(tmp_path: Path, body: he.Float) -> None:
    """∂ψ/∂x is the float's displacement to the right on its upright side; ∂ψ/∂y is η from below and from above."""
    result = he.solve(scene(body))
    data, grid = result.dataset, liquid_of(result, tmp_path)
    contour, points = data.contour_of_body_1.values, grid.points
    left = contour[:, 0].min()
    side = np.flatnonzero(contour[:, 0] < left + 1e-9)
    side = side[np.argsort(contour[side, 1])]
    # Away from the corners, where ∇ψ has no bound.
    (on,) = np.nonzero((np.abs(points[:, 0] - left) < 1e-9) & (np.abs(points[:, 1]) < 0.25))
    assert len(on) > 20
    (cells,), (liquid,) = grid.cells, grid.cell_data["liquid"]
    for number in range(4):
        flow = grid.point_data[f"displacement_{number + 1:03d}"]
        moved = data.displacement_of_body_1.values[number]
        expected = np.interp(points[on, 1], contour[side, 1], moved[side, 0])
        # Gradients err like the root of the frequency's error, 1e-6; measured 4e-4.
        assert np.abs(flow[on, 0] - expected).max() <= 2e-3 * np.abs(moved).max()
        for start, height in (("elevation_of_interface", 0.0), ("elevation_of_free_surface", UPPER[1])):
            for x, eta in curves(data, start):
                for layer in (1, 2) if height == 0.0 else (2,):
                    own = np.unique(cells.data[liquid == layer])
                    inside = (points[own, 0] > x.min() + 0.2) & (points[own, 0] < x.max() - 0.2)
                    at = own[(np.abs(points[own, 1] - height) < 1e-12) & inside]
                    assert len(at) > 5
                    # Linear interpolation between samples 0.1 m apart, (k·0.1)²/8 with k = 4π/10: 2e-3.
                    wanted = np.interp(points[at, 0], x, eta[number])
                    assert np.abs(flow[at, 1] - wanted).max() <= 4e-3 * np.abs(eta).max()
    corners = points[cells.data, :2]
    areas = 0.5 * np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    whole = sum(LENGTH * depth for _, depth in (LOWER, UPPER))
    x, y = contour.T
    hull = 0.5 * abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    assert areas.sum() == pytest.approx(whole - hull, rel=1e-10)


@pytest.mark.slow
def test_twin_floats_mirror_each_other() -> None:
    twins = [rigid("rectangle", position, ALL, **BOX | {"half_width": 0.9}) for position in (2.5, 7.5)]
    result = he.solve(scene(*twins))
    data = result.dataset
    corners = [data[f"contour_of_body_{body}"].values - [5.0, 0.0] for body in (1, 2)]
    image = np.abs(corners[1][:, None] * [-1.0, 1.0] - corners[0][None]).max(axis=2).argmin(axis=0)
    for number, mode in enumerate(result.summary["modes"]):
        sign = 1.0 if mode["symmetry"] == "symmetric" else -1.0
        left, right = (data[f"displacement_of_body_{body}"].values[number] for body in (1, 2))
        assert right[image] * [-sign, sign] == pytest.approx(left, abs=1e-12 * np.abs(left).max())


def test_a_growing_roll_turns_anticlockwise_and_hardly_moves_the_water(tmp_path: Path) -> None:
    """It has a name of its own in files; the half and the whole agree on it."""
    found = []
    for shift in (0.0, 1e-8):
        body = rigid("rectangle", 5.0 + shift, ALL, **TALL)
        result = he.solve(scene(body, one=True, modes=2, tolerance=1e-5))
        data = result.dataset
        (names,) = [name for name in data if str(name).startswith("growing") and "displacement_of_body_1" in str(name)]
        moved, contour = data[names].values[0], data.contour_of_body_1.values
        assert moved[contour[:, 0].argmax(), 1] > 0.0
        # It grows too fast for waves: λψ/g is a few percent of the roll.
        grown = curves(data, "growing_elevation")
        waves = max(np.abs(eta).max() for _, eta in grown)
        assert 0.0 < waves < 0.2 * np.abs(moved).max()
        x, y = (contour - [5.0 + shift, 0.0]).T
        found.append(((moved[:, 1] * x - moved[:, 0] * y) / (x * x + y * y)).mean())
    assert found[0] == pytest.approx(found[1], rel=1e-4)
    grid = liquid_of(result, tmp_path)
    names = ("001", "002", "growing_001")
    assert set(grid.point_data) == {f"{kind}_{name}" for kind in ("potential", "displacement") for name in names}
