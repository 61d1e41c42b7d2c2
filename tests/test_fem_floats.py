"""Rigid floats in one liquid or two: thin ones against their exact theory, volumes, motions that gravity couples."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from float_problems import ALL, UNSTABLE, raw_problem
from layered_tanks import GRAVITY, PlainProblem, check_processes, frequencies, layered, pencils, rigid

from hydroelastic.fem.added_mass import body_added_mass
from hydroelastic.fem.bodies.rigid_float import in_principal_motions
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.modal.floats.box import BoxModes, box_modes
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.floats import float_section, placed_float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene

PUBLIC = json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
BOXES: dict[str, dict[str, Any]] = {
    case["id"]: case for case in PUBLIC["cases"] if case["kind"] == "closed box eigenfrequencies"
}


def box(inputs: dict[str, str], **changes: Any) -> TankScene:
    """A public case of a thin float in the middle of a box; twelve modes of the tank hold six symmetric ones."""
    value = {name: float(text) for name, text in inputs.items() if name not in ("shape", "mass")}
    two = value["rho1"] > 0.0
    floating = rigid(
        inputs["shape"],
        value["L_half"],
        half_width=value["half_beam"],
        half_height=value["half_height"],
        boundary="thin",
    )
    given = {
        "densities": (value["rho2"], value["rho1"]) if two else (value["rho2"],),
        "depths": (value["h2"], value["h1"]) if two else (value["h2"],),
        "length": 2.0 * value["L_half"],
        "top": "rigid" if two else "free",
        "tolerance": 1e-10,
        "modes": 12,
    }
    return layered(floating, **(given | changes))


def symmetric(tanks: Any, scene: TankScene) -> tuple[np.ndarray, np.ndarray]:
    """ω and modal mass of heave, kg/m, of the symmetric modes of a tank with one float."""
    solution = tanks.solve(scene)
    modes = [mode for number, mode in enumerate(solution.asked) if solution.field.parity(number) == "symmetric"]
    masses = [solution.units.density * solution.units.length**2 / mode.body_amplitudes[0] ** 2 for mode in modes]
    return np.array([solution.omega(mode.eigenvalue) for mode in modes]), np.array(masses)


@pytest.mark.slow_but("box_2_wedge")
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("name", BOXES)
def test_thin_floats_have_every_digit_of_the_public_boxes(tanks: Any, name: str) -> None:
    scene, values = box(BOXES[name]["inputs"]), BOXES[name]["values"]
    omega, masses = symmetric(tanks, scene)
    assert tanks.solve(scene).reasons == ()
    expected = np.array([float(text) for text in values["omega"]])[: len(omega)]
    assert len(omega) >= 5
    # Rounding at degree 9; measured 3e-13 of ω and 8e-12 of modal masses.
    assert omega == pytest.approx(expected, rel=1e-11)
    assert masses == pytest.approx([float(text) for text in values["modal_mass"]][: len(masses)], rel=1e-9)
    (mode,) = tanks.solve(scene).float_modes
    assert tanks.solve(scene).omega(tanks.solve(scene).modes.eigenvalues[mode.index]) == pytest.approx(
        float(values["omega_float"]), rel=1e-11
    )


@pytest.mark.parametrize("name", BOXES)
def test_thin_floats_have_the_public_added_mass_above_the_waves(tanks: Any, name: str) -> None:
    values = BOXES[name]["values"]
    solution = tanks.solve(box(BOXES[name]["inputs"]))
    added = solution.added_mass.matrix[0, 0] * solution.units.density * solution.units.length**2
    # The asked 1e-10, of some tenth of the sum.
    assert added + float(values["body_mass"]) == pytest.approx(float(values["M_inf"]), rel=1e-10)


THIN = {
    "ellipse": {"half_width": 0.1, "half_height": 1.0},
    "exponential": {"half_width": 0.1, "half_height": 0.18},
    "parabola": {"half_width": 0.05, "half_height": 0.5},
    "wedge": {"half_width": 0.1, "half_height": 1.0},
}


def box_theory(scene: TankScene, count: int, *, volume_term: bool = True) -> BoxModes:
    """The exact modes of a thin float in the middle of a box."""
    body = scene.body[0]
    assert isinstance(body, Float)
    rest = placed_float(scene, 0).hydrostatics
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
        mass=rest.mass,
        stiffness=rest.heave_stiffness,
        profile=float_section(body),
    )
    return box_modes(floating, count, volume_term=volume_term)


@pytest.mark.slow_but("ellipse-two", "wedge-one")
@pytest.mark.parametrize("densities", [(1000.0,), (1000.0, 800.0), (1000.0, 999.0)], ids=["one", "two", "close"])
@pytest.mark.parametrize("shape", THIN)
def test_thin_floats_of_all_shapes_have_their_exact_modes(tanks: Any, shape: str, densities: tuple[float, ...]) -> None:
    scene = layered(
        rigid(shape, 6.0, boundary="thin", **THIN[shape]),
        densities=densities,
        depths=(2.0, 1.5),
        length=12.0,
        top="free" if len(densities) == 1 else "rigid",
        modes=9,
    )
    omega, masses = symmetric(tanks, scene)
    theory = box_theory(scene, len(omega))
    assert tanks.solve(scene).reasons == ()
    # The asked tolerance is 1e-8; measured 3e-11 and below. Modal masses err some hundred times as much.
    assert omega == pytest.approx(theory.omega, rel=1e-9)
    assert masses == pytest.approx(theory.modal_mass, rel=1e-7)


# The volume constraint. Box 1 on a coarse mesh: ω to some 1e-6.
BOX_1 = box(BOXES["box_1_parabola"]["inputs"], tolerance=1e-4, modes=4)
SPURIOUS, HELD_FLOAT = (0.15, 0.3), 1.228003


@pytest.fixture(scope="module")
def box_1() -> CoupledPencil:
    """The symmetric half of box 1."""
    return pencils(BOX_1, half=True, coarse=False)[0]


def test_without_the_volume_constraint_there_is_a_spurious_mode(box_1: CoupledPencil) -> None:
    """With one ψ held in each liquid and ∫ζ left free there is a mode near 0.2 rad/s that does not exist.

    Liquid comes and goes at the held points, so that it depends on where they are; 0.2096 on the mesh of bilinear
    squares for which it was first told.
    """
    plain = PlainProblem(box_1)
    for last in (0, -1):
        pins = np.array([np.flatnonzero(box_1.liquid.owned_layer_of == layer)[last] for layer in (0, 1)])
        basis = np.eye(len(plain.stiffness))
        inertia = plain.mass + plain.added_mass(basis, pins)
        values = np.sort(np.linalg.eigvals(np.linalg.solve(inertia, plain.stiffness)).real)
        omega = frequencies(values[:4], BOX_1)
        assert SPURIOUS[0] < omega[0] < SPURIOUS[1]
        # The others move by 1e-4 and more: there are sources in the liquid.
        assert np.abs(omega[1:4] / 0.63162177521778 - 1.0).min() > 1e-5


def test_the_package_keeps_the_volume_and_has_no_spurious_mode(tanks: Any, box_1: CoupledPencil) -> None:
    expected = [float(text) for text in BOXES["box_1_parabola"]["values"]["omega"]][:4]
    plain = PlainProblem(box_1)
    # The basis that keeps both volumes, which are the same condition.
    assert np.abs(plain.volumes.sum(axis=0)).max() <= 1e-12 * np.abs(plain.volumes).max()
    assert frequencies(plain.eigenvalues(4), BOX_1) == pytest.approx(expected, rel=1e-5)
    assert frequencies(solve_modes(box_1, 4).eigenvalues, BOX_1) == pytest.approx(expected, rel=1e-5)
    assert symmetric(tanks, BOX_1)[0][0] > 2.0 * SPURIOUS[1]


def test_the_mean_level_rises_as_the_float_sinks(box_1: CoupledPencil) -> None:
    """Box 1 without the restoring of the mean level, c instead of c (1 + 2b/L): the float slows from 1.234606."""
    plain = PlainProblem(box_1)
    mean = plain.volumes[0].copy()
    mean[0] = 0.0
    level = physical_tank(BOX_1).scaled().levels[0]
    held = plain.stiffness - level.jump * np.outer(mean, mean) / mean.sum()
    omega = frequencies(plain.eigenvalues(5, stiffness=held), BOX_1)
    body = box_theory(BOX_1, 5, volume_term=False)
    assert omega == pytest.approx(body.omega, rel=1e-5)
    assert np.abs(omega - HELD_FLOAT).min() <= 2e-5


FLOATS: dict[str, TankScene] = {
    "circle": layered(
        rigid("ellipse", 0.4, ALL, half_width=0.1, half_height=0.1, centre_of_mass=-0.02),
        densities=(1000.0,),
        top="free",
    ),
    "ship": layered(
        rigid(
            "polygon",
            0.5,
            ALL,
            vertices=((-0.12, -0.03), (-0.08, -0.08), (0.05, -0.08), (0.11, -0.02), (0.12, 0.06), (-0.12, 0.06)),
            centre_of_mass=-0.03,
        ),
        depths=(0.3, 0.2),
    ),
    "keel": layered(
        rigid(
            "polygon",
            0.6,
            ALL,
            vertices=((-0.1, -0.02), (0.02, -0.12), (0.06, -0.02), (0.1, 0.05), (-0.1, 0.05)),
            centre_of_mass=-0.04,
        ),
        densities=(1000.0,),
        top="free",
    ),
}


@pytest.mark.slow_but("keel")
@pytest.mark.parametrize("name", FLOATS)
def test_frequencies_do_not_depend_on_the_principal_motions(name: str) -> None:
    """Heave and roll of unsymmetric sections are coupled by gravity: against the full 3 × 3 stiffness."""
    scene = FLOATS[name]
    stiffness = physical_tank(scene).scaled().floats[0].stiffness
    assert (abs(stiffness[0, 2]) > 1e-3 * np.sqrt(stiffness[0, 0] * stiffness[2, 2])) == (name != "circle")
    (pencil,) = pencils(scene)
    modes = solve_modes(pencil, 8, shapes=0)
    values = raw_problem(scene, pencil).eigenvalues(9)
    # Sway has no stiffness. Both round λ + 1 to some 1e-13.
    assert modes.zero_modes == 1
    assert abs(values[0]) <= 1e-11
    assert values[1:] == pytest.approx(modes.eigenvalues, rel=1e-9)


def test_the_principal_motions_diagonalize_stiffness_and_inertia() -> None:
    for scene in FLOATS.values():
        floating = physical_tank(scene).scaled().floats[0]
        body = in_principal_motions(floating, 0, None)
        square = np.linalg.eigvalsh(floating.stiffness / np.sqrt(np.outer(floating.inertia, floating.inertia)))
        # The eigenvalues of the float alone, in vacuo; zero is zero to rounding of the largest.
        assert np.sort(body.stiffness / body.mass.diagonal()) == pytest.approx(
            square, rel=1e-12, abs=1e-14 * square.max()
        )


@pytest.mark.slow
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_circle_that_turns_about_its_centre_moves_no_liquid(tanks: Any) -> None:
    """Its roll is neutral and without added mass: neither a mode nor an influence on any other."""
    circle = {"half_width": 0.1, "half_height": 0.1}
    given = {"densities": (1000.0,), "top": "free"}
    plain = tanks.solve(layered(rigid("ellipse", 0.4, "heave sway", **circle), **given))
    rolling = tanks.solve(layered(rigid("ellipse", 0.4, ALL, **circle), **given))
    assert (plain.modes.zero_modes, rolling.modes.zero_modes) == (1, 2)
    found, expected = ([mode.eigenvalue for mode in solution.asked] for solution in (rolling, plain))
    assert found == pytest.approx(expected, rel=1e-11)
    # A curved edge of degree 9 is a circle to some 1e-14.
    assert abs(rolling.added_mass.matrix[2, 2]) <= 1e-12 * rolling.added_mass.matrix[0, 0]


def modes_of(solution: TankSolution) -> np.ndarray:
    return np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])


def mirrored(vertices: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
    return tuple((-x, y) for x, y in reversed(vertices))


@pytest.mark.slow
def test_the_mirror_image_of_a_tank_has_the_same_frequencies(tanks: Any) -> None:
    ship = FLOATS["ship"].body[0]
    beam = {"length": 0.2, "flexural_rigidity": 1.0, "mass_per_length": 2.0}
    left = layered(Beam(start=0.1, **beam), ship)
    right = layered(
        Beam(start=0.7, **beam),
        ship.model_copy(update={"position": 1.0 - ship.position, "vertices": mirrored(ship.vertices)}),
    )
    one, other = tanks.solve(left), tanks.solve(right)
    allowed = one.relative_errors[:6] + other.relative_errors[:6]
    assert np.all(np.abs(modes_of(one) / modes_of(other) - 1.0) <= allowed)
    assert one.float_modes[0].index == other.float_modes[0].index


def ship_of(size: float, density: float) -> TankScene:
    """The tank with the ship as a model of another size, with heavier liquids."""
    ship = FLOATS["ship"].body[0]
    small = ship.model_copy(
        update={
            "position": ship.position * size,
            "vertices": tuple((x * size, y * size) for x, y in ship.vertices),
            "centre_of_mass": ship.centre_of_mass * size,
        }
    )
    return layered(small, densities=(1000.0 * density, 850.0 * density), depths=(0.3 * size, 0.2 * size), length=size)


@pytest.mark.parametrize(("size", "density"), [(1e-3, 10.0), (1e3, 0.1)])
def test_models_have_the_same_dimensionless_float(size: float, density: float) -> None:
    model, ship = (physical_tank(scene).scaled().floats[0] for scene in (ship_of(size, density), FLOATS["ship"]))
    # Rounding, of centres that are differences among the rest.
    assert model.stiffness == pytest.approx(ship.stiffness, rel=1e-11)
    assert model.inertia == pytest.approx(ship.inertia, rel=1e-11)
    assert model.hydrostatics.free_roll_stiffness == pytest.approx(ship.hydrostatics.free_roll_stiffness, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "density"), [(1e-3, 1.0), (1.0, 10.0), (1e3, 0.1)])
def test_millimetres_and_heavier_liquids_give_the_same_digits(tanks: Any, size: float, density: float) -> None:
    scaled = ship_of(size, density)
    # Rounding of the input may move the nodes of the mesh by its last digits.
    assert modes_of(tanks.solve(scaled)) * np.sqrt(size) == pytest.approx(
        modes_of(tanks.solve(FLOATS["ship"])), rel=1e-10
    )


SYMMETRIC: dict[str, TankScene] = {
    "ellipse": layered(rigid("ellipse", 0.5, ALL, half_width=0.1, half_height=0.05), modes=8),
    "rectangle": layered(
        rigid("rectangle", 0.5, ALL, half_width=0.1, half_height=0.05), densities=(1000.0,), top="free", modes=8
    ),
    "thin": layered(rigid("wedge", 0.5, half_width=0.01, half_height=0.1, boundary="thin"), modes=8),
    "twins": layered(
        rigid("wedge", 0.25, ALL, half_width=0.1, half_height=0.05),
        rigid("wedge", 0.75, ALL, half_width=0.1, half_height=0.05),
        top="free",
        modes=8,
    ),
}


@pytest.mark.slow
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("name", SYMMETRIC)
def test_halves_give_the_modes_of_the_whole_tank(tanks: Any, name: str) -> None:
    halves, whole = (tanks.solve(SYMMETRIC[name], halves=which) for which in (True, False))
    assert halves.field.half
    assert not whole.field.half
    assert halves.counted
    assert whole.counted
    assert halves.modes.zero_modes == whole.modes.zero_modes
    allowed = halves.relative_errors[:8] + whole.relative_errors[:8]
    assert np.all(np.abs(modes_of(halves) / modes_of(whole) - 1.0) <= allowed)
    for one, other in zip(halves.asked, whole.asked, strict=True):
        # Shapes err like the root of frequencies; amplitudes are of order one to ten.
        assert np.abs(one.body_amplitudes) == pytest.approx(np.abs(other.body_amplitudes), rel=1e-4, abs=1e-4)
        assert one.energy == pytest.approx(other.energy, abs=1e-3)
    matrices = [solution.added_mass.matrix for solution in (halves, whole)]
    assert matrices[0] == pytest.approx(matrices[1], abs=2e-8 * np.abs(matrices[1]).max())


@pytest.mark.slow_but("ship-*")
@pytest.mark.parametrize("infinite_frequency", [False, True])
@pytest.mark.parametrize("name", FLOATS)
def test_added_mass_is_symmetric_and_positive(name: str, infinite_frequency: bool) -> None:
    (pencil,) = pencils(FLOATS[name], infinite_frequency=infinite_frequency)
    added = body_added_mass(pencil)
    largest = np.abs(added).max()
    # One factorization serves all columns: rounding of the largest.
    assert np.abs(added - added.T).max() <= 1e-13 * largest
    # The circle turns about a point below its centre, and what moves the liquid is its sway.
    assert np.linalg.eigvalsh(added).min() >= -1e-13 * largest


PROCESSES: dict[str, TankScene] = {
    "thin": layered(rigid("ellipse", 0.4, half_width=0.01, half_height=0.1, boundary="thin")),
    "thin in the middle": SYMMETRIC["thin"],
    "ship": FLOATS["ship"],
    "unstable": UNSTABLE["top-heavy"],
    "twins": SYMMETRIC["twins"],
    "float, slit and beam": layered(
        rigid("rectangle", 0.2, ALL, half_width=0.1, half_height=0.05),
        rigid("wedge", 0.4, half_width=0.01, half_height=0.1, boundary="thin"),
        Beam(start=0.6, length=0.3, flexural_rigidity=1.0, mass_per_length=2.0),
        top="free",
    ),
    "on top of two liquids": layered(
        rigid("ellipse", 0.3, at="surface", half_width=0.1, half_height=0.05),
        rigid("ellipse", 0.7, "heave roll", half_width=0.1, half_height=0.05),
        top="pressure_release",
    ),
}


@pytest.mark.slow_on_ranks_but("unstable")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("name", PROCESSES)
def test_two_processes_find_what_one_finds(name: str) -> None:
    check_processes(PROCESSES[name])


def test_without_the_volume_the_theory_has_the_slower_float() -> None:
    assert np.abs(box_theory(BOX_1, 5, volume_term=False).omega - HELD_FLOAT).min() <= 1e-6
