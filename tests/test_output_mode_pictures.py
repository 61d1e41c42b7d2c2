"""Pictures of modes: measured in the pixels that were written."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from eyes import EYES, lab
from matplotlib import colormaps
from mode_pictures import has_colour, heave_picture, pixels, sloshing_picture
from PIL import Image

from hydroelastic.fem.pictures.mode import ModePicture, SurfaceCurve
from hydroelastic.output.pictures import rendering
from hydroelastic.output.pictures.colours import BODY, FREE_SURFACE, SEQUENCE, mode_colours
from hydroelastic.output.pictures.modes import draw_mode, draw_overview
from hydroelastic.output.pictures.notes import scale_notes, short_number
from hydroelastic.output.pictures.page import new_page, round_ticks, save, tick_labels
from hydroelastic.output.pictures.page import pixels as pixels_of_page
from hydroelastic.output.pictures.raster import Raster
from hydroelastic.output.pictures.rendering import NoRendererError
from hydroelastic.output.pictures.tank import drawn_vectors, iso_levels
from hydroelastic.output.pictures.view import view_of

WIDTH = 800
UNIT = WIDTH / 1600
FOOTER = round(285 * UNIT)


def drawn(picture: ModePicture, folder: Path, width: int = WIDTH) -> np.ndarray:
    """Pixels in 0…255, shape (height, width, 3), the uppermost row first."""
    path = folder / "mode.png"
    draw_mode(picture, path, width=width)
    return pixels(path)


def tank_part(image: np.ndarray) -> np.ndarray:
    """The image without the legend."""
    return image[: len(image) - FOOTER]


def test_picture_has_the_size_and_shows_body_free_surface_and_field(tmp_path: Path, capfd: pytest.CaptureFixture[str]):
    image = drawn(sloshing_picture(), tmp_path)
    assert image.shape[1] == WIDTH
    # The depth of 4 m and 1.35 times the amplitude of 0.64 m at 68.5 pixels per metre, and margins of 185 pixels.
    assert image.shape[0] == pytest.approx(0.5 * (1600 - 230) * (4.0 + 1.35 * 0.64) / 10.0 + 185, abs=1)
    assert (image[[0, 0, -1, -1], [0, -1, 0, -1]] == 255).all()
    assert image.std() > 20
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 500
    assert has_colour(tank_part(image), BODY).sum() > 500
    # Three pixels thin, the line keeps its pure colour only where it is flat.
    assert has_colour(tank_part(image), FREE_SURFACE).sum() > 30
    assert capfd.readouterr().err == ""


def test_only_what_exists_is_drawn(tmp_path: Path):
    without_body = drawn(sloshing_picture(body=None), tmp_path)
    assert not has_colour(without_body, BODY).any()
    assert has_colour(without_body, FREE_SURFACE).any()
    covered = drawn(sloshing_picture(body=(0.0, 1.0)), tmp_path)
    assert not has_colour(covered, FREE_SURFACE).any()
    assert has_colour(covered, BODY).any()


def test_body_is_displaced_by_the_stated_scale(tmp_path: Path):
    rows = {}
    for sign in (1.0, -1.0):
        image = tank_part(drawn(heave_picture(sign), tmp_path))
        rows[sign] = np.nonzero(has_colour(image, BODY))[0].mean()
    view = view_of(heave_picture(1.0))
    pixels_per_metre = (WIDTH - 230 * UNIT) / view.length
    # The scale times a displacement of 1 up and of 1 down; rows are counted downwards. A row is a pixel.
    assert rows[-1.0] - rows[1.0] == pytest.approx(2.0 * view.surface_scale * pixels_per_metre, abs=1.5)


def test_opposite_potential_swaps_the_colours(tmp_path: Path):
    picture = sloshing_picture(number=1)
    image = tank_part(drawn(picture, tmp_path))
    opposite = tank_part(drawn(replace(picture, potential=-picture.potential), tmp_path))
    middle = WIDTH // 2

    def greenness(part: np.ndarray) -> float:
        return float((part[:, :, 1] - 0.5 * (part[:, :, 0] + part[:, :, 2])).mean())

    assert greenness(image[:, :middle]) > 3 > -3 > greenness(image[:, middle + 50 :])
    assert greenness(opposite[:, :middle]) < -3 < 3 < greenness(opposite[:, middle + 50 :])


@pytest.mark.parametrize(
    ("length", "depth", "note"),
    [
        (200.0, 1.0, "vertical scale ×40"),
        (12.0, 1.0, "vertical scale ×3"),
        (1.0, 10.0, "only the upper 1.25 m of 10 m of liquid shown"),
    ],
)
def test_extreme_tanks_fit_and_say_how(tmp_path: Path, length: float, depth: float, note: str):
    picture = sloshing_picture(length=length, depth=depth)
    image = drawn(picture, tmp_path)
    assert 0.35 * WIDTH < image.shape[0] < 1.05 * WIDTH
    assert has_colour(tank_part(image), BODY).sum() > 200
    assert note in scale_notes(view_of(picture), picture)


def test_liquid_at_rest_can_be_drawn(tmp_path: Path):
    picture = sloshing_picture()
    surfaces = tuple(replace(curve, displacement=np.zeros_like(curve.x)) for curve in picture.surfaces)
    rest = replace(picture, potential=0 * picture.potential, displacement=0 * picture.displacement, surfaces=surfaces)
    assert has_colour(drawn(rest, tmp_path), BODY).any()
    assert "do not move" in scale_notes(view_of(rest), rest)


def test_overview_has_a_panel_for_each_mode(tmp_path: Path, capfd: pytest.CaptureFixture[str]):
    pictures = [sloshing_picture(number=number) for number in range(1, 6)]
    path = tmp_path / "modes.png"
    draw_overview(pictures, path, columns=2, width=WIDTH)
    image = pixels(path)
    assert image.shape[1] == WIDTH
    body = has_colour(image, BODY)
    panels = [
        body[row : row + len(image) // 3, column : column + WIDTH // 2].any()
        for row in (0, len(image) // 3, 2 * len(image) // 3 - 10)
        for column in (0, WIDTH // 2)
    ]
    assert all(panels[:5])
    # The sixth place stays empty, above the legend.
    assert not body[-len(image) // 4 : -round(100 * UNIT), WIDTH // 2 :].any()
    assert capfd.readouterr().err == ""


def test_missing_folder_wrong_name_and_width_are_refused(tmp_path: Path):
    picture = sloshing_picture()
    with pytest.raises(FileNotFoundError, match=r"absent.*does not exist"):
        draw_mode(picture, tmp_path / "absent" / "mode.png")
    with pytest.raises(FileNotFoundError, match=r"absent.*does not exist"):
        draw_overview([picture], tmp_path / "absent" / "mode.png")
    with pytest.raises(ValueError, match=r"ends in \.png"):
        draw_mode(picture, tmp_path / "mode.pdf")
    with pytest.raises(ValueError, match="400 pixels"):
        draw_mode(picture, tmp_path / "mode.png", width=300)
    with pytest.raises(ValueError, match="at least one picture"):
        draw_overview([], tmp_path / "mode.png")
    with pytest.raises(ValueError, match="at least one column"):
        draw_overview([picture], tmp_path / "mode.png", columns=0)


def test_arrays_that_do_not_fit_are_named_together():
    picture = sloshing_picture()
    with pytest.raises(ValueError, match=r"potential.*displacement.*triangles"):
        replace(
            picture, potential=picture.potential[1:], displacement=picture.potential, triangles=picture.triangles[:, :2]
        )
    with pytest.raises(ValueError, match="finite"):
        replace(picture, potential=np.full_like(picture.potential, np.nan))
    with pytest.raises(ValueError, match="positive"):
        replace(picture, depth=0.0)
    with pytest.raises(ValueError, match="one shape"):
        SurfaceCurve(kind="body", x=np.zeros(3), displacement=np.zeros(2))
    with pytest.raises(ValueError, match="finite"):
        SurfaceCurve(kind="body", x=np.arange(2.0), displacement=np.array([0.0, np.inf]))


def test_absent_renderer_is_an_error_and_not_a_crash(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(rendering, "_MESA_LIBRARIES", ("libabsent-of-this-computer.so",))
    with pytest.raises(NoRendererError, match="libegl1"):
        rendering._require_renderer("vtkOSOpenGLRenderWindow")


def test_scale_is_a_share_of_the_tank():
    for length, depth in ((10.0, 4.0), (10.0, 9.0), (200.0, 1.0), (1.0, 10.0)):
        picture = sloshing_picture(length=length, depth=depth)
        view = view_of(picture)
        largest = max(np.abs(curve.displacement).max() for curve in picture.surfaces)
        assert view.surface_scale * largest == pytest.approx(0.1 * min(length, 1.6 * view.depth), rel=1e-12)
        assert view.headroom > view.surface_scale * largest


def test_singular_vectors_are_shortened_and_keep_their_direction():
    vectors = np.column_stack([np.ones(20), np.zeros(20)])
    vectors[3] = [0.0, 1e6]
    vectors[4] = [0.5, 0.0]
    scaled = drawn_vectors(vectors, 40.0)
    assert np.hypot(*scaled.T).max() <= 40.0
    assert scaled[3] == pytest.approx([0.0, 38.0])
    assert scaled[4] == pytest.approx([19.0, 0.0])
    assert not drawn_vectors(np.zeros((5, 2)), 40.0).any()


def test_numbers_are_round():
    assert round_ticks(-4.0, 0.0, 4) == pytest.approx([-4, -3, -2, -1, 0])
    assert round_ticks(0.0, 0.9, 6) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])
    assert tick_labels(np.array([-0.5, 0.0, 0.5])) == ["−0.5", "0", "0.5"]
    assert tick_labels(np.array([0.0, 50.0])) == ["0", "50"]
    assert [short_number(v) for v in (0.3141, 12.0, 4321.0, 1.2e-5)] == ["0.314", "12", "4.32·10³", "1.20·10⁻⁵"]
    for limit in (1e-7, 0.3, 0.95, 1.0, 4.9, 1e6):
        levels = iso_levels(limit)
        assert 11 <= len(levels) <= 25
        # But for the middle one, a millionth beside zero.
        assert levels == pytest.approx(-levels[::-1], abs=3e-6 * limit)
        assert np.abs(levels).max() <= limit * (1 + 1e-9)


@pytest.mark.parametrize("eyes", EYES)
def test_signs_of_the_field_are_told_apart_by_all_eyes(eyes: str):
    colours = np.array(mode_colours().colors)
    negative, zero, positive = (lab(colours[place], EYES[eyes]) for place in (30, 127, 225))
    # A difference of 2.3 is just noticed side by side.
    for one, other in combinations((negative, zero, positive), 2):
        assert np.linalg.norm(one - other) > 6 * 2.3


@pytest.mark.parametrize("eyes", EYES)
def test_larger_tensions_are_lighter_to_all_eyes(eyes: str):
    lightness = [lab(np.array(colormaps[SEQUENCE](place)[:3]), EYES[eyes])[0] for place in range(0, 256, 25)]
    assert np.all(np.diff(lightness) > 2.3)


@pytest.mark.slow
def test_a_sheet_of_very_many_modes_is_drawn(tmp_path: Path) -> None:
    """Graphics end at 16384 pixels, beyond which a page was black."""
    picture = sloshing_picture(length=200.0, depth=1.0)
    draw_overview([picture] * 200, tmp_path / "many.png", width=1600)
    with Image.open(tmp_path / "many.png") as image:
        assert image.height <= 10_000
        assert image.getpixel((3, 3)) == (255, 255, 255)


def test_a_page_shows_nothing_of_the_page_before(tmp_path: Path) -> None:
    picture = sloshing_picture()
    draw_mode(picture, tmp_path / "first.png", width=WIDTH)
    draw_mode(picture.times(-2.0), tmp_path / "like.png", width=WIDTH)
    draw_overview([sloshing_picture(length=200.0, depth=1.0)], tmp_path / "between.png", width=500)
    draw_mode(picture, tmp_path / "second.png", width=WIDTH)
    first = (tmp_path / "first.png").read_bytes()
    assert first == (tmp_path / "second.png").read_bytes() != (tmp_path / "like.png").read_bytes()


def test_the_field_has_no_holes_where_cells_are_cut_differently() -> None:
    for turn in np.arange(0.05, 6.2, 1.3):
        raster = coarse_beside_fine(turn)
        image = raster.coloured(np.full(len(raster.points), 0.9), 1.0, mode_colours())
        # What shows through is white in all three channels.
        assert (image[near_the_edge(turn), :3].min(axis=1) < 200).all()


def near_the_edge(turn: float) -> np.ndarray:
    """Pixels well within the triangles, but near the edge that they share."""
    y, x = np.mgrid[:1200, :1600]
    x, y = x - 800.3 + 0.5, y + 0.5 - 600.7
    along, across = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    return np.asarray((along > 60.0) & (along < 480.0) & (np.abs(across) < 5.0))


def coarse_beside_fine(turn: float) -> Raster:
    """A large triangle and many small ones that share an edge, from the middle of the page outwards."""
    sharp, middle = 0.19, np.array([800.3, 600.7])
    start, left, right = (np.array([np.cos(turn + by), np.sin(turn + by)]) for by in (0.0, -sharp, sharp))
    edge = middle + np.linspace(0.0, 1.0, 61)[:, None] * 590.0 * start
    points = np.vstack([edge, [middle + 590.0 * left, middle + 590.0 * right]])
    triangles = np.array([*([62, place, place + 1] for place in range(60)), [0, 61, 60]])
    return Raster(points=points, triangles=triangles, size=(1600, 1200))


def test_fields_are_where_the_page_says_and_colours_are_those_of_the_values() -> None:
    corners = np.array([[10.0, 25.0], [20.0, 25.0], [20.0, 35.0], [10.0, 35.0]])
    square = Raster(points=corners, triangles=np.array([[0, 1, 2], [0, 2, 3]]), size=(60, 40))
    height = 30.0 - corners[:, 1]
    image = square.coloured(height, 5.0, mode_colours())[:, :, :3]
    rows, columns = np.nonzero((image < 240).any(axis=2))
    # Rows are counted from above.
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (25, 34, 10, 19)
    scale = 255 * np.array(mode_colours().colors)
    for row, value in ((25, 4.5), (34, -4.5)):
        # Neighbouring colours of the scale differ by a few shades.
        assert image[row, 15] == pytest.approx(scale[round(255 * (0.5 + 0.1 * value))], abs=4)
    # Between the corners too, and nowhere else.
    sampled = square.at(np.array([[12.0, 26.0], [19.0, 34.5], [30.0, 30.0]]), np.column_stack([height, corners[:, 0]]))
    assert sampled[:2] == pytest.approx(np.array([[4.0, 12.0], [-4.5, 19.0]]), rel=1e-12)
    assert np.isnan(sampled[2]).all()


def test_a_triangle_fills_the_pixels_whose_middles_are_in_it() -> None:
    middles = np.stack(np.meshgrid(np.arange(60) + 0.5, np.arange(40) + 0.5), axis=-1)
    # Corners in all orders; the third one with an edge along a row.
    for corners in (
        np.array([[7.3, 3.1], [51.2, 17.4], [20.9, 37.6]]),
        np.array([[30.2, 38.3], [3.7, 21.9], [44.1, 2.8]]),
        np.array([[5.0, 9.0], [50.0, 9.0], [31.7, 33.3]]),
    ):
        image = Raster(points=corners, triangles=np.array([[0, 1, 2]]), size=(60, 40)).coloured(
            np.full(3, 0.9), 1.0, mode_colours()
        )
        edges = np.roll(corners, -1, axis=0) - corners
        away = middles[:, :, None] - corners
        sides = (edges[:, 0] * away[..., 1] - edges[:, 1] * away[..., 0]) / np.hypot(*edges.T)
        inside = np.maximum(sides.min(axis=2), (-sides).min(axis=2))
        # Triangles are larger by a twentieth of a pixel along the rows, and a little more across them.
        assert (image[inside > 0.0, :3].min(axis=1) < 200).all()
        assert (image[inside < -0.1, :3] == 255).all()


def test_pictures_are_in_full_colour_and_letters_are_as_they_are(tmp_path: Path) -> None:
    """A pair of dollar signs would make a formula in a title."""
    for name, title in (("one", "cost $a$"), ("other", "cost a")):
        draw_mode(replace(sloshing_picture(), title=title), tmp_path / f"{name}.png", width=WIDTH)
    one, other = (pixels(tmp_path / f"{name}.png")[:40].min(axis=(0, 2)) < 128 for name in ("one", "other"))
    assert np.ptp(np.nonzero(one)) > np.ptp(np.nonzero(other)) + 10
    with Image.open(tmp_path / "one.png") as image:
        assert image.mode == "RGB"
    page = pixels_of_page(new_page(100.0, 800))
    save(page, tmp_path / "page.png")
    assert (pixels(tmp_path / "page.png") == page[:, :, :3]).all()
