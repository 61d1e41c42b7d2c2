"""What `check` says about a scene, against counts and groups worked out by hand."""

import re
from pathlib import Path
from typing import Any

import pytest
from command import run_command
from mutated_scenes import as_toml

import hydroelastic as he

BEAM: dict[str, Any] = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
FLOAT: dict[str, Any] = {"kind": "float", "shape": "wedge", "position": 5.0, "half_width": 1.0, "half_height": 0.8}
CIRCLE = FLOAT | {"shape": "ellipse", "half_width": 1.0, "half_height": 1.0}
LOOSE = BEAM | {"start": 0.5, "hydrostatic": False}
SECOND = BEAM | {"start": 5.0, "hydrostatic": False}
COVER = BEAM | {"start": 0.0, "length": 10.0, "hydrostatic": False}
SHORT = BEAM | {"length": 2.0}
OIL = {"density": 800.0, "depth": 3.0}


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")


def checked(scene: str, *options: str) -> str:
    result = run_command("check", scene, *options)
    assert result.exit_code == 0, result.output
    return " ".join(result.stdout.split())


def of(*bodies: dict[str, Any], top: str = "free", upper: dict[str, float] | None = None, **keys: Any) -> str:
    water = {"density": 1000.0, "depth": 5.0} | keys.pop("water", {})
    liquids = [water] if upper is None else [water, upper]
    document = {"kind": "tank", "tank": {"length": 10.0, "top": top}, "liquid": liquids, "body": list(bodies), **keys}
    Path("scene.toml").write_text(as_toml(document), encoding="utf-8")
    return checked("scene.toml")


@pytest.mark.parametrize(
    ("bodies", "top", "expected"),
    [
        ((), "free", 0),
        ((BEAM,), "free", 0),
        ((LOOSE,), "free", 1),  # pitch; heave moves the free surface
        ((LOOSE,), "rigid", 1),  # pitch; heave has no room
        ((LOOSE,), "pressure_release", 2),  # liquid leaves and enters at no cost
        ((LOOSE, SECOND), "free", 3),  # two pitches, and heaves that exchange their volume
        ((LOOSE, SECOND), "pressure_release", 4),
        ((COVER,), "free", 1),
        ((COVER,), "pressure_release", 1),
        ((COVER | {"ends": "guided"},), "free", 0),
    ],
)
def test_motions_of_zero_frequency_are_counted(bodies: tuple[dict[str, Any], ...], top: str, expected: int) -> None:
    assert ("zero" in of(*bodies, top=top)) == bool(expected)
    accuracy = {"modes": 2, "tolerance": 1e-2}
    document = {"kind": "tank", "tank": {"length": 10.0, "top": top}, "liquid": [{"density": 1000.0, "depth": 5.0}]}
    found = he.solve(he.read(document | {"body": list(bodies), "accuracy": accuracy}))
    assert found.summary["zero_modes"] == expected


def test_groups_of_the_base_scene() -> None:
    # 5e3/(1000·9.81·4⁴) = 1.99096e-3; 50/(1000·4) = 0.0125; 4/10; 3/10; 5/10.
    for number in ("0.001991", "0.0125", "0.4", "0.3", "0.5"):
        assert f" {number} " in checked("aquarium")


def test_groups_of_two_liquids_and_a_float() -> None:
    text = of(FLOAT, BEAM | {"start": 0.5, "length": 3.0}, upper=OIL)
    # ρᵤ/ρₗ; hᵤ/hₗ; hₗ/L; b/h; B/L; m/(ρₗ A) = 0.9; EI/((ρₗ - ρᵤ) g l⁴) = 5e3/(200·9.81·81).
    for group, value in (
        ("ρᵤ/ρₗ", "0.8"),
        ("hᵤ/hₗ", "0.6"),
        ("hₗ/L", "0.5"),
        ("b/h", "1.25"),
        ("B/L", "0.2"),
        ("m/(ρₗ A)", "0.9"),
        ("EI/((ρₗ − ρᵤ) g l⁴)", "0.03146"),
    ):
        assert re.search(rf"│ {re.escape(group)} [^│]*(│[^│]*)*? {re.escape(value)} ", text), group


def test_floats_at_rest_are_tabulated() -> None:
    text = of(FLOAT | {"motions": ["heave", "roll"]}, CIRCLE | {"position": 8.5})
    # The wedge: m = 1000·0.8, c33 = ρ g·2, c55 = ρ g (2/3 - 0.8·0.8/3); the circle: c55 = 0.
    for quantity, one, other in (
        ("mass, kg/m", "800", "1570.8"),
        ("waterplane, m", "4 to 6", "7.5 to 9.5"),
        ("c33 heave, N/m²", "19620", "19620"),
        ("c55 roll, N", f"{9810 * (2 - 0.64) / 3:g}", "0"),
    ):
        assert re.search(rf"│ {re.escape(quantity)} │ {re.escape(one)} │ {re.escape(other)} │", text), quantity


# Hints that are said, and where they are not.
HINTS = {
    "draught": ("draught", (BEAM | {"mass_per_length": 300.0},), (BEAM,)),
    "mirror": ("mirror", (BEAM,), (BEAM | {"start": 1.0},)),
    "mirrored pair": (
        "mirror",
        (SHORT | {"start": 1.0}, SHORT | {"start": 7.0}),
        (SHORT | {"start": 1.0}, SHORT | {"start": 7.0, "mass_per_length": 51.0}),
    ),
    "wall": ("right wall", (BEAM | {"start": 6.0},), (BEAM,)),
    # Largest participation of the first dry mode in the reference: 0.48 for the beam, 0.99 for the heavy one.
    "shared tone": ("hybrid", (BEAM,), (BEAM | {"mass_per_length": 5000.0},)),
    "soft": ("is soft", (BEAM | {"flexural_rigidity": 50.0},), (BEAM,)),
    "unstable": (
        "Float 1 is unstable",
        (FLOAT | {"motions": ["roll"], "half_width": 0.1, "unstable": "solve"},),
        (FLOAT | {"half_width": 0.1},),
    ),
    "not thin": (
        "which is much",
        (FLOAT | {"half_width": 0.4, "boundary": "thin"},),
        (FLOAT | {"half_width": 0.04, "boundary": "thin"},),
    ),
}


@pytest.mark.parametrize("hint", HINTS)
def test_hints_are_said_where_they_hold(hint: str) -> None:
    words, holds, fails = HINTS[hint]
    assert words in of(*holds)
    assert words not in of(*fails)


def test_the_bodies_of_a_scene_are_listed_from_left_to_right_and_from_the_top_down() -> None:
    text = of(BEAM | {"start": 6.0, "length": 2.0}, SHORT | {"start": 1.0})
    assert text.index("beam 2") < text.index("beam 1") < text.index("walls")
    text = of(FLOAT, BEAM | {"start": 0.5, "at": "surface"}, upper=OIL)
    names = ("free surface, y = 3 m", "beam 2", "interface, y = 0 m", "float 1", "walls")
    places = [text.index(name) for name in names]
    assert places == sorted(places)


def test_more_bodies_than_can_be_solved_are_refused_at_once() -> None:
    beams = [BEAM | {"start": 0.01 * number, "length": 0.005} for number in range(990)]
    with pytest.raises(he.SceneError, match=r"\[\[body\]\]: there are too many. Allowed: up to 200"):
        he.read("aquarium", {"body": beams})


@pytest.mark.slow_but("aquarium", "float_wedge", "open_plate", "catenary", "string_smooth", "swell", "interface_beam")
@pytest.mark.parametrize("name", [shipped.name for shipped in he.shipped_scenes()])
def test_every_shipped_scene_can_be_described(name: str) -> None:
    assert " ".join(he.read(name).title.split()) in checked(name)


def test_titles_are_printed_as_they_are() -> None:
    assert "[bold]Tank[/nonsense]" in of(title="[bold]Tank[/nonsense]")


@pytest.mark.parametrize(
    ("scene", "seconds", "gigabytes"),
    [
        ("float_wedge", 2.3, 0.21),
        ("conical_tank", 1.9, 0.20),
        ("cross_waves", 2.3, 0.13),
        ("ice_in_a_triangle", 3.1, 0.27),
        ("barge_in_a_dock", 4.4, 0.49),
        ("hemisphere", 11.6, 0.71),
        ("open_circle", 8.6, 0.41),
        ("string_with_load", 1.6, 0.12),
        ("jumper", 4.7, 0.18),
        ("swell", 0.9, 0.11),
    ],
)
def test_the_cost_of_each_kind_is_told_within_a_factor_of_three(scene: str, seconds: float, gigabytes: float) -> None:
    """Beside processor seconds and the largest memory of a run without pictures, measured on one core."""
    (told,) = re.findall(r"Cost, roughly: about (\S+) s, (\S+) GB, without pictures", checked(scene))
    assert seconds / 3.0 < float(told[0]) < 3.0 * seconds
    assert gigabytes / 3.0 < float(told[1]) < 3.0 * gigabytes
