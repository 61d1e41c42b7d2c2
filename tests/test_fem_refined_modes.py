"""Modes refined from approximate ones: their number of solutions of Laplace's equation, shapes and bounds."""

from __future__ import annotations

from functools import cache, partial

import numpy as np
import pytest
from volume_tanks import rectangle_in_a_box

from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import ClassModes, solve_classes
from hydroelastic.fem.refined_modes import refined_modes, residual_bounds
from hydroelastic.fem.volume.distribution import distributed_volume
from hydroelastic.fem.volume.eigenmodes import volume_modes
from hydroelastic.fem.volume.model import VolumeModel, volume_mirrors
from hydroelastic.fem.volume.resolution import VolumeResolution
from hydroelastic.fem.volume.solve import direct_or_multigrid
from hydroelastic.meshes.volume import VolumeSizes
from hydroelastic.physics.level_tank import Box, Cylinder
from hydroelastic.physics.volume_tank import SlopingBed, SurveyedBed, VolumeTank

SOLVER = partial(direct_or_multigrid, tolerance=1e-6)
LEVEL = SurveyedBed(points=tuple((x, y, 0.0) for x in (-2.0, 2.0) for y in (-2.0, 2.0)))
TANKS = {
    "sloping": VolumeTank(
        plan=Box(length=3.0, width=2.0), depth=1.0, density=1.0, gravity=1.0, bed=SlopingBed(slope=(0.2, 0.1))
    ),
    # Without planes of symmetry: frequencies are double.
    "round": VolumeTank(plan=Cylinder(radius=1.0), depth=0.5, density=1.0, gravity=1.0, bed=LEVEL),
    "plate": rectangle_in_a_box(),
}


@cache
def model_of(name: str, degree: int = 2) -> VolumeModel:
    from mpi4py import MPI

    tank = TANKS[name].scaled()
    mirrors = volume_mirrors(tank)
    sizes = VolumeSizes(edge=0.15, bulk=0.15, geometry=2 if name == "round" else 1)
    mesh, _ = distributed_volume(tank, sizes, mirrors, MPI.COMM_WORLD)
    resolution = VolumeResolution(degree=degree, sizes=sizes, polynomials=(4,) * len(tank.plates))
    return VolumeModel(tank=tank, resolution=resolution, mesh=mesh, mirrors=mirrors)


def found(model: VolumeModel, count: int, tolerance: float) -> tuple[ClassModes, ClassModes, int]:
    """The lowest modes from those of the coarser space, and from one start in each class, and the solutions of the
    first."""
    pencils = model.pencils(SOLVER)
    modes = volume_modes(model, pencils, count, tolerance, solver_of=SOLVER)
    for number in range(count):
        assert modes.completed(number).residual < 0.02
    made = sum(one.pencil.solver.solves for one in modes.classes)
    return modes, solve_classes(pencils, count, 1e-8), made


@pytest.mark.parametrize(("name", "degree"), [("sloping", 2), ("round", 2), ("plate", 4)])
def test_six_modes_with_shapes_take_five_solutions_of_each(name: str, degree: int) -> None:
    modes, exact, made = found(model_of(name, degree), 7, 1e-3)
    # Measured 26, 17 and 21, and those in the coarser space are worth 5, 5 and 12 more; of one start 45, 45 and 86.
    assert made <= 5 * 6
    errors = (modes.eigenvalues / exact.eigenvalues - 1.0)[:6]
    # A residual of a tenth of the tolerance's root, squared, over the gap to the modes beyond: measured 9e-6.
    assert errors.min() >= -1e-9
    assert errors.max() <= 0.1 * 1e-3
    assert np.all(errors <= modes.bounds[:6] + 1e-9)
    assert modes.bounds[:6].max() <= 0.5 * 1e-3


def in_norm_of_energy(pencil: CoupledPencil, one: Mode, other: Mode) -> float:
    """1 − |cos| between two shapes in K."""
    force = pencil.stiffness.createVecLeft()
    pencil.stiffness.mult(one.displacement, force)
    sizes = one.eigenvalue * other.eigenvalue
    return 1.0 - abs(float(force.dot(other.displacement))) / float(np.sqrt(sizes))


def test_potentials_are_combinations_of_those_of_products() -> None:
    model = model_of("plate")
    pencil = model.pencil((0, 0), SOLVER)
    assert pencil is not None
    exact = solve_modes(pencil, 3, tolerance=1e-10)
    before = pencil.solver.solves
    told: list[str] = []
    modes = refined_modes(pencil, list(exact.eigenvectors), 1e-6, report=told.append)
    # One each, and one of the motion without stiffness.
    made = 3 + len(pencil.free_rigid)
    assert pencil.solver.solves - before == made
    assert told[-1].startswith("3 of 3 modes")
    assert told[-1].endswith(f"{made} solutions")
    for number, expected in enumerate(exact.modes):
        own = modes.completed(number)
        assert pencil.solver.solves - before == made
        assert in_norm_of_energy(pencil, own, expected) < 1e-12
        difference = own.potential.copy()
        sign = np.sign(own.potential.dot(expected.potential))
        difference.axpy(-sign, expected.potential)
        # The residual of exact modes, 1e-10, enters at first order.
        assert difference.norm() < 1e-7 * expected.potential.norm()


@pytest.mark.mpi
def test_modes_of_the_coarser_space_lead_to_all_on_any_number_of_processes() -> None:
    modes, exact, _ = found(model_of("sloping"), 4, 1e-4)
    # A residual of 1e-3, squared, over gaps of a tenth.
    assert modes.eigenvalues == pytest.approx(exact.eigenvalues, rel=1e-4)


def test_bounds_of_close_values_are_those_of_both_together() -> None:
    """Of a matrix with known eigenvalues: two close Ritz values are bounded by the gap to the others."""
    generator = np.random.default_rng(1)
    exact = np.diag([1.0, 0.9999, 0.7, 0.3, 0.2, 0.1])
    basis = np.linalg.qr(np.eye(6)[:, :4] + 1e-3 * generator.standard_normal((6, 4)))[0]
    values, columns = np.linalg.eigh(basis.T @ exact @ basis)
    order = np.argsort(-values)
    values, vectors = values[order], (basis @ columns)[:, order]
    residuals = np.linalg.norm(exact @ vectors - vectors * values, axis=0)
    bounds = residual_bounds(values, residuals)[:3]
    errors = 1.0 - values[:3] / np.diag(exact)[:3]
    assert np.all((errors >= 0.0) & (errors <= bounds))
    # The square of the residuals, and not over the gap of 1e-4.
    assert bounds.max() < 1e-4
