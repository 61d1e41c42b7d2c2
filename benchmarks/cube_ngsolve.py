"""Laplace's equation in a cube by NGSolve, as a user writes it: the peer of `benchmarks.volume_scaling`.

    python -m hydroelastic.benchmarks.cube_ngsolve FOLDER CELLS TOLERANCE

prints a line of JSON. FOLDER is where NGSolve is, or "".
"""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from math import pi
from resource import RUSAGE_SELF, getrusage
from time import process_time


def main(arguments: list[str]) -> None:
    """Solve once in degree 2 on one thread: conjugate gradients with BDDC, algebraic multigrid on its coarse level."""
    folder, cells, tolerance = arguments[0], int(arguments[1]), float(arguments[2])
    if folder:
        sys.path.append(folder)
    import ngsolve
    from ngsolve.krylovspace import CGSolver
    from ngsolve.meshes import MakeStructured3DMesh

    ngsolve.SetNumThreads(1)
    times = [process_time()]
    mesh = MakeStructured3DMesh(hexes=False, nx=cells, ny=cells, nz=cells)
    times.append(process_time())
    space = ngsolve.H1(mesh, order=2)
    trial, test = space.TnT()
    matrix = ngsolve.BilinearForm(space, symmetric=True)
    matrix += ngsolve.grad(trial) * ngsolve.grad(test) * ngsolve.dx
    preconditioner = ngsolve.Preconditioner(matrix, "bddc", coarsetype="h1amg")
    wave = ngsolve.cos(pi * ngsolve.x) * ngsolve.cos(pi * ngsolve.y)
    load = ngsolve.LinearForm(wave * test * ngsolve.ds("top")).Assemble()
    matrix.Assemble()
    times.append(process_time())
    potential = ngsolve.GridFunction(space)
    solver = CGSolver(matrix.mat, preconditioner.mat, tol=tolerance, maxiter=400)
    potential.vec.data = solver * load.vec
    times.append(process_time())
    answer = {
        "unknowns": space.ndof,
        "iterations": solver.iterations,
        "seconds": [later - earlier for earlier, later in pairwise(times)],
        "energy": ngsolve.InnerProduct(load.vec, potential.vec),
        "memory": getrusage(RUSAGE_SELF).ru_maxrss * 1024,
        "version": ngsolve.__version__,
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main(sys.argv[1:])
