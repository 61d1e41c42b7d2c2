"""`check` and `run` say the same of the water that bodies in the sea need."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from hydroelastic.scenes.command_line import main

SPAR = """
kind = "sea"
[[liquid]]
density = 1025.0
depth = inf
[[body]]
kind = "float"
shape = "revolved"
outline = [[0.0, -41.0], [10.0, {depth}], [10.0, -40.0], [4.0, -40.0], [4.0, 5.0], [0.0, 5.0]]
motions = ["heave"]
vertical_centre_of_gravity = -28.0
[[analysis]]
kind = "response"
omega = [0.2, 0.6]
[accuracy]
tolerance = 1e-2
"""
BEAM = """
kind = "sea"
[[liquid]]
density = 1025.0
depth = inf
[[body]]
kind = "beam"
start = 0.0
length = 10.0
flexural_rigidity = 1e8
mass_per_length = 100.0
[[analysis]]
kind = "resonance"
{below}
[accuracy]
tolerance = 1e-2
"""


def invoke(folder: Path, command: str, text: str, *options: str) -> Result:
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    return CliRunner().invoke(main, [command, str(folder / "scene.toml"), *options])


def said(result: Result) -> str:
    return " ".join(result.output.split())


@pytest.mark.parametrize("command", ["check", "run"])
def test_an_outline_that_leaves_a_sliver_of_water_is_refused_in_words(command: str, tmp_path: Path) -> None:
    """The heave plate was meant to begin at z = −41 m, and not at −2.7 km."""
    options = ("--no-images", "--out", str(tmp_path / "out")) if command == "run" else ()
    result = invoke(tmp_path, command, SPAR.format(depth=-2732.1133055814194), *options)
    assert result.exit_code == 2
    assert "two curves bound a wedge of less than a degree" in said(result)
    assert "Change the shapes, places or sizes" in said(result)
    assert "Traceback" not in said(result)
    assert not (tmp_path / "out").exists()


def test_check_tells_unknowns_and_orders_of_the_first_mesh(tmp_path: Path) -> None:
    result = invoke(tmp_path, "check", SPAR.format(depth=-41.0))
    assert result.exit_code == 0
    assert "First mesh, for frequencies from 0.2 to 0.6 rad/s: degree 4," in said(result)
    # kR = 0.6² 10/9.81 = 0.4, with two beyond.
    assert "unknowns of ψ, in each of about 3 azimuthal orders." in said(result)


def test_check_tells_what_elastic_tones_among_short_waves_take(tmp_path: Path) -> None:
    unasked = said(invoke(tmp_path, "check", BEAM.format(below="")))
    assert "elastic tones among waves far shorter than the bodies only with below" in unasked
    asked = said(invoke(tmp_path, "check", BEAM.format(below="below = 25.0")))
    unknowns = int(asked.split(" unknowns of ψ")[0].split()[-1])
    # Of the mesh that a run makes, 24 thousand, k l = 640.
    assert 10_000 < unknowns < 60_000


SPHERE = """
kind = "sea"
[[liquid]]
density = 1000.0
depth = inf
[[body]]
kind = "float"
shape = "sphere"
radius = 49.0
motions = ["heave"]
[[analysis]]
kind = {analysis}
[accuracy]
tolerance = 1e-2
"""


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize(
    ("analysis", "key"),
    [
        ('"response"\nomega = [0.5, 6.0]', "omega"),
        ('"spectrum"\nsignificant_height = 1.0\npeak_period = 4.0', "highest_omega"),
    ],
    ids=["response", "spectrum"],
)
def test_waves_that_scatter_in_too_many_orders_are_refused(
    command: str, analysis: str, key: str, tmp_path: Path
) -> None:
    """k R = 180 would take hours: each azimuthal order has a mesh and matrices of its own."""
    options = ("--no-images", "--out", str(tmp_path / "out")) if command == "run" else ()
    result = invoke(tmp_path, command, SPHERE.format(analysis=analysis), *options)
    assert result.exit_code == 2
    # ω = √(75 g/R).
    assert f'number 1, key "{key}" = 6' in said(result)
    assert "Allowed: at most 3.875 rad/s, where k R = 75" in said(result)
    assert not (tmp_path / "out").exists()


def test_the_damping_of_a_large_solid_among_short_waves_needs_few_orders(tmp_path: Path) -> None:
    result = invoke(tmp_path, "check", SPHERE.format(analysis='"radiation"\nomega = [0.5, 6.0]'))
    assert result.exit_code == 0
