"""Stepped and jointed beams in a tank: limits, symmetry, honest errors, and what the author of a scene is told."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tanks import Tanks

from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.tank.mesh import check_mesh, make_mesh
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.modal.beam.estimates import all_estimates, estimates_of_jointed_beams
from hydroelastic.modal.beam.jointed_modes import jointed_modes
from hydroelastic.modal.tank_estimates import floating_beam, tone_estimates
from hydroelastic.physics import beams
from hydroelastic.physics.beam_parts import Joint, Section
from hydroelastic.physics.rigid_motions import zero_mode_count
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.tank.check_tables import boundary_table, group_table, unknown_table
from hydroelastic.scenes.tank.run import run_tank
from hydroelastic.scenes.tank.solve import EstimatedTank

EI, MASS = 5e3, 50.0
SOFT, STIFF = (1.0, EI, MASS), (1.0, 10.0 * EI, 2.0 * MASS)


def sections(*parts: tuple[float, float, float]) -> list[dict[str, float]]:
    return [dict(zip(("length", "flexural_rigidity", "mass_per_length"), part, strict=True)) for part in parts]


def joint(at: float, stiffness: float = 0.0) -> dict[str, float]:
    return {"at": at, "rotational_stiffness": stiffness}


def stepped(*parts: tuple[float, float, float], **keys: Any) -> Beam:
    return Beam(**({"start": 3.0, "sections": sections(*parts)} | keys))


def frequencies(tanks: Tanks, scene: TankScene, *, halves: bool = True) -> tuple[np.ndarray, TankSolution]:
    solution = tanks.solve(scene, halves=halves)
    assert not solution.reasons
    return np.sqrt([mode.eigenvalue for mode in solution.asked]), solution


@pytest.mark.slow
def test_welds_change_nothing(tanks: Tanks) -> None:
    """A joint of 1e12 EI/l, and sections of equal properties, are the uniform beam; solved to 1e-9."""
    uniform, _ = frequencies(tanks, tanks.scene(tanks.beam(hydrostatic=True), tolerance=1e-9))
    welded = tanks.beam(hydrostatic=True, joints=[joint(1.3, 1e12 * EI)])
    cut = stepped((1.0, EI, MASS), (3.0, EI, MASS))
    for beam in (welded, cut):
        omega, solution = frequencies(tanks, tanks.scene(beam, tolerance=1e-9))
        assert omega == pytest.approx(uniform, rel=2e-9)
        assert solution.tank.nodes_of(0)


@pytest.mark.slow
def test_a_hinge_makes_the_plate_softer_and_a_joint_lies_between(tanks: Tanks) -> None:
    """Rayleigh: each frequency rises with the stiffness of the joint."""
    beams = (tanks.beam(hydrostatic=True, joints=[joint(2.0, k)]) for k in (0.0, 1e3, 1e5))
    whole = tanks.beam(hydrostatic=True)
    found = [frequencies(tanks, tanks.scene(beam, modes=20, top="rigid"))[0] for beam in (*beams, whole)]
    for softer, stiffer in pairwise(found):
        assert np.all(softer <= stiffer * (1.0 + 1e-6))
        assert np.any(softer < stiffer * (1.0 - 1e-4))


@pytest.mark.slow_but("2.0")
@pytest.mark.parametrize("at", [0.5, 2.0])
def test_what_a_hinge_does_vanishes_where_the_beam_has_no_moment(tanks: Tanks, at: float) -> None:
    """In the middle of a centred beam it leaves the antisymmetric modes as they are; elsewhere it does not."""
    scenes = [tanks.scene(tanks.beam(hydrostatic=True, joints=joints), modes=10) for joints in ([joint(at)], [])]
    omegas = []
    for scene in scenes:
        omega, solution = frequencies(tanks, scene, halves=True)
        kinds = [solution.field.parity(index) for index in range(len(omega))]
        omegas.append(omega[np.array([kind != "symmetric" for kind in kinds])])
    alike = at == 2.0
    assert (len(omegas[0]) == len(omegas[1])) == alike
    if alike:
        assert omegas[0] == pytest.approx(omegas[1], rel=1e-6)


SYMMETRIC = {
    "hinge in the middle": (
        Beam(start=3.0, length=4.0, flexural_rigidity=EI, mass_per_length=MASS, joints=[joint(2.0)]),
    ),
    "stepped": (
        stepped(
            (1.0, EI, MASS), (2.0, 100.0 * EI, 3.0 * MASS), (1.0, EI, MASS), joints=[joint(1.0, 1e2), joint(3.0, 1e2)]
        ),
    ),
    "twins that are no mirror images of their own": (
        stepped(SOFT, STIFF, start=1.0, joints=[joint(0.4)]),
        stepped(STIFF, SOFT, start=7.0, joints=[joint(1.6)]),
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", SYMMETRIC)
def test_halves_of_a_symmetric_tank_give_the_whole(tanks: Tanks, name: str) -> None:
    scene = tanks.scene(*SYMMETRIC[name], tolerance=1e-8, modes=12)
    halves, solution = frequencies(tanks, scene)
    whole, other = frequencies(tanks, scene, halves=False)
    assert solution.field.half
    assert not other.field.half
    assert halves == pytest.approx(whole, rel=2e-8)
    # Amplitudes of all shapes agree but for sign: the extension from the half to the whole is right.
    for index in range(6):
        one, two = (found.modes.completed(index).body_amplitudes for found in (solution, other))
        scale = max(np.abs(one).max(), 1e-3)
        assert min(np.abs(one - two).max(), np.abs(one + two).max()) < 1e-4 * scale


def test_a_beam_that_is_no_mirror_image_is_solved_whole(tanks: Tanks) -> None:
    scene = tanks.scene(stepped((2.0, EI, MASS), (2.0, 2.0 * EI, MASS)))
    assert not tanks.solve(scene).field.half


@pytest.mark.slow
def test_a_mirrored_tank_has_the_same_frequencies(tanks: Tanks) -> None:
    left = stepped(SOFT, STIFF, start=1.0, joints=[joint(0.4), joint(1.0, 1e3)])
    right = stepped(STIFF, SOFT, start=7.0, joints=[joint(1.6), joint(1.0, 1e3)])
    one, _ = frequencies(tanks, tanks.scene(left, tolerance=1e-9))
    other, _ = frequencies(tanks, tanks.scene(right, tolerance=1e-9))
    assert one == pytest.approx(other, rel=2e-9)


# The reach of the tolerances; references to 1e-10.
HONEST = {
    "hinge": {"beams": (Beam(start=3.0, length=4.0, flexural_rigidity=EI, mass_per_length=MASS, joints=[joint(1.3)]),)},
    "soft and heavy": {"beams": (stepped((1.5, 50.0, 500.0), (2.5, 50.0, 5.0)),), "modes": 16},
    "stiff part": {"beams": (stepped((2.0, 50.0, 10.0), (2.0, 5e6, 10.0), start=2.0),), "modes": 16},
    "at a wall, under a lid": {
        "beams": (stepped((0.5, 5e2, 10.0), (2.0, 5e3, 40.0), start=0.0, joints=[joint(1.5)]),),
        "top": "rigid",
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("name", HONEST)
def test_errors_are_estimated_honestly(tanks: Tanks, name: str) -> None:
    """Neither below a third of the true error nor above thirty times it, where that is more than the reference's."""
    given = dict(HONEST[name])
    beams = given.pop("beams")
    exact = tanks.solve(tanks.scene(*beams, tolerance=1e-10, **given))
    values = exact.modes.eigenvalues
    for tolerance in (1e-4, 1e-6, 1e-8):
        solution = tanks.solve(tanks.scene(*beams, tolerance=tolerance, **given))
        count = len(solution.asked)
        assert not solution.reasons
        true = np.abs(np.sqrt(solution.modes.eigenvalues[:count] / values[:count]) - 1.0)
        estimated = solution.relative_errors[:count]
        seen = true > np.maximum(1e-2 * estimated.max(), 3.0 * exact.relative_errors[:count])
        assert true.max() < tolerance
        assert np.all(estimated[seen] > true[seen] / 3.0)
        assert np.all(estimated[seen] < 30.0 * true[seen])


@pytest.mark.slow
def test_beams_on_an_interface_may_be_jointed(tanks: Tanks) -> None:
    """A welded joint again, between two liquids."""
    liquids = (Liquid(density=1000.0, depth=4.0), Liquid(density=800.0, depth=3.0))
    omegas = []
    for joints in ([], [joint(1.3, 1e12 * EI)]):
        beam = tanks.beam(hydrostatic=True, joints=joints)
        scene = TankScene(tank=Tank(length=10.0), liquid=liquids, body=(beam,), accuracy=Accuracy(modes=6))
        omegas.append(frequencies(tanks, scene)[0])
    assert omegas[0] == pytest.approx(omegas[1], rel=1e-6)


def test_hinges_of_a_beam_without_hydrostatics_cost_nothing(tanks: Tanks) -> None:
    """Heave is tied to the water; pitch and each hinge are modes of frequency zero."""
    beam = tanks.beam(joints=[joint(1.0), joint(2.5), joint(3.0, 10.0)])
    scene = tanks.scene(beam)
    assert zero_mode_count(physical_tank(scene)) == 3
    assert tanks.solve(scene).modes.zero_modes == zero_mode_count(physical_tank(scene))


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_stepped_mass_couples_the_shapes(tanks: Tanks) -> None:
    """On a liquid that is far lighter than itself it keeps its dry modes."""
    beam = stepped((1.0, 5e6, 5e6), (3.0, 5e6, 1e6), hydrostatic=False)
    scene = tanks.scene(beam, top="pressure_release", density=1e-3)
    solution = tanks.solve(scene)
    dry = jointed_modes(
        beams.Beam(
            sections=(
                Section(length=1.0, flexural_rigidity=5e6, mass_per_length=5e6),
                Section(length=3.0, flexural_rigidity=5e6, mass_per_length=1e6),
            )
        ),
        8,
    )
    omega = [solution.omega(mode.eigenvalue) for mode in solution.asked[:6]]
    # The liquid adds 1e-9 of the mass; the tolerance of the scene is 1e-6.
    assert omega == pytest.approx(np.sqrt(dry.squared_frequencies[2:8]), rel=1e-6)


def test_the_dry_frequency_is_that_of_the_whole_beam(tanks: Tanks) -> None:
    beam = stepped((1.0, EI, MASS), (3.0, 2.0 * EI, 3.0 * MASS), joints=[joint(2.0, 1e4)])
    scene = tanks.scene(beam)
    solution = tanks.solve(scene)
    estimated = EstimatedTank(scene=scene, tank=solution, beam=tone_estimates(solution.physical))
    summary = run_tank.summarized(scene, estimated)
    dry = jointed_modes(
        beams.Beam(
            sections=(
                Section(length=1.0, flexural_rigidity=EI, mass_per_length=MASS),
                Section(length=3.0, flexural_rigidity=2.0 * EI, mass_per_length=3.0 * MASS),
            ),
            joints=(Joint(at=2.0, rotational_stiffness=1e4),),
        ),
        3,
    )
    assert summary["first_elastic"]["dry_omega"] == pytest.approx(np.sqrt(dry.squared_frequencies[2]), rel=1e-10)
    assert summary["scene"]["body"][0]["sections"][1]["mass_per_length"] == 150.0
    assert "length" not in summary["scene"]["body"][0]


def test_older_theories_say_that_they_know_uniform_beams_only(tanks: Tanks) -> None:
    estimates = tone_estimates(physical_tank(tanks.scene(tanks.beam(joints=[joint(1.0)]))))
    uniform = tanks.scene(tanks.beam())
    assert estimates.keys() == all_estimates(floating_beam(physical_tank(uniform))).keys()
    assert estimates == estimates_of_jointed_beams()
    for estimate in estimates.values():
        assert estimate.omega is None
        assert "this beam has sections or joints" in estimate.note


SCENE = """
kind = "tank"
[tank]
length = 20.0
[[liquid]]
density = 1000.0
depth = 5.0
[[body]]
start = 3.0
sections = [ {length = 2.5, flexural_rigidity = 47100.0, mass_per_length = 8.36},
             {length = 10.0, flexural_rigidity = 471.0, mass_per_length = 8.36} ]
joints = [ {at = 2.5, rotational_stiffness = 0.0}, {at = 5.0, rotational_stiffness = 10.0} ]
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def test_a_beam_of_sections_is_read_and_written_again(file: Path) -> None:
    scene = read_scene(file)
    beam = scene.beams[0][1]
    assert beam.length == 12.5
    assert beam.mass_per_length == pytest.approx(8.36)
    assert beam.hinges == (2.5,)
    assert TankScene.model_validate(scene.model_dump()) == scene
    assert "joints" not in tanks_uniform().model_dump()


def tanks_uniform() -> Beam:
    return Beam(start=0.0, length=1.0, flexural_rigidity=1.0, mass_per_length=1.0)


MESSAGES = {
    "body.1.length=4.0": 'key "length" = 4.0: it is given beside sections, which have their own. Leave it out',
    "body.1.joints.1.at=12.5": "a joint lies within its beam of 12.5 m, and not at an end",
    "body.1.joints.1.at=13": "a joint lies within its beam of 12.5 m",
    "body.1.joints.1.at=5.0": "there is another joint at this place",
    "body.1.joints.1.at=5.0001": "it is too close to an end, to a step of the beam or to another joint",
    "body.1.joints.1.at=2.501": "it is too close to an end, to a step",
    "body.1.joints.1.at=0.0": "it is too small",
    "body.1.joints.1.rotational_stiffness=-1.0": 'key "joints.rotational_stiffness", entry 1 = -1.0: it is too small',
    "body.1.joints.2.rotational_stiffness=1e-12": "Allowed: 0 for a hinge, or at least",
    'body.1.ends="guided"': "guided ends are for uniform beams; this one has sections",
    "body.1.sections.2.flexural_rigidity=1e-12": 'key "sections.flexural_rigidity", entry 2 = 1e-12: EI/(ρ g l⁴)',
    "body.1.sections.1.length=1e-4": "the section is too short for one mesh",
    "body.1.sections.1.length=30.0": 'key "sections" = 40.0: the beam is longer than the tank (20 m)',
    "body.1.sections.1.lenght=2.0": 'Did you mean "length"?',
    "body.1.sections=3": "it is not a list of tables",
    "body.1.sections=[]": 'key "length": it is missing',
}


@pytest.mark.parametrize("change", MESSAGES)
def test_what_does_not_fit_is_said(file: Path, change: str) -> None:
    with pytest.raises(SceneError) as error:
        read_scene(file, [change])
    assert MESSAGES[change] in str(error.value)


def test_the_check_shows_sections_and_joints(file: Path) -> None:
    scene = read_scene(file)
    texts = [
        " ".join(cell for row in table.rows for cell in row)
        for table in (boundary_table(scene), unknown_table(scene), group_table(scene))
    ]
    assert "(EI w″)″" in texts[0]
    assert "w″ = 0 at its hinges; k Δw′ = EI w″ at its joints" in texts[0]
    assert "a turn about each hinge" in texts[1]
    assert "beam 1: section 2, bending over gravity" in texts[2]
    assert "beam 1: joint 2, its stiffness over gravity" in texts[2]


def test_a_mesh_of_ones_own_needs_nodes_at_joints(tanks: Tanks) -> None:
    scene = tanks.scene(tanks.beam(joints=[joint(1.3)]))
    tank, tagged = tanks.graded_mesh(scene)
    with pytest.raises(
        MeshError, match=r"group body_1 of the mesh has no node at x/L = 0\.43, where the beam has a joint"
    ):
        check_mesh(tank, tagged)
    check_mesh(tank, make_mesh(tank, initial_resolution(tank, scene.accuracy.tolerance, modes=4)))


def test_an_own_mass_matrix_is_symmetric_and_positive(tanks: Tanks) -> None:
    beam = stepped((1.0, EI, MASS), (3.0, 2.0 * EI, 3.0 * MASS))
    (part,) = tanks.solve(tanks.scene(beam)).field.parts
    (body,) = part.pencil.bodies
    assert np.abs(body.mass - body.mass.T).max() < 1e-14 * np.abs(body.mass).max()
    assert np.linalg.eigvalsh(body.mass).min() > 0.0
    assert np.abs(body.mass - np.diag(body.mass.diagonal())).max() > 0.1 * body.mass.max()
    assert solve_modes(part.pencil, 4, shapes=0).eigenvalues[0] > 0.0
