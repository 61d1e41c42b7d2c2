"""Floats that nothing holds, and floats that turn over: growth is found apart from oscillation, and is counted."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from float_problems import ALL, UNSTABLE, raw_problem
from layered_tanks import PlainProblem, layered, pencils, rigid

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.modes import solve_modes
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.tank.solve import solve_scene

LOOSE = {
    # Sway is free in every tank; heave and pitch of a beam without restoring less one where a volume joins them.
    "sway": (rigid("ellipse", 0.4, "sway", half_width=0.1, half_height=0.05), 1),
    "all motions": (rigid("ellipse", 0.4, ALL, half_width=0.1, half_height=0.05), 1),
    "circle": (rigid("ellipse", 0.4, ALL, half_width=0.05, half_height=0.05), 2),
    "heave": (rigid("ellipse", 0.4, half_width=0.1, half_height=0.05), 0),
}


@pytest.mark.slow_but("2-free-all motions", "1-free-heave", "1-pressure_release-sway")
@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
@pytest.mark.parametrize("kind", LOOSE)
@pytest.mark.parametrize("top", ["rigid", "free", "pressure_release"])
@pytest.mark.parametrize("layers", [1, 2])
def test_motions_without_stiffness_are_counted_and_not_listed(kind: str, top: str, layers: int) -> None:
    floating, expected = LOOSE[kind]
    # With one liquid under a lid nothing but the loose beam gives way.
    loose = Beam(start=0.6, length=0.3, flexural_rigidity=50.0, mass_per_length=4.0, hydrostatic=False)
    free_beam = 2 if top == "pressure_release" and layers == 1 else 1
    for bodies, count in (((floating,), expected), ((floating, loose), expected + free_beam)):
        if len(bodies) == 1 and layers == 1 and top != "free":
            continue
        scene = layered(*bodies, densities=(1000.0, 850.0)[:layers], top=top)
        (pencil,) = pencils(scene)
        modes = solve_modes(pencil, 4, shapes=0)
        assert modes.zero_modes == count
        for number, (lower, upper) in enumerate(pairwise(modes.eigenvalues), 1):
            assert count_below(pencil, float(np.sqrt(lower * upper))) == number


@pytest.mark.slow_but("upright between two liquids", "top-heavy")
@pytest.mark.parametrize("name", UNSTABLE)
def test_unstable_floats_grow_as_the_full_matrices_say(name: str) -> None:
    scene = UNSTABLE[name]
    (pencil,) = pencils(scene)
    modes = solve_modes(pencil, 6, shapes=0)
    growing = np.sort([mode.eigenvalue for mode in modes.growing])
    assert len(growing) == (2 if name == "two of them" else 1)
    problem = PlainProblem(pencil) if name == "two of them" else raw_problem(scene, pencil)
    values = problem.eigenvalues(len(growing) + modes.zero_modes + 6, shift=-2.0 * growing[0])
    assert values[: len(growing)] == pytest.approx(growing, rel=1e-9)
    assert np.abs(values[len(growing) :][: modes.zero_modes]).max(initial=0.0) <= 1e-10 * abs(growing[0])
    assert values[len(growing) + modes.zero_modes :] == pytest.approx(modes.eigenvalues, rel=1e-9)


def test_a_float_that_turns_over_much_faster_than_waves_travel_is_found() -> None:
    """On the top of two liquids that hardly differ: the lowest λ is 10⁻⁴ of −λ, so that 1/λ hides beside it."""
    light = {"densities": (1000.0, 999.0), "depths": (1.0, 1.0), "top": "free"}
    scene = layered(
        rigid("parabola", 0.8, ALL, at="surface", half_width=0.02, half_height=0.06, unstable="solve"), **light
    )
    (pencil,) = pencils(scene)
    modes = solve_modes(pencil, 4, shapes=0)
    (growing,) = modes.growing
    assert -growing.eigenvalue > 3e3 * modes.eigenvalues[0]
    values = PlainProblem(pencil).eigenvalues(1, shift=-2.0 * growing.eigenvalue)
    assert values[0] == pytest.approx(growing.eigenvalue, rel=1e-9)


@pytest.mark.slow_but("top-heavy", "upright between two liquids")
@pytest.mark.slow_on_ranks_but("top-heavy")
@pytest.mark.mpi
@pytest.mark.parametrize("name", UNSTABLE)
def test_growing_motions_are_counted_below_every_mode(name: str) -> None:
    (pencil,) = pencils(UNSTABLE[name])
    modes = solve_modes(pencil, 6, shapes=0)
    growing = len(modes.growing)
    assert growing == len(pencil.unstable)
    assert count_below(pencil, 0.5 * modes.eigenvalues[0]) == growing
    for number, (lower, upper) in enumerate(pairwise(modes.eigenvalues), 1):
        assert count_below(pencil, float(np.sqrt(lower * upper))) == growing + number


@pytest.mark.parametrize("name", ["upright", "top-heavy"])
def test_inertia_of_the_full_matrices_agrees_on_either_side_of_a_growing_motion(name: str) -> None:
    """Of K − σ(M + M_a) on what keeps the volume, at σ < 0: none below the growing motion, one above it."""
    (pencil,) = pencils(UNSTABLE[name])
    (growing,) = solve_modes(pencil, 2, shapes=0).growing
    values = PlainProblem(pencil).eigenvalues(4, shift=-4.0 * growing.eigenvalue)
    assert [int(np.sum(values < factor * growing.eigenvalue)) for factor in (1.01, 0.99, 0.01)] == [0, 1, 1]


@pytest.mark.slow
def test_growth_rates_keep_the_tolerance(tanks: Any) -> None:
    """Against the same float on finer meshes, in halves and in whole."""
    scene = UNSTABLE["upright"]
    found = [tanks.solve(scene), solve_scene(scene, halves=False)]
    finer = tanks.solve(scene.model_copy(update={"accuracy": scene.accuracy.model_copy(update={"tolerance": 1e-10})}))
    (reference,) = finer.modes.growing
    for solution in found:
        (mode,) = solution.modes.growing
        assert solution.reasons == ()
        error = np.sqrt(mode.eigenvalue / reference.eigenvalue) - 1.0
        assert abs(error) <= solution.growing_errors[0] + finer.growing_errors[0]
        assert solution.growing_errors[0] <= 1e-8


def test_an_unstable_float_is_refused_unless_it_is_asked_for() -> None:
    with pytest.raises(SceneError, match="capsizes"):
        layered(
            rigid("rectangle", 0.5, ALL, half_width=0.04, half_height=0.1),
            densities=(1000.0,),
            depths=(0.4,),
            top="free",
        )
