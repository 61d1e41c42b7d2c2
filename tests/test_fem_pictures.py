"""Pictures of modes: measured in the pixels that were written."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pyvista = pytest.importorskip("pyvista")

from hydroelastic.fem import picture_page  # noqa: E402
from hydroelastic.fem.picture_legend import scale_notes, short_number, tick_labels  # noqa: E402
from hydroelastic.fem.picture_page import NoRendererError, Page, arrow_triangles, dashes  # noqa: E402
from hydroelastic.fem.picture_tank import BODY, FREE_SURFACE, drawn_vectors  # noqa: E402
from hydroelastic.fem.picture_view import iso_levels, round_ticks, view_of  # noqa: E402
from hydroelastic.fem.pictures import ModePicture, SurfaceCurve, draw_mode, draw_overview  # noqa: E402

WIDTH = 800
UNIT = WIDTH / 1600
FOOTER = round(285 * UNIT)


@pytest.fixture(scope="module", autouse=True)
def _renderer() -> None:
    try:
        with Page(width=10, height=10):
            pass
    except NoRendererError as error:
        pytest.skip(str(error))


def sloshing_picture(
    *, length: float = 10.0, depth: float = 4.0, body: tuple[float, float] | None = (0.3, 0.7), number: int = 2
) -> ModePicture:
    """ψ = cos kx cosh k(y + depth) / cosh k·depth with a body that moves with the liquid."""
    x, y = np.meshgrid(np.linspace(0.0, length, 41), -depth * np.linspace(1.0, 0.0, 31) ** 2)
    k = number * np.pi / length
    below = np.exp(k * y) / (1 + np.exp(-2 * k * depth))
    mirrored = np.exp(-k * (y + 2 * depth)) / (1 + np.exp(-2 * k * depth))
    potential = np.cos(k * x) * (below + mirrored)
    displacement = np.stack([-k * np.sin(k * x) * (below + mirrored), k * np.cos(k * x) * (below - mirrored)], axis=-1)
    corner = (np.arange(30)[:, None] * 41 + np.arange(40)).ravel()
    triangles = np.vstack(
        [np.column_stack([corner, corner + 1, corner + 42]), np.column_stack([corner, corner + 42, corner + 41])]
    )
    pieces: list[tuple[str, float, float]] = [("free_surface", 0.0, 1.0)]
    if body is not None:
        pieces = [("free_surface", 0.0, body[0]), ("body", *body), ("free_surface", body[1], 1.0)]
    surfaces = []
    for kind, low, high in pieces:
        if high > low:
            at = length * np.linspace(low, high, 50)
            surfaces.append(SurfaceCurve(kind=kind, x=at, displacement=k * np.tanh(k * depth) * np.cos(k * at)))
    return ModePicture(
        points=np.column_stack([x.ravel(), y.ravel()]),
        triangles=triangles,
        potential=potential.ravel(),
        displacement=displacement.reshape(-1, 2),
        surfaces=tuple(surfaces),
        title="Mode 2: ω = 2.464523 rad/s, 0.392 Hz",
        length=length,
        depth=depth,
    )


def heave_picture(sign: float) -> ModePicture:
    """A body that heaves as a whole between surfaces at rest."""
    picture = sloshing_picture()
    surfaces = tuple(
        replace(curve, displacement=np.full(len(curve.x), sign if curve.kind == "body" else 0.0))
        for curve in picture.surfaces
    )
    return replace(picture, surfaces=surfaces)


def drawn(picture: ModePicture, folder: Path, width: int = WIDTH) -> np.ndarray:
    """Pixels in 0…255, shape (height, width, 3), the uppermost row first."""
    path = folder / "mode.png"
    draw_mode(picture, path, width=width)
    return pixels(path)


def pixels(path: Path) -> np.ndarray:
    from matplotlib.image import imread

    return np.round(255 * imread(path)[:, :, :3]).astype(int)


def has_colour(image: np.ndarray, colour: str) -> np.ndarray:
    """Where the pixels have a colour, up to the rounding of the renderer."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return np.abs(image - rgb).max(axis=2) <= 2


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
    assert note in scale_notes(view_of(picture))


def test_liquid_at_rest_can_be_drawn(tmp_path: Path):
    picture = sloshing_picture()
    surfaces = tuple(replace(curve, displacement=np.zeros_like(curve.x)) for curve in picture.surfaces)
    rest = replace(picture, potential=0 * picture.potential, displacement=0 * picture.displacement, surfaces=surfaces)
    assert has_colour(drawn(rest, tmp_path), BODY).any()
    assert "do not move" in scale_notes(view_of(rest))


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
    with pytest.raises(ValueError, match="PNG"):
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
    class Window:
        def GetClassName(self) -> str:  # noqa: N802 - the name is VTK's
            return "vtkOSOpenGLRenderWindow"

    class Plotter:
        render_window = Window()

    monkeypatch.setattr(picture_page, "_MESA_LIBRARIES", ("libabsent-of-this-computer.so",))
    with pytest.raises(NoRendererError, match="libegl1"):
        picture_page._require_renderer(Plotter())


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
    corners = arrow_triangles(np.array([[10.0, 20.0]]), np.array([[0.0, 8.0]]), stroke=1.0).reshape(-1, 2)
    assert corners[:, 1].min() == pytest.approx(16.0)
    assert corners[:, 1].max() == pytest.approx(24.0)
    # The tip lies on the axis.
    assert corners[corners[:, 1].argmax(), 0] == pytest.approx(10.0)


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
