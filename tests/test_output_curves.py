"""The style of curves: valid files of each format, the same each time, and colours that all eyes tell apart."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from itertools import combinations
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from eyes import EYES, lab
from PIL import Image

from hydroelastic.output.pictures.colours import diverging_colours
from hydroelastic.output.pictures.curves import COLOURS, Sheets, label_axes, plot_curve, sequence_colours
from hydroelastic.output.pictures.options import PictureOptions

ALL = PictureOptions(formats=("png", "svg", "pdf"), dpi=80)
SVG = "{http://www.w3.org/2000/svg}"


def draw(folder: Path, options: PictureOptions = ALL, *, title: str = "A chain", name: str = "curve") -> None:
    """A figure of 6 by 4 inches with two curves."""
    folder.mkdir(exist_ok=True)
    x = np.linspace(1.0, 9.0, 9)
    with Sheets(folder=folder, title=title, options=options).sheet(name, "tension", width=6.0, height=4.0) as figure:
        axes = figure.subplots()
        plot_curve(axes, x, x**2, 0, "upper")
        plot_curve(axes, x, x, 1, "lower")
        label_axes(axes, "length, m", "force, kN")


def words_of(svg: Path) -> list[str]:
    root = ElementTree.parse(svg).getroot()
    assert root.tag == f"{SVG}svg"
    return ["".join(element.itertext()).strip() for element in root.iter(f"{SVG}text")]


def test_each_format_is_what_it_says(tmp_path: Path) -> None:
    draw(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["curve.pdf", "curve.png", "curve.svg"]
    with Image.open(tmp_path / "curve.png") as picture:
        assert picture.size == (480, 320)
        # PNG stores whole pixels per metre.
        assert picture.info["dpi"] == pytest.approx((80.0, 80.0), abs=0.02)
    # Words are words in an SVG file, not outlines of letters.
    assert {"A chain: tension", "length, m", "force, kN", "upper", "lower"} <= set(words_of(tmp_path / "curve.svg"))
    pdf = (tmp_path / "curve.pdf").read_bytes()
    assert pdf.startswith(b"%PDF-")
    assert pdf.rstrip().endswith(b"%%EOF")
    assert b"/Count 1" in pdf
    # TrueType letters, which can be searched and edited; those of Type 3 many journals refuse.
    assert b"/Type3" not in pdf


@pytest.mark.slow
def test_the_same_curves_give_the_same_files(tmp_path: Path) -> None:
    draw(tmp_path / "one")
    draw(tmp_path / "two")
    for kind in ALL.formats:
        first, second = ((tmp_path / folder / f"curve.{kind}").read_bytes() for folder in ("one", "two"))
        assert first == second


@pytest.mark.slow
def test_the_readers_own_settings_change_nothing(tmp_path: Path) -> None:
    draw(tmp_path / "one")
    with mpl.rc_context({"font.size": 30.0, "axes.grid": False, "savefig.dpi": 10, "savefig.bbox": "tight"}):
        draw(tmp_path / "two")
        assert mpl.rcParams["font.size"] == 30.0
    assert (tmp_path / "one" / "curve.png").read_bytes() == (tmp_path / "two" / "curve.png").read_bytes()


@pytest.mark.slow
def test_scale_changes_the_page_and_not_the_letters(tmp_path: Path) -> None:
    draw(tmp_path / "one", PictureOptions(formats=("svg",)))
    draw(tmp_path / "two", PictureOptions(formats=("svg",), scale=2.0))
    small, large = ((tmp_path / folder / "curve.svg").read_text(encoding="utf-8") for folder in ("one", "two"))
    widths = [float(re.findall(r'width="([0-9.]+)pt"', text)[0]) for text in (small, large)]
    assert widths == [6.0 * 72.0, 12.0 * 72.0]
    sizes = [set(re.findall(r"([0-9.]+)px", text)) for text in (small, large)]
    assert sizes[0] == sizes[1] != set()


def test_any_title_is_written_as_it_is(tmp_path: Path) -> None:
    # A dollar sign would begin a formula, and the markup must be told from that of the file.
    draw(tmp_path, PictureOptions(formats=("svg",)), title="5 $ & <b> {x}_1 $^")
    assert "5 $ & <b> {x}_1 $^: tension" in words_of(tmp_path / "curve.svg")


def test_a_long_title_is_broken_after_what_it_is_of(tmp_path: Path) -> None:
    draw(tmp_path, PictureOptions(formats=("svg",)), title="A chain of forty-nine letters between two supports")
    words = words_of(tmp_path / "curve.svg")
    assert {"A chain of forty-nine letters between two supports", "tension"} <= set(words)


def test_a_failure_writes_no_file(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), Sheets(folder=tmp_path, title="").sheet("curve", "nothing", width=6.0):
        raise RuntimeError
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("low", "high", "numbers"),
    [
        (0.012, 0.8, ["0.02", "0.05", "0.1", "0.2", "0.5"]),
        (3e-6, 2e-5, [r"$5\times10^{-6}$", r"$1\times10^{-5}$"]),
        (1e-9, 1e-3, [r"$\mathdefault{10^{-9}}$", r"$\mathdefault{10^{-3}}$"]),
    ],
)
def test_logarithmic_axes_have_numbers_that_are_apart(
    tmp_path: Path, low: float, high: float, numbers: list[str]
) -> None:
    with Sheets(folder=tmp_path, title="").sheet("curve", "something", width=6.0) as figure:
        axes = figure.subplots()
        axes.loglog([1.0, 2.0], [low, high])
        axes.set_ylim(low, high)
    ticks = [*axes.yaxis.get_ticklabels(which="both")]
    shown = [tick.get_text() for tick in ticks if tick.get_text() and low <= tick.get_position()[1] <= high]
    assert set(numbers) <= set(shown)
    boxes = [tick.get_window_extent() for tick in ticks if tick.get_text()]
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))


@pytest.mark.parametrize("eyes", EYES)
def test_colours_are_told_apart(eyes: str) -> None:
    seen = [lab(np.array(mpl.colors.to_rgb(colour)), EYES[eyes]) for colour in COLOURS]
    # A difference of 2.3 is just noticed side by side; the closest of Okabe and Ito's are six times that.
    assert min(np.linalg.norm(one - other) for one, other in combinations(seen, 2)) > 6 * 2.3


@pytest.mark.parametrize("eyes", EYES)
def test_a_sequence_goes_from_light_to_dark(eyes: str) -> None:
    lightness = [lab(np.array(colour[:3]), EYES[eyes])[0] for colour in sequence_colours(9)]
    # Nine steps over most of 0…100, none of them below a noticeable one.
    assert np.all(np.diff(lightness) < -2.3)


@pytest.mark.parametrize("eyes", EYES)
def test_values_of_both_signs_are_told_apart_and_from_zero(eyes: str) -> None:
    below, zero, above = (
        lab(np.array(diverging_colours(-1.0, 1.0)(place)[:3]), EYES[eyes]) for place in (0.1, 0.5, 0.9)
    )
    assert zero[0] > 95.0
    assert min(np.linalg.norm(one - other) for one, other in combinations((below, zero, above), 2)) > 6 * 2.3


def test_a_part_of_the_colours_means_the_same() -> None:
    whole, part = diverging_colours(-1.0, 1.0), diverging_colours(0.0, 0.5)
    for value in (0.0, 0.2, 0.5):
        # The nearest of 256 steps.
        assert part(value / 0.5)[:3] == pytest.approx(whole(0.5 + 0.5 * value)[:3], abs=0.02)
