"""What `check` says about a scene, against counts and groups worked out by hand."""

import io
from typing import Any

import pytest
from rich.console import Console

from hydroelastic.output.check_text import print_check
from hydroelastic.physics.rigid_motions import zero_mode_count
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Liquid, Tank
from hydroelastic.scenes.read import read_scene, shipped_scenes
from hydroelastic.scenes.tank.check_hints import hints


def beam(**changes: Any) -> Beam:
    values: dict[str, Any] = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    return Beam(**(values | changes))


def scene(*bodies: Beam | Float, top: str = "free", title: str = "", upper: float | None = None) -> TankScene:
    above = () if upper is None else (Liquid(density=upper, depth=3),)
    return TankScene(
        title=title,
        tank=Tank(length=10, top=top),  # type: ignore[arg-type]
        liquid=(Liquid(density=1000, depth=5), *above),
        body=bodies,
    )


def printed(given: TankScene) -> str:
    console = Console(file=io.StringIO(), width=200)
    print_check(given.title, checker_of(given)(given), console)
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


LOOSE, SECOND_LOOSE = beam(start=0.5, hydrostatic=False), beam(start=5, hydrostatic=False)
COVER = beam(start=0, length=10, hydrostatic=False)


@pytest.mark.parametrize(
    ("bodies", "top", "expected"),
    [
        ((), "free", 0),
        ((beam(),), "free", 0),
        ((LOOSE,), "free", 1),  # pitch; heave moves the free surface
        ((LOOSE,), "rigid", 1),  # pitch; heave has no room
        ((LOOSE,), "pressure_release", 2),  # liquid leaves and enters at no cost
        ((LOOSE, SECOND_LOOSE), "free", 3),  # two pitches, and heaves that exchange their volume
        ((LOOSE, SECOND_LOOSE), "pressure_release", 4),
        ((LOOSE, beam(start=5)), "free", 1),
        ((COVER,), "free", 1),
        ((COVER,), "pressure_release", 1),
        ((beam(start=0, length=10, hydrostatic=False, ends="guided"),), "free", 0),
    ],
)
def test_zero_modes_are_counted(bodies: tuple[Beam, ...], top: str, expected: int) -> None:
    assert zero_mode_count(physical_tank(scene(*bodies, top=top))) == expected
    told = [hint for hint in hints(scene(*bodies, top=top)) if "zero" in hint]
    assert len(told) == (1 if expected else 0)


def test_a_draught_that_counts_is_said() -> None:
    # m/ρ = 0.3 m of 4 m is 0.075; of a liquid 0.8 m deep, 0.05/0.8 = 0.0625; of 4 m, 0.05 is 0.0125.
    def said(given: TankScene) -> list[str]:
        return [hint for hint in hints(given) if "draught" in hint]

    assert "m/ρ of 0.3 m, 0.075 of its length" in said(scene(beam(mass_per_length=300.0)))[0]
    shallow = scene(beam()).model_copy(update={"liquid": (Liquid(density=1000, depth=0.8),)})
    assert "0.062 of the depth below it" in said(shallow)[0]
    assert not said(scene(beam()))


def test_groups_of_the_base_scene() -> None:
    text = printed(read_scene("aquarium"))
    # 5e3/(1000·9.81·4⁴) = 1.99096e-3; 50/(1000·4) = 0.0125; 4/10; 3/10; 5/10.
    for number in ("0.001991", "0.0125", "0.4", "0.3", "0.5"):
        assert f" {number} " in text


def test_unknown_fields_follow_the_top() -> None:
    assert "η = ω² ψ/g" in printed(scene(beam()))
    assert "a lid: no gravity waves" in printed(scene(beam(), top="rigid"))
    assert "η: none" in printed(scene(beam(), top="pressure_release"))
    covered = printed(scene(beam(start=0, length=10), top="rigid"))
    assert "covers the whole liquid" in covered
    assert 'top = "rigid" has no effect' in covered
    assert "heave is excluded" in covered
    assert "a of beam" not in printed(scene())


def test_surfaces_are_printed_from_left_to_right() -> None:
    text = printed(scene(beam(start=6, length=2), beam(start=1, length=2)))
    assert text.index("beam 2") < text.index("beam 1") < text.index("walls")


def test_symmetric_scenes_are_recognised() -> None:
    def is_symmetric(*bodies: Beam) -> bool:
        return any("mirror" in hint for hint in hints(scene(*bodies)))

    pair = {"length": 2.0}
    assert is_symmetric()
    assert is_symmetric(beam())
    assert not is_symmetric(beam(start=1))
    assert is_symmetric(beam(start=1, **pair), beam(start=7, **pair))
    assert not is_symmetric(beam(start=1, **pair), beam(start=7, **pair, hydrostatic=False))
    assert not is_symmetric(beam(start=1, **pair), beam(start=7, **pair, mass_per_length=51.0))


def test_the_wall_that_a_beam_touches_is_named() -> None:
    assert any("left wall" in hint for hint in hints(read_scene("beam_at_the_wall")))
    assert any("right wall" in hint for hint in hints(scene(beam(start=6))))


# Largest participation of the first dry mode (reference/aquarium.json): aquarium 0.48, hydrostatic 0.23, steel 0.18;
# soft 0.99, heavy 0.99, beside a free surface; 0.999 for the covered tank.
@pytest.mark.parametrize(
    ("given", "shared"),
    [
        (read_scene("aquarium"), True),
        (read_scene("aquarium_hydrostatic"), True),
        (read_scene("stiff_beam"), True),
        (read_scene("soft_beam"), False),
        (scene(beam(mass_per_length=5000.0)), False),
        (scene(COVER), False),
        (scene(beam(), top="pressure_release"), False),
    ],
)
def test_shared_tones_are_announced(given: TankScene, shared: bool) -> None:
    assert any("hybrid" in hint for hint in hints(given)) is shared


def test_hydrostatics_are_weighed_against_bending() -> None:
    # ρ g/(EI κ₁⁴) = 9810/(5e3·(4.730041/4)⁴) = 1.003
    assert any("is 1 times" in hint for hint in hints(read_scene("aquarium")))
    assert any("is soft" in hint for hint in hints(scene(beam(flexural_rigidity=50.0))))
    assert not any("is soft" in hint or "modelled without" in hint for hint in hints(scene(beam())))


def test_titles_are_printed_as_they_are() -> None:
    assert "[bold]Tank[/nonsense]" in printed(scene(title="[bold]Tank[/nonsense]"))


@pytest.mark.slow_but("aquarium", "float_wedge", "open_plate", "catenary", "string_smooth", "swell", "interface_beam")
@pytest.mark.parametrize("name", [shipped.name for shipped in shipped_scenes()])
def test_every_shipped_scene_can_be_described(name: str) -> None:
    shipped = read_scene(name)
    text = io.StringIO()
    print_check(shipped.title, checker_of(shipped)(shipped), Console(file=text, width=200))
    assert shipped.title in text.getvalue()


def floating(*motions: str, **changes: Any) -> Float:
    values: dict[str, Any] = {"shape": "wedge", "position": 5.0, "half_width": 1.0, "half_height": 0.8}
    return Float(**(values | {"motions": motions or ("heave",)} | changes))


CIRCLE: dict[str, Any] = {"shape": "ellipse", "half_width": 1.0, "half_height": 1.0}
ALL = ("heave", "sway", "roll")


def test_levels_are_printed_from_the_top_down() -> None:
    text = printed(scene(floating(*ALL), beam(start=0.5, at="surface"), upper=800.0))
    places = [
        text.index(words) for words in ("free surface, y = 3 m", "beam 2", "interface, y = 0 m", "float 1", "walls")
    ]
    assert places == sorted(places)
    for words in (
        "∂ψᵤ/∂y = ∂ψₗ/∂y = η, (ρₗ − ρᵤ) g η = ω² (ρₗ ψₗ − ρᵤ ψᵤ)",
        "∂ψᵤ/∂y = ηᵤ, g ηᵤ = ω² ψᵤ",
        "∂ψᵤ/∂y = w, EI w⁗ + ρᵤ g w − ω² m w = ω² ρᵤ ψᵤ",
        "∂ψᵤ/∂n = ∂ψₗ/∂n = n · s on its contour; s: heave, sway, roll",
        "upper liquid, 0 < y < 3 m",
        "lower liquid, -5 m < y < 0",
        "rigid motions: heave, sway, roll about its centre of mass",
    ):
        assert words in text


@pytest.mark.slow
def test_groups_of_two_liquids_and_a_float() -> None:
    text = printed(scene(floating(), beam(start=0.5, length=3.0), upper=800.0))
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
        row = next(line for line in text.splitlines() if f"│ {group} " in line)
        assert f" {value} " in row, row


def test_floats_at_rest_are_tabulated() -> None:
    text = printed(scene(floating("heave", "roll"), floating(position=8.5, **CIRCLE)))
    # The wedge: m = 1000·0.8, c33 = ρ g·2, c55 = ρ g (2/3 - 0.8·0.8/3); the circle: c55 = 0.
    for quantity, one, other in (
        ("mass, kg/m", "800", "1570.8"),
        ("waterplane, m", "4 to 6", "7.5 to 9.5"),
        ("c33 heave, N/m²", "19620", "19620"),
        ("c55 roll, N", f"{9810 * (2 - 0.64) / 3:g}", "0"),
        ("at rest", "stable", "stable; neutral if it could roll"),
    ):
        row = next(line for line in text.splitlines() if f"│ {quantity} " in line)
        assert [cell.strip() for cell in row.split("│")[2:4]] == [one, other]


def test_what_to_expect_of_floats_is_said() -> None:
    def told(*bodies: Float, **changes: Any) -> str:
        return " ".join(hints(scene(*bodies, **changes)))

    assert "Float 1 is unstable" in told(floating("roll", half_width=0.1, unstable="solve"))
    assert "is unstable" not in told(floating("heave", half_width=0.1))
    assert "0.5, which is much" in told(floating(half_width=0.4, boundary="thin"))
    assert "which is much" not in told(floating(half_width=0.04, boundary="thin"))
    assert "it is air" in told(floating(), upper=0.0)
    assert "there are 2 modes, not 10" in told(floating(), floating(position=8.0), top="pressure_release")
    assert "there is 1 mode, not 10" in told(floating(), floating(position=8.0), top="rigid")
    assert "(ρᵤ coth khᵤ + ρₗ coth khₗ)" in told(upper=800.0, top="rigid")
    assert "(ρᵤ tanh khᵤ + ρₗ coth khₗ)" in told(upper=800.0, top="pressure_release")
    assert "two exact solutions" in told(upper=800.0)
    assert "sway of float 1, roll of float 1. That leaves 2 modes" in told(floating(*ALL, **CIRCLE))
