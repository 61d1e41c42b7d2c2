"""Pictures of modes: measured in the pixels that were written."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from eyes import EYES, lab
from mode_pictures import has_colour, heave_picture, pixels, sloshing_picture
from PIL import Image

from hydroelastic.output.pictures import canvas as picture_canvas
from hydroelastic.output.pictures.colours import magnitude_colours, mode_colours
from hydroelastic.output.pictures.legend import scale_notes
from hydroelastic.output.pictures.liquid import LiquidField, displacement_on_grid, iso_lines
from hydroelastic.output.pictures.modes import ModePicture, SurfaceCurve, draw_mode, draw_overview
from hydroelastic.output.pictures.page import Page
from hydroelastic.output.pictures.png import png_bytes
from hydroelastic.output.pictures.rendering import Canvas, NoRendererError
from hydroelastic.output.pictures.shapes import Shape, arrows, dashes, ribbon, strokes
from hydroelastic.output.pictures.tank import BODY, FREE_SURFACE, drawn_vectors
from hydroelastic.output.pictures.ticks import round_ticks, short_number, tick_labels
from hydroelastic.output.pictures.view import iso_levels, view_of

WIDTH = 800
UNIT = WIDTH / 1600
FOOTER = round(285 * UNIT)


@pytest.fixture(autouse=True)
def _renderer(canvas: Canvas) -> None:
    """Where nothing can render, nothing is tested here."""


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
    monkeypatch.setattr(picture_canvas, "_MESA_LIBRARIES", ("libabsent-of-this-computer.so",))
    with pytest.raises(NoRendererError, match="libegl1"):
        picture_canvas._require_renderer("vtkOSOpenGLRenderWindow")


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


def test_arrow_spans_its_vector_around_its_centre():
    shafts, heads = arrows(np.array([[10.0, 20.0]]), np.array([[0.0, 8.0]]), width=1.0)
    # The fading edge goes half a pixel beyond each end; more at the tip, which is sharp.
    assert shafts.points[:, 1].min() == pytest.approx(15.5)
    assert opaque_part(shafts)[:, 1].min() == pytest.approx(16.5)
    assert 24.5 < heads.points[:, 1].max() < 26.0
    assert opaque_part(heads)[:, 1].max() < 24.0
    # The tip lies on the axis.
    assert heads.points[heads.points[:, 1].argmax(), 0] == pytest.approx(10.0)


def opaque_part(shape: Shape) -> np.ndarray:
    return shape.points[shape.opacity == 1.0]


def coverage(shape: Shape) -> float:
    """Area in pixels, weighted by the opacity."""
    a, b, c = np.moveaxis(shape.points[shape.triangles], 1, 0)
    area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    return float(np.sum(area * shape.opacity[shape.triangles].mean(axis=1)))


@pytest.mark.parametrize("width", [1.0, 1.6, 4.5, 15.0])
def test_fading_edges_keep_the_width_of_a_line(width: float):
    ends = np.array([[[3.0, 4.0], [83.0, 64.0]]])
    # Length 100; the corners of the fading frame hold up to a quarter of a square pixel less or more each.
    assert coverage(strokes(ends, width)) == pytest.approx(100.0 * width, abs=1.0)
    assert coverage(ribbon(ends[0], width)) == pytest.approx(100.0 * width, abs=1.0)
    # Joined strokes overlap by a quarter of a pixel at each end.
    assert coverage(strokes(ends, width, joined=True)) == pytest.approx(100.5 * width, rel=1e-12)


def test_edges_are_smooth_and_the_width_of_a_drawn_line_is_true(canvas: Canvas, tmp_path: Path):
    page = Page(canvas, width=120, height=100)
    page.strokes(np.array([[[10.3, 9.8], [108.9, 86.1]]]), stroke=6.0, colour="#000000")
    page.save(tmp_path / "line.png")
    image = pixels(tmp_path / "line.png")
    ink = 1.0 - image[:, :, 0] / 255.0
    # A pixel takes the shade at its middle, right on average.
    assert ink.sum() == pytest.approx(np.hypot(98.6, 76.3) * 6.0, rel=0.01)
    # A slanting edge meets pixels in many different parts.
    assert len(np.unique(image[:, :, 0])) > 50


def test_pixels_are_where_the_page_says_and_survive_the_file(canvas: Canvas, tmp_path: Path):
    page = Page(canvas, width=60, height=40)
    page.band(np.array([[10.0, 5.0], [20.0, 5.0]]), np.array([[10.0, 15.0], [20.0, 15.0]]), colour=BODY)
    page.save(tmp_path / "square.png")
    rows, columns = np.nonzero(has_colour(pixels(tmp_path / "square.png"), BODY))
    # Rows are counted from above.
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (25, 34, 10, 19)
    assert len(rows) == 100
    noise = np.random.default_rng(1).integers(0, 256, (7, 11, 3), dtype=np.uint8)
    (tmp_path / "noise.png").write_bytes(png_bytes(noise))
    assert (pixels(tmp_path / "noise.png") == noise).all()


def test_a_page_shows_nothing_of_the_page_before(canvas: Canvas, tmp_path: Path):
    picture = sloshing_picture()
    draw_mode(picture, tmp_path / "first.png", width=WIDTH, canvas=canvas)
    draw_overview([sloshing_picture(length=200.0, depth=1.0)], tmp_path / "between.png", width=500, canvas=canvas)
    draw_mode(picture, tmp_path / "second.png", width=WIDTH, canvas=canvas)
    draw_mode(picture, tmp_path / "alone.png", width=WIDTH)
    first = (tmp_path / "first.png").read_bytes()
    assert first == (tmp_path / "second.png").read_bytes() == (tmp_path / "alone.png").read_bytes()


def test_the_field_has_no_holes_where_cells_are_cut_differently(canvas: Canvas, tmp_path: Path):
    page = Page(canvas, width=1600, height=1200)
    for turn in np.arange(0.05, 6.2, 0.2):
        page.field(coarse_beside_fine(turn), limit=1.0, colours=np.array([[0.0, 0.0, 0.0], [0.2, 0.2, 0.2]]))
    page.save(tmp_path / "field.png")
    image = pixels(tmp_path / "field.png").max(axis=2)
    y, x = np.mgrid[:1200, :1600]
    assert (image[np.hypot(x - 800, y - 600) < 480] < 60).all()


def coarse_beside_fine(turn: float) -> LiquidField:
    """A large triangle and many small ones that share an edge, from the middle of the page outwards."""
    sharp, middle = 0.19, np.array([800.3, 600.7])
    start, left, right = (np.array([np.cos(turn + by), np.sin(turn + by)]) for by in (0.0, -sharp, sharp))
    edge = middle + np.linspace(0.0, 1.0, 61)[:, None] * 590.0 * start
    points = np.vstack([edge, [middle + 590.0 * left, middle + 590.0 * right]])
    small = np.array([[62, place, place + 1] for place in range(60)])
    return LiquidField(
        points=points,
        triangles=np.vstack([small, [[0, 61, 60]]]),
        potential=np.zeros(len(points)),
        displacement=np.zeros((len(points), 2)),
    )


def linear_field() -> LiquidField:
    """ψ = x + 2 y on two triangles over [0, 4] × [0, 2]."""
    points = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]])
    return LiquidField(
        points=points,
        triangles=np.array([[0, 1, 2], [0, 2, 3]]),
        potential=points @ [1.0, 2.0],
        displacement=points * [1.0, -1.0],
    )


def test_lines_of_equal_potential_lie_on_their_level():
    lines = iso_lines(linear_field(), np.array([1.5, 5.25, 9.0]))
    # Each level crosses both triangles, the last one lies above all.
    assert len(lines) == 4
    values = np.sort((lines @ [1.0, 2.0]).mean(axis=1))
    assert values == pytest.approx([1.5, 1.5, 5.25, 5.25])
    assert np.ptp(lines @ [1.0, 2.0], axis=1) == pytest.approx(0.0, abs=1e-12)
    # 1.5 = x + 2 y meets both axes.
    assert np.hypot(*np.ptp(lines[:2].reshape(-1, 2), axis=0)) > 0.0


def test_displacement_on_a_grid_is_interpolated_once_at_each_point():
    x, y = np.linspace(-1.0, 5.0, 13), np.linspace(-0.5, 2.0, 6)
    points, values = displacement_on_grid(linear_field(), x, y)
    # 0, 0.5, … 4 and 0, 0.5, … 2: corners and the common diagonal included, what lies outside left out.
    assert len(points) == 9 * 5
    assert len(np.unique(points, axis=0)) == len(points)
    assert values == pytest.approx(points * [1.0, -1.0])


def test_dashes_stay_within_the_line():
    strokes = dashes((0.0, 5.0), (100.0, 5.0), dash=9.0, gap=6.0)
    assert strokes[:, :, 0].min() == 0.0
    assert strokes[:, :, 0].max() <= 100.0
    assert (strokes[:, :, 1] == 5.0).all()


def test_numbers_are_round():
    assert round_ticks(-4.0, 0.0, 4) == pytest.approx([-4, -3, -2, -1, 0])
    assert round_ticks(0.0, 0.9, 6) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])
    assert tick_labels(np.array([-0.5, 0.0, 0.5])) == ["−0.5", "0.0", "0.5"]
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
    colours = mode_colours()
    negative, zero, positive = (lab(colours[place], EYES[eyes]) for place in (30, 127, 225))
    # A difference of 2.3 is just noticed side by side.
    for one, other in combinations((negative, zero, positive), 2):
        assert np.linalg.norm(one - other) > 6 * 2.3


@pytest.mark.parametrize("eyes", EYES)
def test_larger_tensions_are_lighter_to_all_eyes(eyes: str):
    lightness = [lab(colour, EYES[eyes])[0] for colour in magnitude_colours()[::25]]
    assert np.all(np.diff(lightness) > 2.3)


def test_a_sheet_of_very_many_modes_is_drawn(tmp_path: Path, canvas: Canvas) -> None:
    """Graphics end at 16384 pixels, beyond which a page was black."""
    picture = sloshing_picture(length=200.0, depth=1.0)
    draw_overview([picture] * 200, tmp_path / "many.png", width=1600, canvas=canvas)
    with Image.open(tmp_path / "many.png") as image:
        assert image.height <= 10_000
        assert image.getpixel((3, 3)) == (255, 255, 255)


def test_signs_of_other_languages_are_letters_in_a_title(canvas: Canvas) -> None:
    """A pair of dollar signs would make a formula, without them and in italics; a bar two columns."""
    width = canvas.text_width("cost a", 20.0)
    assert canvas.text_width("cost $a$", 20.0) > width + 10.0
    assert canvas.text_width("x|y", 20.0) == pytest.approx(canvas.text_width("x∣y", 20.0), abs=1.0)
