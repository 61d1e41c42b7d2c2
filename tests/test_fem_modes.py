"""Properties that the natural modes of every tank have."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations_with_replacement, pairwise
from math import pi
from typing import Any

import numpy as np
import pytest
from petsc4py import PETSc

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.tank.solve import TankSolution


def scenes_of_each_kind(tanks: Any) -> dict[str, Any]:
    beam = tanks.beam
    return {
        "one": tanks.scene(beam()),
        "one, hydrostatic": tanks.scene(beam(hydrostatic=True)),
        "two": tanks.scene(beam(start=1.0, length=3.0), beam(start=6.0, length=3.0)),
        "lid": tanks.scene(beam(), top="rigid", modes=4),
        "pressure release": tanks.scene(beam(hydrostatic=True), top="pressure_release", modes=4),
        "water alone": tanks.scene(),
    }


def parts_of(tanks: Any, kind: str) -> list[tuple[CoupledPencil, list[Mode]]]:
    """The eigenproblem of the whole tank, and those of its halves where it is its own mirror image."""
    scene = scenes_of_each_kind(tanks)[kind]
    parts = [part for halves in (False, True) for part in tanks.solve(scene, halves=halves).field.parts]
    # The last modes of a part are there to see how many lie below.
    return [
        (part.pencil, [part.modes.completed(index) for index in range(len(part.modes.eigenvalues) - 1)])
        for part in parts
    ]


KINDS = pytest.mark.parametrize("kind", ["one", "one, hydrostatic", "two", "lid", "pressure release", "water alone"])


@pytest.mark.slow_but("one", "lid", "water alone")
@pytest.mark.slow_on_ranks_but("water alone")
@pytest.mark.mpi
@KINDS
def test_between_two_modes_the_inertia_counts_those_below(tanks: Any, kind: str) -> None:
    for pencil, modes in parts_of(tanks, kind):
        values = [mode.eigenvalue for mode in modes]
        assert count_below(pencil, 0.5 * values[0]) == 0
        for number, (lower, upper) in enumerate(pairwise(values[:6]), 1):
            assert count_below(pencil, float(np.sqrt(lower * upper))) == number


@pytest.mark.mpi
@pytest.mark.parametrize("kind", ["one", "pressure release"])
def test_counting_leaves_the_matrices_as_they_were(tanks: Any, kind: str) -> None:
    pencil = tanks.pencil(scenes_of_each_kind(tanks)[kind], degree=3, tip_size=None)
    matrices = (pencil.stiffness, pencil.mass, pencil.coupling, pencil.laplace)
    before = [matrix.norm() for matrix in matrices]
    count_below(pencil, 3.0)
    assert [matrix.norm() for matrix in matrices] == before


@pytest.mark.slow_on_ranks_but("one")
@pytest.mark.mpi
@KINDS
def test_modes_are_orthogonal_with_unit_generalized_mass(tanks: Any, kind: str) -> None:
    """φᵢᵀKφⱼ = λᵢδᵢⱼ and φᵢᵀ(Mφⱼ + ρCᵀψⱼ) = δᵢⱼ, ψⱼ with its constant."""
    for pencil, modes in parts_of(tanks, kind):
        force, momentum = pencil.stiffness.createVecs()
        for (i, one), (j, other) in combinations_with_replacement(enumerate(modes), 2):
            pencil.stiffness.mult(other.displacement, force)
            pencil.momentum.multTranspose(other.potential, momentum)

            pencil.mass.multAdd(other.displacement, momentum, momentum)
            size = np.sqrt(one.eigenvalue * other.eigenvalue)
            # The eigen-solver stops at residuals of 1e-12; neighbours a hundredth apart mix by 1e-10.
            assert one.displacement.dot(force) / size == pytest.approx(float(i == j), abs=1e-9)
            assert one.displacement.dot(momentum) == pytest.approx(float(i == j), abs=1e-9)


@pytest.mark.slow_on_ranks_but("one")
@pytest.mark.mpi
@KINDS
def test_residuals_are_small(tanks: Any, kind: str) -> None:
    # Asked 1e-12 of the eigen-solver for μ = 1/λ; in the norm of K⁻¹ the stiffest shapes weigh. Measured 5e-10 (lid).
    assert max(mode.residual for _, modes in parts_of(tanks, kind) for mode in modes) <= 5e-9


@pytest.mark.slow_on_ranks_but("one", "lid")
@pytest.mark.mpi
@pytest.mark.parametrize("kind", ["one", "one, hydrostatic", "two", "lid", "water alone"])
def test_a_closed_liquid_keeps_its_volume(tanks: Any, kind: str) -> None:
    for pencil, modes in parts_of(tanks, kind):
        if not pencil.constraints:
            continue  # antisymmetric: what one half takes the other gives
        for mode in modes:
            moved = pencil.constraints[0].volume.dot(mode.displacement)
            # Against ∫|ζ| of about |ζ|·1; amplitudes are of order one to ten, round-off of the projection 1e-13.
            assert abs(moved) <= 1e-11 * mode.displacement.norm(PETSc.NormType.NORM_INFINITY)


@pytest.mark.slow_on_ranks_but("one")
@pytest.mark.mpi
@pytest.mark.parametrize("kind", ["one", "one, hydrostatic", "two", "water alone"])
def test_the_water_rises_by_the_potential_with_its_constant(tanks: Any, kind: str) -> None:
    """η = λψ/g on the free surface, g = 1 in units of the tank."""
    for pencil, modes in parts_of(tanks, kind):
        bodies = pencil.body_size if pencil.stiffness.comm.rank == 0 else 0
        dofs = pencil.liquid.surface_dofs(("free_surface",))
        for mode in modes:
            difference = mode.values[bodies:] - mode.eigenvalue * mode.potential.array_r[dofs]
            largest = mode.displacement.norm(PETSc.NormType.NORM_INFINITY)
            # Pointwise the residual of 1e-12 is divided by the square root of the innermost ring, 1e-4.
            assert np.abs(difference).max(initial=0.0) <= 1e-6 * largest


@pytest.mark.mpi
def test_motions_without_stiffness_are_counted_and_not_listed(tanks: Any) -> None:
    beam = tanks.beam
    three = [(0.5, 2.0), (3.5, 2.0), (7.0, 2.0)]
    free = [beam(start=start, length=length) for start, length in three]
    held = [beam(start=start, length=length, hydrostatic=True) for start, length in three]
    cover = {"start": 0.0, "length": 10.0, "ends": "guided"}
    expected = {
        # Heave and pitch of each beam, less one because the liquid's volume joins the heaves.
        tanks.scene(free[0], modes=1): 1,
        tanks.scene(*free[:2], modes=1): 3,
        tanks.scene(*free, modes=1): 5,
        tanks.scene(free[0], held[1], modes=1): 1,
        tanks.scene(*held[:2], modes=1): 0,
        tanks.scene(modes=1): 0,
        tanks.scene(beam(**cover), modes=1): 0,
        tanks.scene(beam(**cover, hydrostatic=True), modes=1): 0,
        tanks.scene(free[0], top="rigid", modes=1): 1,
        tanks.scene(free[0], top="pressure_release", modes=1): 2,
    }
    for scene, count in expected.items():
        pencil = tanks.pencil(scene, degree=3, shapes=4, tip_size=None)
        modes = solve_modes(pencil, 2)
        assert modes.zero_modes == count, scene
        assert modes.eigenvalues.min() > 1e-6, scene


def test_fewer_modes_come_back_where_the_model_has_fewer(tanks: Any) -> None:
    pencil = tanks.pencil(tanks.scene(tanks.beam(), top="pressure_release"), degree=3, shapes=6, tip_size=None)
    # Six shapes, two of them rigid without stiffness.
    assert len(solve_modes(pencil, 20).modes) == 4


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("flexural_rigidity", 5e3, 6e3),
        ("gravity", 9.0, 9.81),
        ("depth", 1.0, 1.2),
        ("mass_per_length", 60.0, 50.0),
        ("hydrostatic", False, True),
    ],
)
def test_frequencies_grow_with_stiffness_gravity_and_depth_and_fall_with_mass(
    tanks: Any, name: str, low: Any, high: Any
) -> None:
    def frequencies(value: Any) -> tuple[np.ndarray, np.ndarray]:
        off_centre = {"start": 1.0, "hydrostatic": True}
        if name in ("gravity", "depth"):
            scene = tanks.scene(tanks.beam(**off_centre), **{name: value})
        else:
            scene = tanks.scene(tanks.beam(**(off_centre | {name: value})))
        return tanks.omega(scene), tanks.solve(scene).relative_errors[:8]

    (lower, lower_error), (upper, upper_error) = frequencies(low), frequencies(high)
    # The rigid motions of a beam without restoring force have ω = 0 and are not listed: the pitch counts as one mode.
    if name == "hydrostatic":
        lower, lower_error = np.append(0.0, lower[:-1]), np.append(0.0, lower_error[:-1])
    # Min–max holds for each index; numbers are compared to their estimated errors. The least growth is 2e-5, of the
    # lowest mode with a stiffer beam.
    assert np.all(upper - lower > -(lower_error + upper_error) * upper)
    assert np.all(upper[:3] > lower[:3] * (1.0 + 1e-5))


def agree_to_estimates(one: TankSolution, other: TankSolution) -> bool:
    ratio = np.array([mode.eigenvalue for mode in one.asked]) / np.array([mode.eigenvalue for mode in other.asked])
    count = len(one.asked)
    allowed = one.relative_errors[:count] + other.relative_errors[:count]
    return bool(np.all(np.abs(np.sqrt(ratio) - 1.0) <= allowed))


def test_a_mirrored_tank_has_the_same_frequencies(tanks: Any) -> None:
    left = tanks.solve(tanks.scene(tanks.beam(start=1.0)))
    right = tanks.solve(tanks.scene(tanks.beam(start=5.0)))
    assert agree_to_estimates(left, right)


@pytest.mark.slow
def test_the_order_of_bodies_in_the_scene_makes_no_difference(tanks: Any) -> None:
    one = tanks.beam(start=1.0, length=3.0, flexural_rigidity=5e2)
    other = tanks.beam(start=6.0, length=2.0, flexural_rigidity=1e2, hydrostatic=True)
    first, second = tanks.solve(tanks.scene(one, other)), tanks.solve(tanks.scene(other, one))
    assert [mode.eigenvalue for mode in first.asked] == pytest.approx(
        [mode.eigenvalue for mode in second.asked], rel=1e-11
    )


@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_metres_millimetres_and_kilometres_give_the_same_digits(tanks: Any, size: float) -> None:
    """ω²L/g is a function of EI/ρgL⁴, m/ρL and ratios of lengths: with sizes × s, ω goes like s^{-1/2}."""
    beam = {
        "start": 3.0 * size,
        "length": 4.0 * size,
        "flexural_rigidity": 5e3 * size**4,
        "mass_per_length": 50.0 * size,
    }
    scene = tanks.scene(tanks.beam(**beam), length=10.0 * size, depth=5.0 * size)
    # The same numbers to rounding of the input, on meshes that rounding may change in their last digits.
    assert tanks.omega(scene) * np.sqrt(size) == pytest.approx(tanks.omega(tanks.scene(tanks.beam())), rel=1e-10)


def test_another_density_and_gravity_give_the_same_digits(tanks: Any) -> None:
    scene = tanks.scene(
        tanks.beam(flexural_rigidity=5e3 * 0.8 * 0.1652, mass_per_length=40.0), density=800.0, gravity=9.81 * 0.1652
    )
    found = tanks.omega(scene) / np.sqrt(0.1652)
    assert found == pytest.approx(tanks.omega(tanks.scene(tanks.beam())), rel=1e-10)


@pytest.mark.mpi
def test_nearly_double_modes_of_twin_beams_are_all_found(tanks: Any) -> None:
    """Two short beams far apart under ψ = 0 feel each other by e^{−πd/H}: tones in close pairs, one of each parity."""
    twins = [tanks.beam(start=start, length=1.0, hydrostatic=True) for start in (1.0, 8.0)]
    scene = tanks.scene(*twins, top="pressure_release", depth=1.0, modes=10)
    # By halves the two of a pair would not meet.
    solution = tanks.solve(scene, halves=False)
    assert solution.counted
    assert solution.reasons == ()
    values = solution.modes.eigenvalues[:10]
    for lower, upper in values.reshape(5, 2):
        assert upper / lower - 1.0 < 1e-4
        # The next pair is another kind of motion, far away.
        assert np.sum(np.abs(values / lower - 1.0) < 0.01) == 2
    shapes = solution.field.bodies[0].size
    for one, other in zip(solution.asked[0::2], solution.asked[1::2], strict=True):
        both = np.array([one.body_amplitudes, other.body_amplitudes])
        # Whatever the parts are, two independent modes give each twin the same energy.
        energy = (both**2).reshape(2, 2, shapes).sum(axis=(0, 2))
        assert energy[0] == pytest.approx(energy[1], rel=1e-3)


@pytest.mark.slow_on_ranks_but("one", "pressure release")
@pytest.mark.mpi
@KINDS
def test_halves_give_the_modes_of_the_whole_tank(tanks: Any, kind: str) -> None:
    scene = scenes_of_each_kind(tanks)[kind]
    halves, whole = tanks.solve(scene), tanks.solve(scene, halves=False)
    assert halves.field.half
    assert not whole.field.half
    assert halves.modes.zero_modes == whole.modes.zero_modes
    count = len(halves.asked)
    # Two meshes, so no nearer than their errors: from above, 1e-6 and 1e-6 at most.
    assert tanks.omega(scene) == pytest.approx([whole.omega(mode.eigenvalue) for mode in whole.asked], rel=1e-6)
    for index, (one, other) in enumerate(zip(halves.asked, whole.asked, strict=True)):
        # Shapes err like the root of frequencies; the sign of a mode is free.
        sign = np.sign(one.body_amplitudes @ other.body_amplitudes)
        difference = np.abs(sign * one.body_amplitudes - other.body_amplitudes)
        assert difference.max(initial=0.0) <= 1e-2 * np.abs(other.body_amplitudes).max(initial=1.0), index
        assert one.energy == pytest.approx(other.energy, abs=1e-2)
    assert len({halves.field.parity(index) for index in range(count)}) == 2


def test_what_rounding_hides_in_one_half_is_not_listed_from_the_other(tanks: Any) -> None:
    """Under a lid pitch is soft and antisymmetric, and bending of an all but rigid beam hidden beside it."""
    beam = tanks.beam(start=4.0, length=2.0, flexural_rigidity=9.81e3 * 16 * 1e13, hydrostatic=True)
    scene = tanks.scene(beam, top="rigid", depth=2.0, modes=3)
    for halves in (True, False):
        solution = tanks.solve(scene, halves=halves)
        assert solution.counted
        assert len(solution.asked) == 1
        assert "1 of 3 modes" in solution.reasons[0]


def test_shapes_and_degree_refine_from_above(tanks: Any) -> None:
    """A richer space of beam shapes and of potentials on one mesh never raises a mode (min–max)."""
    tank, tagged = tanks.graded_mesh(tanks.scene(tanks.beam()))
    mesh = tanks.distribute(tagged)

    def values(degree: int, shapes: int) -> np.ndarray:
        return solve_modes(tanks.pencil_on(mesh, tank, degree=degree, shapes=shapes), 8).eigenvalues

    ladder = [values(4, 6), values(4, 12), values(5, 12), values(6, 12), values(6, 24), values(8, 24)]
    for coarse, fine in pairwise(ladder):
        # Rounding of λ, 1e-12 and below at these degrees.
        assert np.all(fine <= coarse * (1.0 + 1e-12))


def test_a_wave_of_the_nth_mode_has_n_half_waves(tanks: Any) -> None:
    """The potential of the water alone is cos kx: its values at the wall and at L/n tell the mode's number."""
    pencil: CoupledPencil = tanks.pencil(tanks.scene(), degree=8, size=0.125)
    dofs = pencil.liquid.surface_dofs(("free_surface",))
    x = pencil.liquid.unknown_positions()[dofs, 0]
    for number, mode in enumerate(solve_modes(pencil, 4).modes, 1):
        elevation = mode.values[pencil.body_size :]
        wave = np.cos(number * pi * x)
        # Interpolation of degree 8: 1e-8 and below; the mode's amplitude errs like the root of λ's error.
        assert abs(np.corrcoef(elevation, wave)[0, 1]) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("kind", ["one", "one, hydrostatic", "lid"])
def test_dense_and_sparse_problems_have_the_same_modes_and_counts(tanks: Any, kind: str) -> None:
    pencil = tanks.solve(scenes_of_each_kind(tanks)[kind], halves=False).field.parts[0].pencil
    assert pencil.answer is not None
    dense, sparse = solve_modes(pencil, 4), solve_modes(replace(pencil, answer=None), 4)
    # Rounding of the lowest mode reaches all others; of ψ, its condition is added.
    assert dense.eigenvalues == pytest.approx(sparse.eigenvalues, rel=1e-11)
    for one, other in zip(dense.modes, sparse.modes, strict=True):
        sign = np.sign(one.body_amplitudes @ other.body_amplitudes)
        for name in ("displacement", "potential"):
            first, second = getattr(one, name).array_r, sign * getattr(other, name).array_r
            assert np.linalg.norm(first - second) < 1e-8 * np.linalg.norm(second), name
        assert one.energy == pytest.approx(other.energy, abs=1e-9)
        assert one.residual < 1e-10
    between = float(np.sqrt(dense.eigenvalues[1] * dense.eigenvalues[2]))
    assert count_below(pencil, between) == count_below(replace(pencil, answer=None), between) == 2
