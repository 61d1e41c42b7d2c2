"""Pictures of two liquids and of floats: scales, sections and what is written beside them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.fem.pictures.mode import FloatSection, ModePicture, SurfaceCurve
from hydroelastic.fem.sampling import SurfaceTrace
from hydroelastic.output.pictures.colours import BODY, FREE_SURFACE, INTERFACE, LOWER_WASH, UPPER_WASH
from hydroelastic.output.pictures.floats import up_to_floats
from hydroelastic.output.pictures.modes import draw_mode, draw_overview
from hydroelastic.output.pictures.notes import scale_notes
from hydroelastic.output.pictures.view import view_of

WIDTH = 800
UNIT = WIDTH / 1600
FOOTER = round(285 * UNIT)
SQUARE = np.array([[4.0, -0.5], [5.0, -0.5], [5.0, 0.5], [4.0, 0.5]])


def layer(low: float, high: float, length: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a rectangle."""
    x, y = np.meshgrid(np.linspace(0.0, length, 41), np.linspace(low, high, 21))
    corner = (np.arange(20)[:, None] * 41 + np.arange(40)).ravel()
    triangles = [
        np.column_stack([corner, corner + 1, corner + 42]),
        np.column_stack([corner, corner + 42, corner + 41]),
    ]
    return np.column_stack([x.ravel(), y.ravel()]), np.vstack(triangles)


def layered_picture(
    *, length: float = 10.0, depths: tuple[float, float] = (4.0, 3.0), lid: bool = False
) -> ModePicture:
    """A wave between two liquids, ψ₂ = cos kx e^{ky} and ψ₁ = −cos kx e^{−ky}: its interface rises by k cos kx."""
    lower, first = layer(-depths[0], 0.0, length)
    upper, second = layer(0.0, depths[1], length)
    k = np.pi / length
    points = np.vstack([lower, upper])
    sign = np.where(np.arange(len(points)) < len(lower), 1.0, -1.0)
    decay = np.exp(-k * np.abs(points[:, 1]))
    x = np.linspace(0.0, length, 50)
    curves = [SurfaceCurve(kind="interface", x=x, displacement=k * np.cos(k * x))]
    if not lid:
        curves.append(SurfaceCurve(kind="free_surface", x=x, displacement=-0.1 * k * np.cos(k * x), level=depths[1]))
    return ModePicture(
        points=points,
        triangles=np.vstack([first, second + len(lower)]),
        potential=sign * np.cos(k * points[:, 0]) * decay,
        displacement=k * decay[:, None] * np.column_stack([-sign * np.sin(k * points[:, 0]), np.cos(k * points[:, 0])]),
        surfaces=tuple(curves),
        title="Mode 1: ω = 0.5 rad/s",
        length=length,
        depth=depths[0],
        upper_depth=depths[1],
        densities=(1000.0, 850.0),
        lid=((0.0, length),) if lid else (),
    )


def floating_picture(heave: float) -> ModePicture:
    """A square that heaves between surfaces at rest."""
    picture = layered_picture(lid=True)
    curves = tuple(
        SurfaceCurve(kind="interface", x=np.linspace(*ends, 20), displacement=np.zeros(20))
        for ends in ((0.0, 4.0), (5.0, 10.0))
    )
    section = FloatSection(contour=SQUARE, displacement=np.tile([0.0, heave], (4, 1)), waterplane=(4.0, 5.0))
    return replace(picture, surfaces=curves, floats=(section,))


def drawn(picture: ModePicture, folder: Path) -> np.ndarray:
    """Pixels in 0…255 above the legend, shape (height, width, 3), the uppermost row first."""
    from matplotlib.image import imread

    path = folder / "mode.png"
    draw_mode(picture, path, width=WIDTH)
    image = np.round(255 * imread(path)[:, :, :3]).astype(int)
    return image[: len(image) - FOOTER]


def has_colour(image: np.ndarray, colour: str) -> np.ndarray:
    """Where the pixels have a colour, up to the rounding of the renderer."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return np.abs(image - rgb).max(axis=2) <= 2


def test_two_liquids_show_their_interface_their_top_and_their_colours(tmp_path: Path) -> None:
    image = drawn(layered_picture(), tmp_path)
    interface, top = (np.nonzero(has_colour(image, colour))[0] for colour in (INTERFACE, FREE_SURFACE))
    assert len(interface) > 30
    assert len(top) > 30
    # The free surface lies the depth of the upper liquid above the interface: 3 m at 60.25 pixels a metre.
    pixels = (WIDTH - (230 + 120) * UNIT) / 10.0
    assert interface.mean() - top.mean() == pytest.approx(3.0 * pixels, rel=0.1)
    # Swatches beside the densities.
    for colour in (LOWER_WASH, UPPER_WASH):
        assert has_colour(image, colour)[:, -round(200 * UNIT) :].sum() > 100


def test_the_colours_are_those_of_the_pressure() -> None:
    picture = layered_picture()
    lower = picture.points[:, 1] < 0.0
    assert picture.drawn_field[lower] == pytest.approx(1000.0 * picture.potential[lower])
    upper = picture.points[:, 1] > 0.0
    assert picture.drawn_field[upper] == pytest.approx(850.0 * picture.potential[upper])
    one = replace(picture, upper_depth=0.0, densities=())
    assert (one.drawn_field == one.potential).all()


def test_a_lid_is_drawn_where_the_top_is_rigid(tmp_path: Path) -> None:
    half = replace(layered_picture(lid=True), lid=((0.0, 5.0),))
    dark = has_colour(drawn(half, tmp_path), "#3c3c3c").sum(axis=1)
    # 5 m of the tank's 10 m in 625 pixels, and both walls.
    assert dark.max() == pytest.approx(0.5 * (WIDTH - 350 * UNIT) + 2 * 5 * UNIT, abs=3)
    assert dark.argmax() < round(100 * UNIT)
    # Nothing but walls and letters where the top is open.
    assert has_colour(drawn(layered_picture(), tmp_path), "#3c3c3c").sum(axis=1).max() < 20


def test_float_is_displaced_by_the_stated_scale(tmp_path: Path) -> None:
    rows = {}
    for heave in (1.0, -1.0):
        rows[heave] = np.nonzero(has_colour(drawn(floating_picture(heave), tmp_path), BODY))[0].mean()
    view = view_of(floating_picture(1.0))
    pixels_per_metre = (WIDTH - 350 * UNIT) / view.length
    # Dashes of the place at rest shift the mean of what is orange by less than a pixel.
    assert rows[-1.0] - rows[1.0] == pytest.approx(2.0 * view.surface_scale * pixels_per_metre, abs=2.0)


def test_floats_stay_near_their_place_and_the_scale_is_stated() -> None:
    picture = floating_picture(2.0)
    view = view_of(picture)
    # A quarter of its height of 1 m, where 0.1 of the tank's length would be a whole one.
    assert 2.0 * view.surface_scale == pytest.approx(0.25)
    assert "×0.125" in scale_notes(view, picture)


def test_an_overview_names_the_pressure(tmp_path: Path) -> None:
    draw_overview([layered_picture(), floating_picture(1.0)], tmp_path / "all.png", width=WIDTH)
    assert (tmp_path / "all.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("length", "depths", "lid", "note"),
    [
        (1.0, (0.5, 0.005), False, "vertical scale ×1 in the lower and ×20 in the upper liquid"),
        (1.0, (0.005, 0.5), True, "vertical scale ×20 in the lower and ×1 in the upper liquid"),
        (1.0, (5.0, 5.0), True, "only −0.8 m < y < 0.8 m of −5 m < y < 5 m shown"),
        (1.0, (5.0, 5.0), False, "vertical scale ×0.3, also of the vectors; only −0.8 m < y < 5 m of"),
        (100.0, (2.0, 1.0), False, "vertical scale ×8"),
        (10.0, (4.0, 3.0), False, "surface displacement"),
    ],
)
def test_thin_and_deep_layers_fit_and_say_how(
    tmp_path: Path, length: float, depths: tuple[float, float], lid: bool, note: str
) -> None:
    picture = layered_picture(length=length, depths=depths, lid=lid)
    view = view_of(picture)
    assert scale_notes(view, picture).startswith(note)
    for drawn_depth in (view.stretch * view.depth, view.upper_stretch * view.upper_depth):
        assert drawn_depth >= 0.05 * length
        # Neither surface reaches the other side of its liquid.
        assert view.rise * view.amplitude < 0.5 * drawn_depth
    assert has_colour(drawn(picture, tmp_path), INTERFACE).sum() > 30


def test_the_page_is_stretched_on_either_side_of_the_interface() -> None:
    view = view_of(layered_picture(length=1.0, depths=(0.5, 0.005)))
    ys = view.drawn(np.array([-0.5, 0.0, 0.005, 0.105]))
    # 0.5 m at ×1, 5 mm at ×20, and above the top ×1 again.
    assert ys == pytest.approx([-0.5, 0.0, 0.1, 0.2])


def test_surfaces_go_on_to_the_displaced_float() -> None:
    picture = floating_picture(1.0)
    view = replace(view_of(picture), surface_scale=1.0)
    moved = replace(picture.floats[0], displacement=np.tile([0.3, 0.0], (4, 1)))
    left, right = (up_to_floats(curve, (moved,), view) for curve in picture.surfaces)
    # The float has gone 0.3 m to the right: there the left surface meets it, and the right one goes on behind it.
    assert left.x[-1] == pytest.approx(4.3)
    assert (right.x[:2] <= 5.0).all()
    assert view.displaced(moved)[0] == pytest.approx([4.3, -0.5])
    # One that has gone up and away meets nothing.
    lifted = replace(moved, displacement=np.tile([0.0, 2.0], (4, 1)))
    assert up_to_floats(picture.surfaces[0], (lifted,), view).x[-1] == 4.0


def test_a_trace_has_both_values_at_a_slit() -> None:
    # Facets from 0 to 1 and from 1 to 2, with a slit at 1 where ψ jumps from 5 to −5.
    trace = SurfaceTrace(
        x=np.array([[0.0, 0.5, 1.0], [1.0, 1.5, 2.0]]), potential=np.array([[[3.0, 4.0, 5.0], [-5.0, -4.0, -3.0]]])
    )
    for ends, expected in (((0.0, 1.0), [3.0, 4.0, 5.0]), ((1.0, 2.0), [-5.0, -4.0, -3.0])):
        x, potential = trace.between(*ends)
        assert x == pytest.approx(np.linspace(*ends, 3))
        assert potential[0] == pytest.approx(expected)
    assert len(trace.between(0.0, 2.0)[0]) == 5


def test_arrays_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="one shape"):
        FloatSection(contour=SQUARE, displacement=SQUARE[1:], waterplane=(4.0, 5.0))
    with pytest.raises(ValueError, match="finite"):
        FloatSection(contour=SQUARE, displacement=np.full((4, 2), np.nan), waterplane=(4.0, 5.0))
    with pytest.raises(ValueError, match="densities"):
        replace(layered_picture(), densities=())
