"""Beams of varying thickness in scenes: against beams of many steps, mirrored, in other units, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.varying_beam import VaryingBeam
from hydroelastic.scenes.tank.solve import solve_scene

THICKNESS = [(0.0, 0.1), (2.5, 0.3), (4.0, 0.15)]
MATERIAL = {"youngs_modulus": 4e6, "poisson_ratio": 0.3, "density": 600.0}


def plate(**values: Any) -> dict[str, Any]:
    return {"kind": "varying_beam", "start": 2.0, "thickness": THICKNESS} | MATERIAL | values


def scene(body: Any, *, tolerance: float = 1e-8, modes: int = 5, length: float = 10.0, **more: Any) -> TankScene:
    return TankScene.model_validate(
        {
            "tank": {"length": length},
            "liquid": [{"density": 1000.0, "depth": 0.2 * length}],
            "body": [body],
            "accuracy": {"tolerance": tolerance, "modes": modes},
        }
        | more
    )


def frequencies(given: TankScene, *, halves: bool = True) -> np.ndarray:
    solution = solve_scene(given, halves=halves)
    assert solution.reasons == ()
    return np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])


def staircase(steps: int) -> dict[str, Any]:
    """The same plate as uniform sections of equal length, each with the values of its middle."""
    given = VaryingBeam.model_validate(plate())
    edges = np.linspace(0.0, given.length, steps + 1)
    middles = 0.5 * (edges[1:] + edges[:-1])
    values = zip(given.rigidity_at(middles), given.mass_at(middles), strict=True)
    sections = [
        {"length": given.length / steps, "flexural_rigidity": float(ei), "mass_per_length": float(m)}
        for ei, m in values
    ]
    return {"kind": "beam", "start": 2.0, "sections": sections}


@pytest.mark.slow
def test_a_beam_of_eight_steps_is_nearly_the_same() -> None:
    exact, steps = (frequencies(scene(body, tolerance=1e-5, modes=4)) for body in (plate(), staircase(8)))
    # Measured −1.5e-5 to −3.6e-4: of second order in the length of the steps, and a quarter of it with sixteen.
    assert np.all((steps / exact - 1.0 > -5e-4) & (steps < exact))


@pytest.mark.slow
@pytest.mark.mpi
def test_it_is_the_limit_of_beams_of_many_steps() -> None:
    exact = frequencies(scene(plate()))
    # Step edges at the kink of the thickness, 2.5 of 4 m.
    counts = np.array([8, 16, 32])
    errors = np.array([frequencies(scene(staircase(count))) / exact - 1.0 for count in counts])
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
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_a_plate_that_is_its_own_mirror_image_is_solved_as_two_halves() -> None:
    table = [(0.0, 0.1), (2.0, 0.25), (4.0, 0.1)]
    given = scene(plate(start=3.0, thickness=table))
    solution = solve_scene(given)
    assert solution.field.half
    found = np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])
    # Both keep the tolerance of 1e-8.
    assert found == pytest.approx(frequencies(given, halves=False), rel=2e-8)


@pytest.mark.slow
def test_a_mirrored_plate_has_the_same_frequencies() -> None:
    mirrored = [(4.0 - x, value) for x, value in reversed(THICKNESS)]
    assert frequencies(scene(plate(start=4.0, thickness=mirrored))) == pytest.approx(
        frequencies(scene(plate())), rel=2e-8
    )


@pytest.mark.slow
def test_rigidity_and_mass_may_be_given_instead_of_a_thickness() -> None:
    uniform = {"kind": "beam", "start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    tables = {"flexural_rigidity": [(0.0, 5e3), (1.0, 5e3), (4.0, 5e3)], "mass_per_length": [(0.0, 50.0), (4.0, 50.0)]}
    given = {"kind": "varying_beam", "start": 3.0} | tables
    assert frequencies(scene(given)) == pytest.approx(frequencies(scene(uniform)), rel=2e-8)


def test_steps_of_a_table_are_sections() -> None:
    table = [(0.0, 0.1), (2.0, 0.1), (2.0, 0.2), (4.0, 0.2)]
    given = VaryingBeam.model_validate(plate(thickness=table))
    rigidity = [4e6 * t**3 / (12.0 * (1.0 - 0.3**2)) for t in (0.1, 0.2)]
    assert [part.flexural_rigidity for part in given.sections] == pytest.approx(rigidity, rel=1e-14)
    sections = [part.model_dump() for part in given.sections]
    stepped = {"kind": "beam", "start": 2.0, "sections": sections}
    assert frequencies(scene(plate(thickness=table))) == pytest.approx(frequencies(scene(stepped)), rel=2e-8)


def test_it_is_written_as_it_was_read() -> None:
    given = scene(plate(joints=[{"at": 1.0, "rotational_stiffness": 0.0}]))
    again = TankScene.model_validate(given.model_dump(mode="json"))
    assert again == given
    assert "flexural_rigidity" not in given.model_dump(mode="json")["body"][0]
    assert isinstance(
        scene({"start": 1.0, "length": 2.0, "flexural_rigidity": 1.0, "mass_per_length": 1.0}).body[0], Beam
    )


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"thickness": None}, "thickness with youngs_modulus and density, or flexural_rigidity with mass_per_length"),
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
    with pytest.raises(ValueError, match=said):
        scene(plate(**change))


def test_tables_of_different_lengths_are_refused() -> None:
    tables = {"flexural_rigidity": [(0.0, 5e3), (4.0, 5e3)], "mass_per_length": [(0.0, 50.0), (3.0, 50.0)]}
    with pytest.raises(ValueError, match="it ends at 3 m, and flexural_rigidity at 4 m"):
        scene({"kind": "varying_beam", "start": 3.0} | tables)
