"""How the solver of volumes scales: iterations, seconds by stage and memory, by unknowns, degree and processes.

    ./hydro python -m hydroelastic.benchmarks.volume_scaling 1e4 1e5 1e6
    ./hydro mpirun -n 2 python -m hydroelastic.benchmarks.volume_scaling --degree 4 1e5
    ./hydro python -m hydroelastic.benchmarks.volume_scaling --ngsolve --processor 1e4 1e5

A cube with a free surface is divided on all processes at once, and only its coarse mesh is on one of them. Lines of the
same unknowns by different numbers of processes are strong scaling, of the same unknowns per process weak scaling. The
load is that of the wave cos πx cos πy, of which the energy is known: "error" is that of the energy. From three sizes on
a model of the cost is fitted, a power of the unknowns; its error is that with which it predicts the largest one from
the others.
"""

from __future__ import annotations

import csv
import gc
import json
import subprocess
import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from math import pi, sqrt, tanh
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
import ufl
from dolfinx import fem, la
from dolfinx.mesh import create_box, entities_to_geometry, locate_entities_boundary
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.benchmarks.peers import peer_folder
from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.liquid import LiquidSpace, closed_layer, liquid_space
from hydroelastic.fem.progress import peak_memory
from hydroelastic.fem.shape_loads import surface_load
from hydroelastic.fem.volume.matrices import volume_laplace
from hydroelastic.fem.volume.multigrid import MultigridSolver
from hydroelastic.meshes.compat import geometry_dofmap
from hydroelastic.meshes.distribute import NodedMesh, TankMesh, distribute_nodes
from hydroelastic.meshes.geometry import FREE_SURFACE, LIQUID
from hydroelastic.meshes.refinement import refined_mesh
from hydroelastic.output.provenance import largest_memory

COLUMNS = (
    "processes",
    "degree",
    "unknowns",
    "error",
    "iterations",
    "mesh",
    "assembly",
    "setup",
    "solve",
    "GiB per 1e6",
    "GiB of one",
)
_K = pi * sqrt(2.0)
EXACT_ENERGY = 0.25 / (_K * tanh(_K))
"""∫ζψ over the top of a unit cube with ζ = cos πx cos πy: ψ = ζ cosh k(z + 1)/(k sinh k), k = π√2."""
# Most cells along an edge of the coarse mesh: 83,000 of them, as of tanks.
_COARSE = 24
# Sizes that the model is asked for, and solutions for six modes with their count.
_LARGE, _SOLUTIONS = (1e7, 1e8), 50


def cube(comm: MPI.Comm, cells: int) -> TankMesh:
    """Return a unit cube of some cells along each edge, with its top as still surface (collective).

    As meshes of tanks are, it is coarse on one process, and divided by all.
    """
    refinements = 0
    while cells > _COARSE:
        cells, refinements = (cells + 1) // 2, refinements + 1
    whole = _whole_cube(cells) if comm.rank == 0 else None
    return refined_mesh(distribute_nodes(comm, whole), {}, refinements, curved=False)


def _whole_cube(cells: int) -> NodedMesh:
    mesh = create_box(MPI.COMM_SELF, [np.zeros(3), np.ones(3)], [cells] * 3)
    mesh.topology.create_connectivity(2, 3)
    top = locate_entities_boundary(mesh, 2, lambda x: np.isclose(x[2], 1.0))
    nodes = geometry_dofmap(mesh)
    return NodedMesh(
        cell="tetrahedron",
        degree=1,
        points=mesh.geometry.x,
        cells=nodes.astype(np.int64),
        cell_tags=np.ones(len(nodes), dtype=np.int32),
        facets=entities_to_geometry(mesh, 2, top).astype(np.int64),
        facet_tags=np.ones(len(top), dtype=np.int32),
        cell_names={LIQUID: 1},
        facet_names={FREE_SURFACE: 1},
    )


def cells_of(unknowns: float, degree: int) -> int:
    """Return the number of cells along an edge of a cube with about so many unknowns."""
    return max(2, round((unknowns ** (1.0 / 3.0) - 1.0) / degree))


def measured(
    comm: MPI.Comm, degree: int, unknowns: float, tolerance: float, *, processor: bool = False
) -> dict[str, float]:
    """Solve Laplace's equation once for the load of a wave, and return a line of the table (collective)."""
    clock = process_time if processor else perf_counter
    times = [clock()]
    with peak_memory(comm) as memory:
        tank = cube(comm, cells_of(unknowns, degree))
        times.append(clock())
        liquid = liquid_space(tank, degree)
        laplace = volume_laplace(liquid)
        surface = surface_load(liquid, (FREE_SURFACE,))
        times.append(clock())
        solver = MultigridSolver(liquid, laplace, (closed_layer(liquid, 0, surface),), 1, tolerance=tolerance)
        times.append(clock())
        load, potential = laplace.createVecs()
        load.array[:] = _wave_load(liquid)
        solver.solve(load, potential)
        comm.Barrier()
        times.append(clock())
    assert memory.peak is not None
    whole, error = memory.peak / 2**30 / liquid.size * 1e6, abs(load.dot(potential) / EXACT_ENERGY - 1.0)
    largest = largest_memory() / 2**30
    values = (comm.size, degree, liquid.size, error, solver.iterations, *np.diff(times), whole, largest)
    own, row = tank.mesh.comm, dict(zip(COLUMNS, values, strict=True))
    del solver, load, potential, laplace
    # They would count in the next size.
    gc.collect()
    PETSc.garbage_cleanup(own)
    return row


def _wave_load(liquid: LiquidSpace) -> np.ndarray:
    """∫ζq over the top, owned entries (collective)."""
    test = ufl.TestFunction(liquid.space)
    mesh = liquid.tank.mesh
    x = ufl.SpatialCoordinate(mesh)
    top = ufl.Measure(
        "ds", domain=mesh, subdomain_data=liquid.tank.facet_tags, metadata={"quadrature_degree": 2 * liquid.degree + 4}
    )
    vector = fem.assemble_vector(compiled_form(ufl.cos(pi * x[0]) * ufl.cos(pi * x[1]) * test * top(1)))
    vector.scatter_reverse(la.InsertMode.add)
    owned: np.ndarray = vector.array[: liquid.space.dofmap.index_map.size_local]
    return owned


def by_ngsolve(unknowns: float, tolerance: float) -> dict[str, float]:
    """Return the line of NGSolve for about the same unknowns of degree 2, in a process of its own."""
    folder = peer_folder("ngsolve", install=True, report=print)
    command = [sys.executable, "-m", "hydroelastic.benchmarks.cube_ngsolve", str(folder or "")]
    command += [str(cells_of(unknowns, 2)), str(tolerance)]
    answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()[-1])
    error = abs(answer["energy"] / EXACT_ENERGY - 1.0)
    values = (1, 2, answer["unknowns"], error, answer["iterations"], answer["seconds"][0])
    gibibytes = answer["memory"] / 2**30
    rest = (answer["seconds"][1], 0.0, answer["seconds"][2], gibibytes / answer["unknowns"] * 1e6, gibibytes)
    return dict(zip(COLUMNS, (*values, *rest), strict=True))


def cost_model(rows: list[dict[str, float]]) -> Iterator[str]:
    """Yield what a cost would be at more unknowns: a power of them, fitted to the lines, with its own error."""
    unknowns = np.log([row["unknowns"] for row in rows])
    processes = rows[0]["processes"]
    costs = {
        "GiB": [row["GiB per 1e6"] * row["unknowns"] / 1e6 for row in rows],
        "s of mesh, matrices and set-up": [row["mesh"] + row["assembly"] + row["setup"] for row in rows],
        f"s of {_SOLUTIONS} solutions": [_SOLUTIONS * row["solve"] for row in rows],
    }
    for name, values in costs.items():
        power, factor = np.polyfit(unknowns, np.log(values), 1)
        told = np.exp(np.polyval(np.polyfit(unknowns[:-1], np.log(values[:-1]), 1), unknowns[-1]))
        large = ", ".join(f"{np.exp(factor) * size**power:.3g} for {size:.0e}" for size in _LARGE)
        yield (
            f"{name} on {processes:.0f} process{'es' * (processes > 1)}: {large} unknowns; power {power:.2f}, "
            f"the largest one measured is predicted with an error of {told / values[-1] - 1.0:+.0%}"
        )


def main() -> None:
    """Print the table, and write it as CSV if asked."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument("unknowns", type=float, nargs="+", help="numbers of unknowns, about")
    parser.add_argument("--degree", type=int, default=2, help="of ψ")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="of Laplace's equation, in the energy norm")
    parser.add_argument("--processor", action="store_true", help="seconds of the processor, on a machine in use")
    parser.add_argument("--ngsolve", action="store_true", help="the same by NGSolve in degree 2, on one process")
    parser.add_argument("--csv", type=Path, help="file to which the lines are added")
    asked = parser.parse_args()
    comm = MPI.COMM_WORLD
    # The first problem compiles the kernels.
    measured(comm, asked.degree, 1e3, asked.tolerance)
    rows = [
        measured(comm, asked.degree, unknowns, asked.tolerance, processor=asked.processor)
        for unknowns in asked.unknowns
    ]
    if comm.rank:
        return
    print("  ".join(COLUMNS))
    for row in rows:
        print(_line(row))
    if len(rows) > 2:
        print(*cost_model(rows), sep="\n")
    if asked.ngsolve:
        print("NGSolve, processor seconds:")
        for unknowns in asked.unknowns:
            print(_line(by_ngsolve(unknowns, asked.tolerance)))
    if asked.csv is not None:
        new = not asked.csv.exists()
        with asked.csv.open("a", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            if new:
                writer.writeheader()
            writer.writerows(rows)


def _line(row: dict[str, float]) -> str:
    return "  ".join(f"{row[name]:>{len(name)}.4g}" for name in COLUMNS)


if __name__ == "__main__":
    main()
