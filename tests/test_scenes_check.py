"""What `check` says about a scene, against counts and groups worked out by hand."""

import io
from typing import Any

import pytest
from rich.console import Console

from hydroelastic.scenes.check import print_check
from hydroelastic.scenes.check_hints import hints
from hydroelastic.scenes.models import Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.read import read_scene, shipped_scenes
from hydroelastic.scenes.rigid_motions import zero_mode_count


def beam(**changes: Any) -> Beam:
    values: dict[str, Any] = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    return Beam(**(values | changes))


def scene(*bodies: Beam, top: str = "free", title: str = "") -> TankScene:
    return TankScene(
        title=title,
        tank=Tank(length=10, top=top),  # type: ignore[arg-type]
        liquid=(Liquid(density=1000, depth=5),),
        body=bodies,
    )


def printed(given: TankScene) -> str:
    console = Console(file=io.StringIO(), width=200)
    print_check(given, console)
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
    assert zero_mode_count(scene(*bodies, top=top)) == expected
    told = [hint for hint in hints(scene(*bodies, top=top)) if "zero" in hint]
    assert len(told) == (1 if expected else 0)


def test_groups_of_the_base_scene() -> None:
    text = printed(read_scene("aquarium"))
    # 5e3/(1000·9.81·4⁴) = 1.99096e-3; 50/(1000·4) = 0.0125; 4/10; 3/10; 5/10.
    for number in ("0.001991", "0.0125", "0.4", "0.3", "0.5"):
        assert f" {number} " in text


def test_unknown_fields_follow_the_top() -> None:
    assert "η = ω² ψ/g" in printed(scene(beam()))
    assert "lid holds the liquid" in printed(scene(beam(), top="rigid"))
    assert "η: none" in printed(scene(beam(), top="pressure_release"))
    covered = printed(scene(beam(start=0, length=10), top="rigid"))
    assert "covers the whole liquid" in covered
    assert 'top = "rigid" has no effect' in covered
    assert "heave is held" in covered
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


@pytest.mark.parametrize("name", [shipped.name for shipped in shipped_scenes()])
def test_every_shipped_scene_can_be_described(name: str) -> None:
    assert read_scene(name).title in printed(read_scene(name))
