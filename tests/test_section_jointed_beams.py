"""Stepped, jointed and varying beams in a tank: limits, symmetry, honest errors, and what is refused."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from answers import answer, assert_alike, kept
from section_tanks import beam, tank

import hydroelastic as he
from hydroelastic.modal.beam.jointed_modes import jointed_modes
from hydroelastic.physics import beams
from hydroelastic.physics.beam_parts import Joint, Section

EI, MASS = 5e3, 50.0
SOFT, STIFF = (1.0, EI, MASS), (1.0, 10.0 * EI, 2.0 * MASS)
NAMES = ("length", "flexural_rigidity", "mass_per_length")


def joint(at: float, stiffness: float = 0.0) -> dict[str, float]:
    return {"at": at, "rotational_stiffness": stiffness}


def stepped(*parts: tuple[float, float, float], **keys: Any) -> he.Beam:
    sections = [dict(zip(NAMES, part, strict=True)) for part in parts]
    return he.Beam(**({"start": 3.0, "sections": sections} | keys))


def physical(*parts: tuple[float, float, float], joints: tuple[tuple[float, float], ...] = ()) -> beams.Beam:
    return beams.Beam(
        sections=tuple(Section(**dict(zip(NAMES, part, strict=True))) for part in parts),
        joints=tuple(Joint(at=at, rotational_stiffness=stiffness) for at, stiffness in joints),
    )


@pytest.mark.slow
def test_welds_change_nothing() -> None:
    """A joint of 1e12 EI/l, and sections of equal properties, are the uniform beam; solved to 1e-9."""
    uniform = kept(tank(beam(hydrostatic=True), tolerance=1e-9)).omega
    for body in (beam(hydrostatic=True, joints=[joint(1.3, 1e12 * EI)]), stepped((1.0, EI, MASS), (3.0, EI, MASS))):
        assert kept(tank(body, tolerance=1e-9)).omega == pytest.approx(uniform, rel=2e-9)


@pytest.mark.slow
def test_a_hinge_makes_the_plate_softer_and_a_joint_lies_between() -> None:
    """Rayleigh: each frequency rises with the stiffness of the joint."""
    bodies = (beam(hydrostatic=True, joints=[joint(2.0, k)]) for k in (0.0, 1e3, 1e5))
    found = [kept(tank(body, modes=20, top="rigid")).omega for body in (*bodies, beam(hydrostatic=True))]
    for softer, stiffer in pairwise(found):
        assert np.all(softer <= stiffer * (1.0 + 1e-6))
        assert np.any(softer < stiffer * (1.0 - 1e-4))


@pytest.mark.slow_but("2.0")
@pytest.mark.parametrize("at", [0.5, 2.0])
def test_what_a_hinge_does_vanishes_where_the_beam_has_no_moment(at: float) -> None:
    """In the middle of a centred beam it leaves the antisymmetric modes as they are; elsewhere it does not."""
    omegas = []
    for joints in ([joint(at)], []):
        modes = kept(tank(beam(hydrostatic=True, joints=joints), modes=10)).summary["modes"]
        omegas.append([mode["omega"] for mode in modes if mode["symmetry"] != "symmetric"])
    alike = at == 2.0
    assert (len(omegas[0]) == len(omegas[1])) == alike
    if alike:
        assert omegas[0] == pytest.approx(omegas[1], rel=1e-6)


TWINS = (stepped(SOFT, STIFF, start=1.0, joints=[joint(0.4)]), stepped(STIFF, SOFT, start=7.0, joints=[joint(1.6)]))


@pytest.mark.slow
def test_halves_of_a_symmetric_tank_give_the_whole() -> None:
    """Twins that are no mirror images of their own; a hair off the tank is solved whole."""
    moved = TWINS[0].model_copy(update={"start": 1.0 + 1e-8})
    halves, whole = (answer(tank(one, TWINS[1], tolerance=1e-8, modes=12)) for one in (TWINS[0], moved))
    assert [one.summary["modes"][0]["symmetry"] is not None for one in (halves, whole)] == [True, False]
    # The shift is 1e-9 of the tank.
    assert np.all(np.abs(halves.omega / whole.omega - 1.0) <= halves.estimates + whole.estimates + 1e-8)


def test_a_beam_that_is_no_mirror_image_is_solved_whole_and_mirrored_has_the_same_frequencies() -> None:
    left = stepped(SOFT, STIFF, start=1.0, joints=[joint(0.4), joint(1.0, 1e3)])
    right = stepped(STIFF, SOFT, start=7.0, joints=[joint(1.6), joint(1.0, 1e3)])
    one, other = (kept(tank(body)) for body in (left, right))
    assert_alike(one, other)
    assert answer(tank(stepped((2.0, EI, MASS), (2.0, 2.0 * EI, MASS)))).summary["modes"][0]["symmetry"] is None


# The reach of the tolerances; references to 1e-10.
HONEST: dict[str, dict[str, Any]] = {
    "hinge": {"beams": (beam(hydrostatic=True, joints=[joint(1.3)]),)},
    "soft and heavy": {"beams": (stepped((1.5, 50.0, 500.0), (2.5, 50.0, 5.0)),), "modes": 16},
    "stiff part": {"beams": (stepped((2.0, 50.0, 10.0), (2.0, 5e6, 10.0), start=2.0),), "modes": 16},
    "at a wall, under a lid": {
        "beams": (stepped((0.5, 5e2, 10.0), (2.0, 5e3, 40.0), start=0.0, joints=[joint(1.5)]),),
        "top": "rigid",
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("name", HONEST)
def test_errors_are_estimated_honestly(name: str) -> None:
    """Neither below a third of the true error nor above thirty times it, where that is more than the reference's."""
    given = dict(HONEST[name])
    bodies = given.pop("beams")
    exact = answer(tank(*bodies, tolerance=1e-10, **given))
    for tolerance in (1e-4, 1e-6, 1e-8):
        found = kept(tank(*bodies, tolerance=tolerance, **given))
        true, estimated = np.abs(found.errors(exact.omega)), found.estimates
        seen = true > np.maximum(1e-2 * estimated.max(), 3.0 * exact.estimates)
        assert true.max() < tolerance
        assert np.all(estimated[seen] > true[seen] / 3.0)
        assert np.all(estimated[seen] < 30.0 * true[seen])


def test_hinges_of_a_beam_without_hydrostatics_cost_nothing() -> None:
    """Heave is tied to the water; pitch and each hinge are modes of frequency zero."""
    body = beam(joints=[joint(1.0), joint(2.5), joint(3.0, 10.0)])
    assert kept(tank(body)).summary["zero_modes"] == 3


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_stepped_mass_couples_the_shapes() -> None:
    """On a liquid that is far lighter than itself it keeps its dry modes."""
    parts = ((1.0, 5e6, 5e6), (3.0, 5e6, 1e6))
    found = kept(tank(stepped(*parts, hydrostatic=False), top="pressure_release", density=1e-3))
    # The liquid adds 1e-9 of the mass; the tolerance of the scene is 1e-6.
    dry = np.sqrt(jointed_modes(physical(*parts), 8).squared_frequencies[2:8])
    assert found.omega[:6] == pytest.approx(dry, rel=1e-6)


def test_the_dry_frequency_is_that_of_the_whole_beam_and_older_theories_have_none() -> None:
    parts = ((1.0, EI, MASS), (3.0, 2.0 * EI, 3.0 * MASS))
    summary = kept(tank(stepped(*parts, joints=[joint(2.0, 1e4)]))).summary
    dry = jointed_modes(physical(*parts, joints=((2.0, 1e4),)), 3)
    assert summary["first_elastic"]["dry_omega"] == pytest.approx(np.sqrt(dry.squared_frequencies[2]), rel=1e-10)
    assert all(estimate["omega"] is None for estimate in summary["estimates"].values())


JOINTED: dict[str, Any] = {
    "kind": "tank",
    "tank": {"length": 20.0},
    "liquid": [{"density": 1000.0, "depth": 5.0}],
    "body": [
        {
            "start": 3.0,
            "sections": [dict(zip(NAMES, part, strict=True)) for part in ((2.5, 47100.0, 8.36), (10.0, 471.0, 8.36))],
            "joints": [joint(2.5), joint(5.0, 10.0)],
        }
    ],
}

MESSAGES: list[tuple[str, Any, str]] = [
    ("body.1.length", 4.0, 'key "length" = 4.0: it is given beside sections, which have their own'),
    ("body.1.joints.1.at", 12.5, "a joint lies within its beam of 12.5 m, and not at an end"),
    ("body.1.joints.1.at", 5.0, "there is another joint at this place"),
    ("body.1.joints.1.at", 5.0001, "it is too close to an end, to a step of the beam or to another joint"),
    ("body.1.joints.1.at", 2.501, "it is too close to an end, to a step"),
    ("body.1.joints.1.rotational_stiffness", -1.0, 'key "joints.rotational_stiffness", entry 1 = -1.0: it is too'),
    ("body.1.joints.2.rotational_stiffness", 1e-12, "Allowed: 0 for a hinge, or at least"),
    ("body.1.ends", "guided", "guided ends are for uniform beams; this one has sections"),
    ("body.1.sections.2.flexural_rigidity", 1e-12, 'key "sections.flexural_rigidity", entry 2 = 1e-12: EI/(ρ g l⁴)'),
    ("body.1.sections.1.length", 1e-4, "the section is too short for one mesh"),
    ("body.1.sections.1.length", 30.0, 'key "sections" = 40.0: the beam is longer than the tank (20 m)'),
    ("body.1.sections", [], 'key "length": it is missing'),
]


@pytest.mark.parametrize(("key", "value", "said"), MESSAGES)
def test_what_does_not_fit_is_said(key: str, value: Any, said: str) -> None:
    with pytest.raises(he.SceneError) as error:
        he.read(JOINTED, {key: value})
    assert said in str(error.value)


# Beams of varying thickness.

THICKNESS = [(0.0, 0.1), (2.5, 0.3), (4.0, 0.15)]
MATERIAL = {"youngs_modulus": 4e6, "poisson_ratio": 0.3, "density": 600.0}


def plate(**values: Any) -> dict[str, Any]:
    return {"kind": "varying_beam", "start": 2.0, "thickness": THICKNESS} | MATERIAL | values


def on_water(body: Any, **more: Any) -> he.TankScene:
    return tank(body, depth=2.0, **({"tolerance": 1e-8, "modes": 5} | more))


def staircase(steps: int) -> dict[str, Any]:
    """The same plate as uniform sections of equal length, each with the values of its middle."""
    edges = np.linspace(0.0, 4.0, steps + 1)
    thickness = np.interp(0.5 * (edges[1:] + edges[:-1]), *np.transpose(THICKNESS))
    values = zip(4e6 * thickness**3 / (12.0 * (1.0 - 0.3**2)), 600.0 * thickness, strict=True)
    sections = [dict(zip(NAMES, (4.0 / steps, float(ei), float(m)), strict=True)) for ei, m in values]
    return {"kind": "beam", "start": 2.0, "sections": sections}


@pytest.mark.slow
def test_a_beam_of_eight_steps_is_nearly_the_same() -> None:
    exact, steps = (kept(on_water(body, tolerance=1e-5, modes=4)).omega for body in (plate(), staircase(8)))
    # Measured −1.5e-5 to −3.6e-4: of second order in the length of the steps, and a quarter of it with sixteen.
    assert np.all((steps / exact - 1.0 > -5e-4) & (steps < exact))


@pytest.mark.slow
def test_it_is_the_limit_of_beams_of_many_steps() -> None:
    exact = kept(on_water(plate())).omega
    # Step edges at the kink of the thickness, 2.5 of 4 m.
    counts = np.array([8, 16, 32])
    errors = np.array([kept(on_water(staircase(count))).omega / exact - 1.0 for count in counts])
    felt = np.abs(errors[0]) > 1e-4
    assert felt.any()
    for mode in np.flatnonzero(felt):
        # Values of the middles are right to second order in the length of the steps.
        order = -np.polyfit(np.log(counts), np.log(np.abs(errors[:, mode])), 1)[0]
        assert order == pytest.approx(2.0, abs=0.1)
    # Richardson's extrapolation leaves the fourth order: a sixteenth of what it was before, 1e-4 of the error.
    limit = (4.0 * errors[2] - errors[1]) / 3.0
    assert np.abs(limit).max() < 0.02 * np.abs(errors[2]).max()


@pytest.mark.slow
def test_a_mirrored_plate_has_the_same_frequencies() -> None:
    mirrored = [(4.0 - x, value) for x, value in reversed(THICKNESS)]
    one, other = (kept(on_water(body)) for body in (plate(), plate(start=4.0, thickness=mirrored)))
    assert_alike(one, other)


@pytest.mark.slow
def test_rigidity_and_mass_may_be_given_instead_of_a_thickness() -> None:
    tables = {"flexural_rigidity": [(0.0, 5e3), (1.0, 5e3), (4.0, 5e3)], "mass_per_length": [(0.0, 50.0), (4.0, 50.0)]}
    varying, uniform = ({"kind": "varying_beam", "start": 3.0} | tables, beam(hydrostatic=True))
    assert kept(on_water(varying)).omega == pytest.approx(kept(on_water(uniform)).omega, rel=2e-8)


def test_steps_of_a_table_are_sections() -> None:
    table = [(0.0, 0.1), (2.0, 0.1), (2.0, 0.2), (4.0, 0.2)]
    parts = [(2.0, 4e6 * t**3 / (12.0 * (1.0 - 0.3**2)), 600.0 * t) for t in (0.1, 0.2)]
    varying, steps = plate(thickness=table), stepped(*parts, start=2.0)
    assert kept(on_water(varying)).omega == pytest.approx(kept(on_water(steps)).omega, rel=2e-8)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"density": None}, "it is missing"),
        ({"mass_per_length": [(0.0, 1.0), (4.0, 1.0)]}, "it has no effect: there is a thickness"),
        ({"thickness": [(0.5, 0.1), (4.0, 0.2)]}, "the first row is not at the left end"),
        ({"thickness": [(0.0, 0.1), (4.0, 0.2), (3.0, 0.1)]}, "rows go from left to right"),
        ({"thickness": [(0.0, 0.1), (2.0, 0.2), (2.0, 0.3), (2.0, 0.1), (4.0, 0.1)]}, "at most two at one x"),
        ({"thickness": [(0.0, 0.1), (4.0, 0.2), (4.0, 0.1)]}, "a step lies at an end of the beam"),
        ({"start": 7.0}, "outside the tank"),
        ({"youngs_modulus": 1e-20}, "beyond the resolution of double precision"),
    ],
)
def test_what_is_no_plate_is_refused_in_words(change: dict[str, Any], said: str) -> None:
    with pytest.raises(he.SceneError, match=said):
        on_water(plate(**change))
