"""Scenes of rolling ships: what is read, what is refused, and in which words."""

from math import pi
from pathlib import Path

import pytest
from scene_files import read_written, refused

import hydroelastic as he

SHIP = 'kind = "roll"\n[roll]\nnatural_period = 12.0\n'
WAVE = "[[wave]]\nperiod = 8.0\nslope = 0.1\n"


def read(tmp_path: Path, text: str) -> he.RollScene:
    scene = read_written(tmp_path, text)
    assert isinstance(scene, he.RollScene)
    return scene


def test_period_and_frequency_say_the_same(tmp_path: Path) -> None:
    by_period = read(tmp_path, SHIP + WAVE)
    by_frequency = read(tmp_path, SHIP.replace("natural_period = 12.0", f"natural_frequency = {2 * pi / 12!r}") + WAVE)
    assert by_period.natural_frequency == by_frequency.natural_frequency == 2 * pi / 12


def test_damping_and_its_ratio_say_the_same(tmp_path: Path) -> None:
    assert read(tmp_path, SHIP + "damping = 0.3\n" + WAVE).damping(0.5) == 0.3
    assert read(tmp_path, SHIP + "damping_ratio = 0.6\n" + WAVE).damping(0.5) == 0.3
    assert read(tmp_path, SHIP + WAVE).damping(0.5) is None


def test_waves_from_a_table(tmp_path: Path) -> None:
    (tmp_path / "train.csv").write_text("period; slope\n8.0; 0.1\n\n7.5; -0.2  # steep\n", encoding="utf-8")
    assert read(tmp_path, SHIP + '[train]\nfile = "train.csv"\n').waves == ((8.0, 0.1), (7.5, -0.2))


def test_times_follow_the_waves_and_the_free_motion(tmp_path: Path) -> None:
    times = read(tmp_path, SHIP + WAVE).times(2 * pi / 12)
    assert times[-1] == pytest.approx(8.0 + 3 * 12.0)
    # 60 in the shortest period.
    assert times[1] == pytest.approx(8.0 / 60, rel=0.01)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (SHIP, ["[[wave]]", "there is none, and the ship is at rest"]),
        ('kind = "roll"\n[roll]\n' + WAVE, ["natural_period", "it is missing", "section"]),
        (SHIP + "natural_frequency = 0.5\n" + WAVE, ["natural_frequency", "given beside natural_period"]),
        (SHIP + "damping = 0.1\ndamping_ratio = 0.1\n" + WAVE, ["damping_ratio", "given beside damping"]),
        (SHIP + "damping = -0.1\n" + WAVE, ["damping", "too small"]),
        (SHIP + "damping_ratio = 1e9\n" + WAVE, ["damping_ratio", "too large"]),
        (SHIP + "dampig = 0.1\n" + WAVE, ['"dampig"', 'Did you mean "damping"?']),
        (
            SHIP + WAVE.replace("8.0", "1e9"),
            ['[[wave]] number 1, key "period"', "too far off", "natural period of 12 s"],
        ),
        (SHIP + WAVE.replace("8.0", "0.0"), ["period", "too small"]),
        (SHIP + WAVE + '[train]\nfile = "train.csv"\n', ['[train], key "file"', "given beside [[wave]]"]),
        (SHIP + '[train]\nfile = "train.csv"\n', ["there is no such file"]),
        (SHIP + '[train]\nfile = "bad.csv"\n', ['line 2, "8.0 zero', "is not two numbers"]),
        (SHIP + '[train]\nfile = "negative.csv"\n', ["the period of row 2 is -1", "positive"]),
        (SHIP + '[train]\nfile = "empty.csv"\n', ["it holds no waves"]),
        (SHIP + WAVE + "[output]\nlevels = [0.2, 0.1]\n", ["levels", "ascending"]),
        (SHIP + WAVE + "[output]\ntimes = []\n", ["times", "too few"]),
        (SHIP + WAVE + "[output]\ntimes = [0.0]\n", ["times", "no duration", "above 0"]),
        (SHIP + WAVE + "[output]\ntimes = [1e9]\n", ["times", "too late", "100000 natural periods"]),
        (SHIP + "quadratic_damping = 1e12\n" + WAVE, ["quadratic_damping", "too many steps", "Shorten"]),
        (SHIP + "quadratic_damping = 0.2\nangle = 1e30\n" + WAVE, ["quadratic_damping", "too many steps"]),
        (
            SHIP + WAVE + WAVE.replace("0.1", "-5.0"),
            ['[[wave]] number 2, key "slope" = -5.0', "steeper than any wave", "0.443 rad", "-5 degrees are -0.08727"],
        ),
        (SHIP + '[train]\nfile = "degrees.csv"\n', ["the slope of wave 2, 3 rad", "3 degrees are 0.05236"]),
        (SHIP + "quadratic_damping = 5.0\ndamping_ratio = 1e6\n" + WAVE, ["quadratic_damping", "too many steps"]),
        (
            SHIP + "quadratic_damping = 0.2\n" + WAVE + "[accuracy]\ntolerance = 1e-12\n",
            ["tolerance", "with quadratic damping", "from 1e-11"],
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, words: list[str]) -> None:
    (tmp_path / "bad.csv").write_text("7.0 0.1\n8.0 zero\n", encoding="utf-8")
    (tmp_path / "negative.csv").write_text("7.0 0.1\n-1 0.2\n", encoding="utf-8")
    (tmp_path / "empty.csv").write_text("period, slope\n", encoding="utf-8")
    (tmp_path / "degrees.csv").write_text("7.0 0.4\n8.0 3.0\n", encoding="utf-8")
    message = refused(tmp_path, text)
    assert all(word in message for word in words), message
