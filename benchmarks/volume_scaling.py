"""How the solver of volumes scales: iterations, seconds by stage and memory, by unknowns, degree and processes.

    ./hydro python -m hydroelastic.benchmarks.volume_scaling 1e4 1e5 1e6
    ./hydro mpirun -n 2 python -m hydroelastic.benchmarks.volume_scaling --degree 4 1e5

A cube with a free surface is meshed on all processes at once, so that nothing is on one of them alone. Lines of the
same unknowns by different numbers of processes are strong scaling, of the same unknowns per process weak scaling.
"""

from __future__ import annotations

import csv
from argparse import ArgumentParser
from pathlib import Path
from time import perf_counter

import numpy as np
from dolfinx.mesh import create_box, locate_entities_boundary, meshtags
from mpi4py import MPI

from hydroelastic.fem.liquid import closed_layer, liquid_space
from hydroelastic.fem.memory import peak_memory
from hydroelastic.fem.shape_loads import surface_load
from hydroelastic.fem.volume.matrices import volume_laplace
from hydroelastic.fem.volume.multigrid import MultigridSolver
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import FREE_SURFACE, LIQUID

COLUMNS = ("processes", "degree", "unknowns", "iterations", "mesh", "assembly", "setup", "solve", "GiB per 1e6")


def cube(comm: MPI.Comm, cells: int) -> TankMesh:
    """Return a unit cube of some cells along each edge, with its top as still surface (collective)."""
    mesh = create_box(comm, [np.zeros(3), np.ones(3)], [cells] * 3)
    mesh.topology.create_connectivity(2, 3)
    top = np.sort(locate_entities_boundary(mesh, 2, lambda x: np.isclose(x[2], 1.0)))
    own = np.arange(mesh.topology.index_map(3).size_local, dtype=np.int32)
    return TankMesh(
        mesh=mesh,
        facet_tags=meshtags(mesh, 2, top, np.ones(len(top), dtype=np.int32)),
        facet_names={FREE_SURFACE: 1},
        cell_tags=meshtags(mesh, 3, own, np.ones(len(own), dtype=np.int32)),
        cell_names={LIQUID: 1},
    )


def measured(comm: MPI.Comm, degree: int, unknowns: float, tolerance: float) -> dict[str, float]:
    """Solve Laplace's equation once for the load of a wave, and return a line of the table (collective)."""
    times = [perf_counter()]
    with peak_memory(comm) as memory:
        tank = cube(comm, max(2, round((unknowns ** (1.0 / 3.0) - 1.0) / degree)))
        times.append(perf_counter())
        liquid = liquid_space(tank, degree)
        laplace = volume_laplace(liquid)
        surface = surface_load(liquid, (FREE_SURFACE,))
        times.append(perf_counter())
        solver = MultigridSolver(liquid, laplace, (closed_layer(liquid, 0, surface),), 1, tolerance=tolerance)
        times.append(perf_counter())
        load, potential = laplace.createVecs()
        places = liquid.space.tabulate_dof_coordinates()[: len(surface)]
        load.array[:] = surface * np.cos(7.0 * places[:, 0]) * np.sin(5.0 * places[:, 1])
        solver.solve(load, potential)
        comm.Barrier()
        times.append(perf_counter())
    assert memory.peak is not None
    seconds = np.diff(times)
    values = (comm.size, degree, liquid.size, solver.iterations, *seconds, memory.peak / 2**30 / liquid.size * 1e6)
    return dict(zip(COLUMNS, values, strict=True))


def main() -> None:
    """Print the table, and write it as CSV if asked."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument("unknowns", type=float, nargs="+", help="numbers of unknowns, about")
    parser.add_argument("--degree", type=int, default=2, help="of ψ")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="of Laplace's equation, in the energy norm")
    parser.add_argument("--csv", type=Path, help="file to which the lines are added")
    asked = parser.parse_args()
    comm = MPI.COMM_WORLD
    # The first problem compiles the kernels.
    measured(comm, asked.degree, 1e3, asked.tolerance)
    rows = [measured(comm, asked.degree, unknowns, asked.tolerance) for unknowns in asked.unknowns]
    if comm.rank:
        return
    print("  ".join(COLUMNS))
    for row in rows:
        print("  ".join(f"{row[name]:>{len(name)}.4g}" for name in COLUMNS))
    if asked.csv is not None:
        new = not asked.csv.exists()
        with asked.csv.open("a", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            if new:
                writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
