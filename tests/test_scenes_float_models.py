"""Scenes with two liquids and floats: what is accepted, what is refused, and in which words."""

from __future__ import annotations

from typing import Any

import pytest
from float_scenes import AIR, OIL, SQUARE, WATER, WEDGE, polygon, said, scene

BEAM: dict[str, Any] = {"start": 7.0, "length": 2.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}


def test_air_is_not_modelled() -> None:
    given = scene(WEDGE, liquids=(WATER, AIR), top="rigid")
    assert len(given.layers) == 1
    assert (given.top, given.tank.top) == ("free", "rigid")
    assert given.level_of(given.body[0]) == "surface"
    assert given.height_of("surface") == 0.0
    assert scene(WEDGE | {"at": "interface"}, liquids=(WATER, AIR)).level_of(given.body[0]) == "surface"
    assert "nothing floats on top of it" in said(WEDGE | {"at": "surface"}, liquids=(WATER, AIR))


@pytest.mark.parametrize(
    ("upper", "words"),
    [
        (1000.0, "overturns"),
        (1200.0, "less than 1000"),
        (1000.0 * (1 - 1e-10), "lost in rounding"),
        (1e-4, "0, for air, or at least 0.001"),
        (1e-40, "too small"),
        (-1.0, "too small"),
    ],
)
def test_the_upper_liquid_is_lighter(upper: float, words: str) -> None:
    text = said(liquids=(WATER, {"density": upper, "depth": 1.0}))
    assert '[[liquid]] number 2, key "density" = ' in text
    assert words in text


def test_there_is_a_liquid() -> None:
    assert "may be air" in said(liquids=(AIR,))
    assert "may be air" in said(liquids=({"density": 0.0, "depth": 1.0}, WATER))
    assert "one liquid or two" in said(liquids=(WATER, OIL, OIL))


@pytest.mark.parametrize("place", [0, 1])
@pytest.mark.parametrize("depth", [0.9e-3, 1.1e4])
def test_each_depth_fits_the_length(place: int, depth: float) -> None:
    liquids = [WATER, OIL]
    liquids[place] = liquids[place] | {"depth": depth}
    assert f'[[liquid]] number {place + 1}, key "depth"' in said(liquids=tuple(liquids))
    # Air may be as deep as it likes.
    assert scene(liquids=(WATER, {"density": 0.0, "depth": depth})).layers


@pytest.mark.parametrize(
    ("shape", "keys", "words"),
    [
        ("wedge", {"half_width": 1.0}, 'key "half_height": it is missing, and shape = "wedge" needs it'),
        ("wedge", {"half_width": 1.0, "half_height": 1.0, "tail": 0.1}, "belongs to exponential"),
        ("wedge", {"half_width": 1.0, "half_height": 1.0, "vertices": [[0, 0], [1, 0], [0, 1]]}, "belongs to polygon"),
        ("polygon", {}, '"vertices": it is missing'),
        ("polygon", {"vertices": SQUARE, "half_width": 1.0}, "does not belong"),
        ("polygon", {"vertices": [[0, 0], [1, 0]]}, "too few"),
        ("polygon", {"vertices": [[0, 0], [1, 0], [1]]}, 'key "vertices", entry 3.2: it is missing'),
        ("polygon", {"vertices": [[0, 0], [1, 0], [1, "a"]]}, 'key "vertices", entry 3.2 = "a": it is not a number'),
        ("polygon", {"vertices": [[0, 0], [1, 0], [1, 2, 3]]}, 'key "vertices", entry 3: there are too many'),
        ("polygon", {"vertices": "square"}, "it is not a list"),
        ("outline", {}, '"file": it is missing'),
        ("outline", {"file": "a.csv", "tail": 0.1}, "does not belong"),
        ("outline", {"file": 3}, "not a text"),
        ("elipse", {}, 'Did you mean "ellipse"?'),
        (3, {}, "not one of the choices"),
    ],
)
def test_keys_belong_to_their_shape(shape: str, keys: dict[str, Any], words: str) -> None:
    text = said({"kind": "float", "shape": shape, "position": 5.0} | keys)
    assert "[[body]] number 1, key " in text
    assert words in text


def test_an_interface_needs_two_liquids() -> None:
    assert "there is only one liquid" in said(WEDGE | {"at": "interface"}, liquids=(WATER,))
    assert "there is only one liquid" in said(BEAM | {"at": "interface"}, liquids=(WATER,))


@pytest.mark.parametrize(
    ("mass", "words"),
    [
        (1.0, "rises to the top of the upper liquid. Allowed: between 320 and 400 kg/m"),
        (320.0, "rises"),
        (400.0, "sinks"),
        (1e9, "sinks"),
    ],
)
def test_masses_between_those_of_the_liquids_float(mass: float, words: str) -> None:
    text = said(WEDGE | {"mass": mass})
    assert 'key "mass"' in text
    assert words in text
    assert scene(WEDGE | {"mass": 360.0})


def test_what_floats_almost_out_of_a_liquid_is_refused() -> None:
    # The wedge's tip has an area of (b/h) d² for the depth d: 8e-10 kg/m for a millionth of the height of 0.8 m.
    assert "below the still level" in said(WEDGE | {"mass": 7.9e-10}, liquids=(WATER,))
    assert "above the still level" in said(WEDGE | {"mass": 400 * (1 - 1e-13)}, liquids=(WATER,))
    assert scene(WEDGE | {"mass": 8.1e-10}, liquids=(WATER,))


def test_the_air_has_no_end_unless_it_is_a_layer() -> None:
    tall = WEDGE | {"half_height": 1.5, "half_width": 1.5}
    assert scene(tall, liquids=(WATER,))
    assert "reaches up to y = 1.5 m" in said(tall, liquids=(WATER, AIR))
    assert scene(
        tall | {"at": "surface"}, liquids=({"density": 1000.0, "depth": 1.0}, {"density": 800.0, "depth": 2.0})
    )


def test_bodies_keep_apart() -> None:
    assert 'key "position"' in said(WEDGE, WEDGE | {"position": 5.9})
    assert 'key "start"' in said(WEDGE, BEAM | {"start": 5.4})
    assert "reaches from 4.5 to 5.5 m. Leave a gap of at least 0.001 m" in said(WEDGE, BEAM | {"start": 5.5005})
    assert scene(WEDGE, WEDGE | {"position": 6.002})
    assert scene(WEDGE, BEAM | {"start": 5.502})
    # One above the other.
    assert scene(WEDGE, BEAM | {"start": 4.0, "at": "surface"})
    assert scene(WEDGE, WEDGE | {"at": "surface", "half_height": 0.5})
    assert "overlaps" in said(WEDGE, WEDGE | {"at": "surface", "half_height": 0.6})
    # Beams of one level only.
    assert scene(BEAM, BEAM | {"at": "surface"})
    assert "the beam overlaps or touches" in said(BEAM, BEAM | {"start": 8.0, "length": 1.0})


SLENDER = WEDGE | {"half_width": 0.1}


def test_what_capsizes_is_refused_unless_it_is_to_be_solved() -> None:
    assert "the float capsizes" in said(SLENDER | {"motions": ["roll"]})
    assert scene(SLENDER | {"motions": ["roll"], "unstable": "solve"})
    assert scene(SLENDER | {"motions": ["heave", "sway"]})
    # c55 = Δρ g (2b³/3 - b h²/3) - g m y_G with m = 1800 b h: neutral at y_G = (Δρ/1800)(2b²/(3h) - h/3).
    neutral = 200 / 1800 * (2 * 0.01 / 1.2 - 0.4 / 3)
    text = said(SLENDER | {"motions": ["heave", "roll"], "centre_of_mass": neutral + 1e-5})
    assert f"Allowed: a centre_of_mass of at most {neutral:g} m" in text
    assert scene(SLENDER | {"motions": ["heave", "roll"], "centre_of_mass": neutral - 1e-5})


def test_something_must_oscillate() -> None:
    lid: dict[str, Any] = {"liquids": (WATER,), "top": "rigid"}
    assert "nothing oscillates" in said(WEDGE, **lid)
    assert "nothing oscillates" in said(WEDGE | {"motions": ["sway"]}, **lid)
    circle = WEDGE | {"shape": "ellipse", "half_height": 0.5}
    assert "nothing oscillates" in said(circle | {"motions": ["heave", "roll", "sway"]}, **lid)
    assert "nothing oscillates" in said(circle | {"motions": ["roll"]}, liquids=(WATER,), top="pressure_release")
    assert scene(WEDGE, liquids=(WATER,), top="pressure_release")
    assert scene(WEDGE | {"motions": ["roll"]}, **lid)
    assert scene(WEDGE, WEDGE | {"position": 8.0}, **lid)
    assert scene(WEDGE, BEAM, **lid)
    assert scene(WEDGE, top="rigid")
    assert scene(WEDGE | {"motions": ["sway"]}, liquids=(WATER,))
    # A roll that displaces volume is held by the lid, one about the middle of the waterplane is not.
    keel = polygon((-1, -1), (0, -1), (0, -0.2), (1, -0.2), (1, 0.2), (-1, 0.2), motions=["roll"], unstable="solve")
    assert "nothing oscillates" in said(keel, **lid)
    assert scene(keel | {"motions": ["heave", "roll"]}, **lid)


def test_meshes_of_ones_own_are_for_one_liquid_with_beams() -> None:
    mesh = {"mesh": {"file": "tank.msh"}}
    assert "this scene has two liquids" in said(**mesh)
    assert "this scene has a float" in said(WEDGE, liquids=(WATER,), **mesh)
    assert scene(BEAM, liquids=(WATER,), **mesh)
    assert scene(BEAM, liquids=(WATER, AIR), **mesh)
