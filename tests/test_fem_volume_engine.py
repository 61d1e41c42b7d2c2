"""Meshes, matrices and solvers of large volumes: multigrid beside a factorization, on one process and on several."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from mpi4py import MPI
from volume_tanks import rectangle_in_a_box

from hydroelastic.fem.liquid import liquid_space
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.plan.classes import mirrored_classes
from hydroelastic.fem.shape_loads import surface_load
from hydroelastic.fem.volume.distribution import distributed_volume
from hydroelastic.fem.volume.model import VolumeModel, volume_mirrors
from hydroelastic.fem.volume.multigrid import MultigridSolver
from hydroelastic.fem.volume.resolution import VolumeResolution
from hydroelastic.fem.volume.solve import direct_or_multigrid
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.tetrahedra import mesh_volume
from hydroelastic.meshes.volume import VolumeSizes, volume_mesh
from hydroelastic.physics.level_tank import Box, Cylinder
from hydroelastic.physics.obstacles import VerticalBaffle
from hydroelastic.physics.plate import Disc, Plate, Rectangle
from hydroelastic.physics.solid_floats import RIGID_MOTIONS, SolidFloat
from hydroelastic.physics.volume_tank import LowerLiquid, SlopingBed, VolumeTank

BOX = VolumeTank(plan=Box(length=10.0, width=6.0), depth=2.0, density=900.0, gravity=9.81)
WITH_ALL = replace(
    BOX,
    lower=LowerLiquid(density=1025.0, depth=1.2),
    baffles=(VerticalBaffle(start=(8.0, 1.0), end=(8.0, 5.0), top=-0.3),),
    columns=(Rectangle(position=(4.0, 3.0), size=(1.0, 1.5)),),
)
BARGE = SolidFloat(
    shape="box",
    size=(2.0, 1.4),
    draught=0.6,
    position=(4.0, 3.5),
    centre_of_gravity=-0.05,
    gyration=(0.4, 0.9, 1.0),
    motions=RIGID_MOTIONS,
)
TANKS = {
    "plate": rectangle_in_a_box(),
    "two liquids around a column and a baffle": WITH_ALL,
    "float on a slope": replace(BOX, bed=SlopingBed(slope=(0.05, 0.02)), floats=(BARGE,)),
}


def model_of(tank: VolumeTank, comm: MPI.Comm, mirrors: Mirrors, degree: int = 2, bulk: float = 0.25) -> VolumeModel:
    sizes = VolumeSizes(edge=0.6 * bulk, bulk=bulk, geometry=1)
    resolution = VolumeResolution(degree=degree, sizes=sizes, polynomials=(4,) * len(tank.plates))
    mesh, _ = distributed_volume(tank, sizes, mirrors, comm)
    return VolumeModel(tank=tank, resolution=resolution, mesh=mesh, mirrors=mirrors)


@pytest.mark.parametrize("name", TANKS)
def test_multigrid_gives_the_modes_of_the_factorization(name: str) -> None:
    """In all symmetries: odd ones have ψ = 0 on planes; the constants of both liquids are the null space."""
    tank = TANKS[name].scaled()
    mirrors = volume_mirrors(tank)
    model = model_of(tank, MPI.COMM_SELF, mirrors, degree=4 if name == "plate" else 2)
    for parity in mirrored_classes(mirrors):
        values = []
        for largest in (10**6, 0):
            pencil = model.pencil(parity, partial(direct_or_multigrid, tolerance=1e-8, largest=largest))
            assert pencil is not None
            values.append(solve_modes(pencil, 3, shapes=0, tolerance=1e-9).eigenvalues)
        assert isinstance(pencil.solver, MultigridSolver)
        # Measured: 13 to 14.
        assert pencil.solver.iterations / pencil.solver.solves < 18.0
        # The residual of eigenpairs, 1e-9, enters squared; that of Laplace's equation, 1e-10, too.
        assert values[0] == pytest.approx(values[1], rel=1e-10)


@pytest.mark.mpi
@pytest.mark.only_on_ranks
@pytest.mark.parametrize("largest", [10**6, 0])
@pytest.mark.parametrize("name", TANKS)
def test_ranks_give_the_frequencies_of_one_process(name: str, largest: int) -> None:
    """Nodes on both sides of interface and baffle are distributed, by the factorization and by multigrid."""
    values = []
    for comm in (MPI.COMM_WORLD, MPI.COMM_SELF):
        pencil = model_of(TANKS[name].scaled(), comm, (None, None)).pencil(
            (None, None), partial(direct_or_multigrid, tolerance=1e-8, largest=largest)
        )
        assert pencil is not None
        values.append(solve_modes(pencil, 3, shapes=0, tolerance=1e-9).eigenvalues)
    assert values[0] == pytest.approx(values[1], rel=1e-9)


def test_iterations_of_multigrid_hardly_grow_with_the_unknowns() -> None:
    counts, tank = [], TANKS["plate"].scaled()
    for bulk in (0.3, 0.12):
        model = model_of(tank, MPI.COMM_SELF, volume_mirrors(tank), bulk=bulk)
        pencil = model.pencil(
            mirrored_classes(model.mirrors)[0], partial(direct_or_multigrid, tolerance=1e-9, largest=0)
        )
        assert pencil is not None
        solve_modes(pencil, 3, shapes=0, tolerance=1e-9)
        assert isinstance(pencil.solver, MultigridSolver)
        counts.append(pencil.solver.iterations / pencil.solver.solves)
    few, many = counts
    # Measured: 9.0 and 9.3, with 46 and 136 unknowns of the surface.
    assert many <= 12
    assert many - few <= 4


DISC = Plate(outline=Disc(radius=0.4), flexural_rigidity=1.0, mass_per_area=0.0)
ROUND = VolumeTank(plan=Cylinder(radius=1.0), depth=0.6, density=1.0, gravity=1.0, plates=(DISC,))
AREAS = {"body_1": 0.04 * np.pi, "free_surface": 0.21 * np.pi, "mirror_x": 0.6, "mirror_y": 0.6}


def test_meshes_have_the_volume_of_the_tank() -> None:
    made = volume_mesh(ROUND, VolumeSizes(edge=0.1, bulk=0.3, geometry=4), (0.0, 0.0))
    assert made.volume == pytest.approx(np.pi * 0.6 / 4.0, rel=1e-8)
    # Measured 1.5e-7: the fourth degree on sixteenths of a circle.
    assert mesh_volume(made.noded) == pytest.approx(made.volume, rel=5e-7)


@pytest.mark.mpi
def test_cells_that_all_processes_divide_keep_to_curved_walls_and_groups() -> None:
    """The edge of a disc lies between two faces in one plane, a wall on a cylinder: nodes are moved to both."""
    sizes = VolumeSizes(edge=0.05, bulk=0.15, geometry=4, refinements=1)
    mesh, geometry = distributed_volume(ROUND, sizes, (0.0, 0.0), MPI.COMM_WORLD)
    # Measured 1e-6, twice the error of the volume: eight quadratic cells around a quarter of a circle.
    assert geometry < 3e-6
    assert mesh.cell_count == 8 * len(volume_mesh(ROUND, sizes, (0.0, 0.0)).noded.cells)
    liquid = liquid_space(mesh, 2)
    for name, area in AREAS.items():
        whole = mesh.mesh.comm.allreduce(float(surface_load(liquid, (name,)).sum()))
        assert whole == pytest.approx(area, rel=1e-6), name


FAILING = """
from mpi4py import MPI
from hydroelastic.fem.volume import solve
from hydroelastic.scenes.__main__ import start

meshed = solve.distributed_volume

def failing(*arguments):
    if MPI.COMM_WORLD.rank == 1:
        raise OSError("the disk is gone")
    return meshed(*arguments)

solve.distributed_volume = failing
start()
"""


@pytest.mark.slow
def test_an_error_of_one_process_ends_all_with_a_message(tmp_path: Path) -> None:
    """The other one waits for the mesh, without end."""
    (tmp_path / "start.py").write_text(FAILING, encoding="utf-8")
    asked = ["run", "sloping_basin", "--no-images", "--set", "accuracy.tolerance=1e-2", "--out", str(tmp_path / "out")]
    command = ["mpirun", "-n", "2", sys.executable, str(tmp_path / "start.py"), *asked]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)
    assert ended.returncode != 0
    assert "the disk is gone" in ended.stderr
    assert "process 1 of 2 has failed, see above; all processes end" in ended.stderr
