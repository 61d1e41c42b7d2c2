"""Rigid floats in closed tanks: thin ones against exact theory, and what statics and the liquid's inertia give."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from answers import answer, assert_alike, kept
from scipy.linalg import eigh
from section_tanks import GRAVITY, REFERENCES, layered, rigid

import hydroelastic as he
from hydroelastic.modal.floats.box import BoxModes, box_modes
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.rigid_limits import half_immersed_ellipse, interface_ellipse, section_heave_added_mass
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile

ALL = "heave sway roll"
PUBLIC: list[dict[str, Any]] = json.loads((REFERENCES / "two_fluid_float.json").read_text(encoding="utf-8"))["cases"]
BOXES = {case["id"]: case for case in PUBLIC if case["kind"] == "closed box eigenfrequencies"}
ONE_LIQUID: dict[str, Any] = {"densities": (1000.0,), "depths": (0.3,), "top": "free"}

# Sections that float upright, lopsided ones, in which gravity couples heave and roll, and some that turn over.
FLOATS: dict[str, he.Float] = {
    "circle": rigid("ellipse", 0.4, ALL, half_width=0.1, half_height=0.1, centre_of_mass=-0.02),
    "ship": rigid(
        "polygon",
        0.5,
        ALL,
        vertices=((-0.12, -0.03), (-0.08, -0.08), (0.05, -0.08), (0.11, -0.02), (0.12, 0.06), (-0.12, 0.06)),
        centre_of_mass=-0.03,
    ),
    "keel": rigid(
        "polygon",
        0.6,
        ALL,
        vertices=((-0.1, -0.02), (0.02, -0.12), (0.06, -0.02), (0.1, 0.05), (-0.1, 0.05)),
        centre_of_mass=-0.04,
    ),
    "upright": rigid("rectangle", 0.5, ALL, half_width=0.04, half_height=0.1, unstable="solve"),
    "top-heavy": rigid(
        "polygon",
        0.4,
        ALL,
        vertices=((-0.05, -0.1), (0.03, -0.1), (0.06, 0.15), (-0.05, 0.12)),
        centre_of_mass=0.03,
        mass=11.0,
        unstable="solve",
    ),
}


def box(inputs: dict[str, str]) -> he.TankScene:
    """A public case of a thin float in the middle of a box; twelve modes of the tank hold six symmetric ones."""
    value = {name: float(text) for name, text in inputs.items() if name not in ("shape", "mass")}
    two = value["rho1"] > 0.0
    size = {"half_width": value["half_beam"], "half_height": value["half_height"]}
    return layered(
        rigid(inputs["shape"], value["L_half"], boundary="thin", **size),
        densities=(value["rho2"], value["rho1"]) if two else (value["rho2"],),
        depths=(value["h2"], value["h1"]) if two else (value["h2"],),
        length=2.0 * value["L_half"],
        top="rigid" if two else "free",
        tolerance=1e-10,
        modes=12,
    )


def symmetric(scene: he.TankScene) -> tuple[np.ndarray, np.ndarray]:
    """ω and modal mass of heave, kg/m, of the symmetric modes of a tank with one float."""
    result = he.solve(scene)
    assert result.summary["reasons"] == []
    chosen = [index for index, mode in enumerate(result.summary["modes"]) if mode["symmetry"] == "symmetric"]
    heave = result.dataset.displacement_of_body_1.values[chosen, 0, 1]
    return result.modes.omega[chosen], heave**-2.0


@pytest.mark.slow_on_ranks_but("box_2_wedge")
@pytest.mark.mpi
@pytest.mark.parametrize("name", BOXES)
def test_thin_floats_have_every_digit_of_the_public_boxes(name: str) -> None:
    scene, values = box(BOXES[name]["inputs"]), BOXES[name]["values"]
    summary = kept(scene).summary
    omega = [mode["omega"] for mode in summary["modes"] if mode["symmetry"] == "symmetric"]
    assert len(omega) >= 5
    # Rounding at degree 9; measured 3e-13 of ω and 8e-12 of modal masses.
    assert omega == pytest.approx([float(text) for text in values["omega"]][: len(omega)], rel=1e-11)
    (found,) = summary["floats"]
    (mode,) = found["modes"]
    assert mode["omega"] == pytest.approx(float(values["omega_float"]), rel=1e-11)
    assert mode["modal_mass"] == pytest.approx(float(values["modal_mass_float"]), rel=1e-9)
    # The asked 1e-10, of some tenth of the sum.
    mass = found["high_frequency"]["added_mass"][0][0] + float(values["body_mass"])
    assert mass == pytest.approx(float(values["M_inf"]), rel=1e-10)


THIN = {
    "ellipse": {"half_width": 0.1, "half_height": 1.0},
    "exponential": {"half_width": 0.1, "half_height": 0.18},
    "parabola": {"half_width": 0.05, "half_height": 0.5},
    "wedge": {"half_width": 0.1, "half_height": 1.0},
}


def box_theory(scene: he.TankScene, count: int) -> BoxModes:
    """The exact modes of a thin float in the middle of a box."""
    (body,), (found,) = scene.body, answer(scene).summary["floats"]
    layers = TwoLayers(
        density_below=scene.liquid[0].density,
        density_above=scene.liquid[1].density if len(scene.liquid) == 2 else 0.0,
        depth_below=scene.liquid[0].depth,
        depth_above=scene.liquid[-1].depth,
        gravity=GRAVITY,
    )
    floating = FloatInTank(
        layers=layers,
        tank_length=scene.tank.length,
        position=body.position,
        mass=found["mass"],
        stiffness=found["heave_stiffness"],
        profile=float_profile(body.shape, body.half_width, body.half_height),
    )
    return box_modes(floating, count)


@pytest.mark.slow_but("ellipse-two", "wedge-one")
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0), (1000.0, 999.0)], ids=["one", "two", "close"])
@pytest.mark.parametrize("shape", THIN)
def test_thin_floats_of_all_shapes_have_their_exact_modes(shape: str, densities: tuple[float, ...]) -> None:
    scene = layered(
        rigid(shape, 6.0, boundary="thin", **THIN[shape]),
        densities=densities,
        depths=(2.0, 1.5),
        length=12.0,
        top="free" if len(densities) == 1 else "rigid",
        modes=9,
    )
    omega, masses = symmetric(scene)
    theory = box_theory(scene, len(omega))
    # The asked tolerance is 1e-8; measured 3e-11 and below. Modal masses err some hundred times as much.
    assert omega == pytest.approx(theory.omega, rel=1e-9)
    assert masses == pytest.approx(theory.modal_mass, rel=1e-7)


# Without waves: where the top has ψ = 0 the liquid's inertia does not depend on the frequency.


def statics(scene: he.TankScene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Stiffness, inertia and added mass of heave, sway and roll of the only float, as the summary tells them."""
    (found,) = answer(scene).summary["floats"]
    stiffness = np.zeros((3, 3))
    stiffness[0, 0], stiffness[2, 2] = found["heave_stiffness"], found["roll_stiffness"]
    stiffness[0, 2] = stiffness[2, 0] = found["coupling_stiffness"]
    inertia = np.diag([found["mass"], found["mass"], found["moment_of_inertia"]])
    return stiffness, inertia, np.array(found["high_frequency"]["added_mass"])


def without_waves(name: str, **keys: Any) -> he.TankScene:
    return layered(FLOATS[name], **(ONE_LIQUID | {"top": "pressure_release", "tolerance": 1e-6, "modes": 3} | keys))


def told(scene: he.TankScene) -> np.ndarray:
    """λ = ±ω² of all modes and growing motions, ascending, zeros included."""
    summary = answer(scene).summary
    growing = [-(mode["growth_rate"] ** 2) for mode in summary["growing"]]
    return np.sort([*growing, *[0.0] * summary["zero_modes"], *(mode["omega"] ** 2 for mode in summary["modes"])])


@pytest.mark.parametrize("name", FLOATS)
def test_motions_that_gravity_couples_balance_stiffness_and_inertia(name: str) -> None:
    """(c − λ(m + a)) of heave, sway and roll is singular for every mode, growing motion and neutral sway."""
    stiffness, inertia, added = statics(without_waves(name))
    # The tolerance asked of ω, twice in its square, and as much of the added mass.
    expected = eigh(stiffness, inertia + added, eigvals_only=True)
    assert told(without_waves(name)) == pytest.approx(expected, rel=4e-6, abs=1e-9 * np.abs(expected).max())
    # Symmetric and positive; a circle turns about a point below its centre, and what moves the liquid is its sway.
    assert np.abs(added - added.T).max() <= 1e-10 * np.abs(added).max()
    assert np.linalg.eigvalsh(added).min() >= -1e-9 * np.abs(added).max()
    coupled = abs(stiffness[0, 2]) > 1e-3 * np.sqrt(abs(stiffness[0, 0] * stiffness[2, 2]))
    assert coupled == (name in ("ship", "keel", "top-heavy"))
    assert (np.min(expected) < -1e-3) == (name in ("upright", "top-heavy"))


STIFFNESS, POINT = (4e3, 1.5e3, 20.0), (0.12, 0.06)


@pytest.mark.parametrize("name", ["circle", "ship"])
def test_springs_add_to_the_stiffness_of_gravity(name: str) -> None:
    """Of the point, in terms of heave, sway and roll about the centre of mass."""
    free = without_waves(name)
    stiffness, inertia, added = statics(free)
    (found,) = answer(free).summary["floats"]
    at = [FLOATS[name].position + POINT[0], POINT[1]]
    held = without_waves(name, attachment=[{"at": at, "stiffness": list(STIFFNESS)}])
    x, y = np.array(at) - found["centre_of_mass"]
    path = np.array([[1.0, 0.0, x], [0.0, 1.0, -y], [0.0, 0.0, 1.0]])
    expected = eigh(stiffness + path.T @ np.diag(STIFFNESS) @ path, inertia + added, eigvals_only=True)
    assert told(held) == pytest.approx(expected, rel=4e-6)
    # Springs matter: sway had none.
    assert told(free)[0] == 0.0


def test_masses_of_float_modes_are_those_that_their_frequencies_balance() -> None:
    """(m + a) ω² = c33 of heave and (I + a) ω² = c55 of roll, in SI units of a tank that is not of unit length."""
    body = rigid("rectangle", 2.0, ALL, half_width=0.5, half_height=0.2, radius_of_gyration=0.3)
    scene = layered(body, densities=(1000.0,), depths=(1.5,), length=4.0, top="free", tolerance=1e-3)
    (found,) = answer(scene).summary["floats"]
    heave, roll = (next(mode for mode in found["modes"] if mode["motion"] == name) for name in ("heave", "roll"))
    mass, inertia = found["mass"] + heave["added_mass"], found["moment_of_inertia"] + roll["added_mass"]
    assert mass * heave["omega"] ** 2 == pytest.approx(found["heave_stiffness"], rel=1e-9)
    assert inertia * roll["omega"] ** 2 == pytest.approx(found["roll_stiffness"], rel=1e-9)


LOOSE = {
    # Sway is free in every tank; heave and pitch of a beam without restoring less one where a volume joins them.
    "sway": (rigid("ellipse", 0.4, "heave sway", half_width=0.1, half_height=0.05), 1),
    "all motions": (rigid("ellipse", 0.4, ALL, half_width=0.1, half_height=0.05), 1),
    "circle": (rigid("ellipse", 0.4, ALL, half_width=0.05, half_height=0.05), 2),
    "heave": (rigid("ellipse", 0.4, half_width=0.1, half_height=0.05), 0),
}


@pytest.mark.slow_but("2-free-all motions", "1-free-heave", "1-pressure_release-sway", "2-rigid-circle")
@pytest.mark.parametrize("kind", LOOSE)
@pytest.mark.parametrize("top", ["rigid", "free", "pressure_release"])
@pytest.mark.parametrize("layers", [1, 2])
def test_motions_without_stiffness_are_counted_and_not_listed(kind: str, top: str, layers: int) -> None:
    floating, expected = LOOSE[kind]
    beam = he.Beam(start=0.6, length=0.3, flexural_rigidity=50.0, mass_per_length=4.0, hydrostatic=False)
    free_beam = 2 if top == "pressure_release" and layers == 1 else 1
    given = {"densities": (1000.0, 850.0)[:layers], "top": top, "tolerance": 1e-2, "modes": 1}
    found = answer(layered(floating, beam, **given)).summary
    assert found["zero_modes"] == expected + free_beam
    assert found["solver"]["count_confirmed_by_inertia"]
    assert found["modes"][0]["omega"] > 1e-3


UNSTABLE: dict[str, he.TankScene] = {
    "upright": layered(FLOATS["upright"], **ONE_LIQUID),
    "two of them": layered(
        rigid("rectangle", 0.25, ALL, half_width=0.03, half_height=0.1, unstable="solve"),
        rigid("wedge", 0.7, "heave roll", half_width=0.04, half_height=0.12, unstable="solve"),
        depths=(0.3, 0.25),
    ),
    # On the top of two liquids that hardly differ: the lowest λ is 10⁻⁴ of −λ, so that 1/λ hides beside it.
    "much faster than waves": layered(
        rigid("parabola", 0.8, ALL, at="surface", half_width=0.02, half_height=0.06, unstable="solve"),
        densities=(1000.0, 999.0),
        depths=(1.0, 1.0),
        top="free",
    ),
}


@pytest.mark.slow_but("upright", "much faster than waves")
@pytest.mark.slow_on_ranks_but("upright")
@pytest.mark.mpi
@pytest.mark.parametrize("name", UNSTABLE)
def test_floats_that_turn_over_grow_a_little_slower_than_without_waves(name: str) -> None:
    """Each is counted; a surface that may rise takes up a few percent of the motion."""
    scene = UNSTABLE[name]
    summary = kept(scene).summary
    assert summary["solver"]["count_confirmed_by_inertia"]
    assert len(summary["growing"]) == (2 if name == "two of them" else 1)
    for growing in summary["growing"]:
        assert growing["relative_error"] <= 1e-8
        assert growing["kind"] == "roll"
    if name != "two of them":
        stiffness, inertia, added = statics(scene)
        released = np.sqrt(-eigh(stiffness, inertia + added, eigvals_only=True)[0])
        # λ of waves is at most some percent of −λ; to the tolerance above.
        assert 0.95 * released <= summary["growing"][0]["growth_rate"] <= released * (1.0 + 1e-7)


@pytest.mark.slow
def test_a_circle_that_turns_about_its_centre_moves_no_liquid() -> None:
    """Its roll is neutral and without added mass: neither a mode nor an influence on any other."""
    circle = {"half_width": 0.1, "half_height": 0.1}
    plain, rolling = (answer(layered(rigid("ellipse", 0.4, it, **circle), **ONE_LIQUID)) for it in ("heave sway", ALL))
    assert (plain.summary["zero_modes"], rolling.summary["zero_modes"]) == (1, 2)
    assert rolling.omega == pytest.approx(plain.omega, rel=1e-11)
    (found,) = rolling.summary["floats"]
    # A curved edge of degree 9 is a circle to some 1e-14.
    added = found["high_frequency"]["added_mass"]
    assert abs(added[2][2]) <= 1e-12 * added[0][0]


def ship_in(size: float, density: float, *, mirrored: bool = False) -> he.TankScene:
    """The tank with the ship as a model of another size, with heavier liquids; a beam beside it."""
    ship, sign = FLOATS["ship"], -1.0 if mirrored else 1.0
    corners = [(sign * x * size, y * size) for x, y in ship.vertices]
    model = ship.model_copy(
        update={
            "position": 0.5 * size,
            "vertices": tuple(corners[::-1] if mirrored else corners),
            "centre_of_mass": ship.centre_of_mass * size,
        }
    )
    beam = he.Beam(
        start=(0.7 if mirrored else 0.1) * size,
        length=0.2 * size,
        flexural_rigidity=density * size**4,
        mass_per_length=2.0 * density * size,
    )
    return layered(
        beam, model, densities=(1000.0 * density, 850.0 * density), depths=(0.3 * size, 0.2 * size), length=size
    )


@pytest.mark.slow_but("0.001-10.0")
@pytest.mark.parametrize(("size", "density"), [(1.0, 1.0), (1e-3, 10.0), (1e3, 0.1)])
def test_the_mirror_image_and_models_of_other_sizes_have_the_same_frequencies(size: float, density: float) -> None:
    model = answer(ship_in(size, density, mirrored=True))
    assert_alike(model, answer(ship_in(1.0, 1.0)), np.sqrt(size))


TWINS = {
    "thin": (rigid("wedge", 0.5, half_width=0.01, half_height=0.1, boundary="thin"),),
    "ellipse": (rigid("ellipse", 0.5, ALL, half_width=0.1, half_height=0.05),),
    "twins": tuple(rigid("wedge", x, ALL, half_width=0.1, half_height=0.05) for x in (0.25, 0.75)),
}


@pytest.mark.slow_but("thin")
@pytest.mark.slow_on_ranks_but("thin")
@pytest.mark.mpi
@pytest.mark.parametrize("name", TWINS)
def test_halves_give_the_modes_of_the_whole_tank(name: str) -> None:
    found = []
    for shift in (0.0, 1e-9):
        bodies = [body.model_copy(update={"position": body.position + shift}) for body in TWINS[name]]
        found.append(answer(layered(*bodies, top="free", modes=8)))
    assert [one.summary["modes"][0]["symmetry"] is not None for one in found] == [True, False]
    assert_alike(*found)
    matrices = [np.array(one.summary["floats"][0]["high_frequency"]["added_mass"]) for one in found]
    assert matrices[0] == pytest.approx(matrices[1], abs=2e-8 * np.abs(matrices[1]).max())


# Far above the waves: added mass in the limit of an unbounded liquid.


def unbounded(shape: str, densities: tuple[float, ...], motions: str = "heave", **keys: Any) -> np.ndarray:
    """Added-mass matrix of a float, kg/m, kg and kg·m, in the limit of a long and deep tank.

    Images in the walls add a part proportional to (R/L)², which two lengths take away; the next is 1e-11.
    """
    found = []
    for length in (500.0, 1000.0):
        scene = layered(
            rigid(shape, 0.5 * length, motions, unstable="solve", **keys),
            densities=densities,
            depths=(0.5 * length,) * len(densities),
            length=length,
            top="free" if len(densities) == 1 else "rigid",
            tolerance=1e-9,
            modes=1,
        )
        high = answer(scene).summary["floats"][0]["high_frequency"]
        assert high["relative_error"] <= 1e-9
        found.append(np.array(high["added_mass"]))
    return found[1] + (found[1] - found[0]) / 3.0


@pytest.mark.slow_but("2.0-1.0-one")
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0), (1000.0, 999.0)], ids=["one", "two", "close"])
@pytest.mark.parametrize(("half_width", "half_height"), [(1.0, 1.0), (2.0, 1.0), (0.1, 1.0)])
def test_ellipses_have_their_added_mass_above_the_waves(
    half_width: float, half_height: float, densities: tuple[float, ...]
) -> None:
    """A circle: π/2 ρR² in heave, 2/π ρR² in sway; the slender one sways like a vertical plate."""
    added = unbounded("ellipse", densities, ALL, half_width=half_width, half_height=half_height)
    exact = (
        half_immersed_ellipse(half_width, half_height, densities[0])
        if len(densities) == 1
        else interface_ellipse(half_width, half_height, *densities)
    )
    # The asked 1e-9 of either length, and the images' next part.
    assert added[0, 0] == pytest.approx(exact.heave, rel=1e-8)
    assert added[1, 1] == pytest.approx(exact.sway, rel=1e-8)
    # A circle does not turn the liquid; errors of an entry are told in parts of what an ellipse like it would turn.
    turned = sum(densities) * max(half_width, half_height) ** 4
    assert added[2, 2] == pytest.approx(exact.roll, rel=1e-8, abs=1e-9 * turned)
    assert added[1, 2] == pytest.approx(exact.sway_roll, abs=1e-8 * np.sqrt(exact.sway * turned))
    assert np.abs(added[0, 1:]).max() <= 1e-12 * added[0, 0]


@pytest.mark.slow
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0)], ids=["one", "two"])
@pytest.mark.parametrize("shape", ["rectangle", "wedge"])
def test_sections_with_corners_have_their_added_mass_above_the_waves(shape: str, densities: tuple[float, ...]) -> None:
    added = unbounded(shape, densities, half_width=1.0, half_height=0.5)
    exact = section_heave_added_mass(float_profile(shape, 1.0, 0.5), *densities)
    assert added[0, 0] == pytest.approx(exact, rel=1e-8)


@pytest.mark.slow
def test_a_thin_float_has_its_added_mass_above_the_waves() -> None:
    (public,) = [case["values"] for case in PUBLIC if case["id"] == "ab_parabola"]
    added = unbounded("parabola", (1000.0, 800.0), half_width=0.1, half_height=1.0, boundary="thin")
    assert added[0, 0] == pytest.approx(1800.0 * 0.01 * float(public["a_hat_inf"]), rel=1e-8)
