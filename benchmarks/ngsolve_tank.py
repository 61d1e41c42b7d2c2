"""The tanks on NGSolve: Netgen's triangles with its hp-refinement at the beam's ends, static condensation, Lanczos.

What was tried, and measured on one thread for ten modes of the tank base_s0 at an error near 1e-8. The first of each
is used:

- Mesh: Netgen's triangles with `RefineHP` at the ends; graded quadrilaterals (1.1 to 1.4 times the seconds).
- Matrix: unknowns inside of elements condensed, neither kept nor recovered, because loads on the top do not see them;
  all unknowns in the factorization (twice the seconds).
- Factorization: NGSolve's own sparse Cholesky; UMFPACK (1.4 to 1.9 times the seconds). The wheel has no PARDISO, and
  the factorization is less than a sixth of the whole.
- Threads: one. With more, the factorization waits for them ten times longer than it computes.
"""

from __future__ import annotations

from typing import Any

import ngsolve
import numpy as np
import scipy.sparse
from netgen.geom2d import SplineGeometry

from hydroelastic.benchmarks.tank_top import (
    MODES,
    RING_RATIO,
    Array,
    Resolution,
    Tank,
    dry_shapes,
    frequencies,
    resolution,
)

ngsolve.SetNumThreads(1)


def tank(given: Tank, degree: int, halves: bool) -> tuple[Array, int]:
    """Return the ten lowest frequencies, from the mesh on, and the number of unknowns."""
    asked = resolution(given, degree, 0.5, 0.25, 3)
    mesh = _mesh(given, asked, halves)
    space = ngsolve.H1(mesh, order=degree)
    trial, test = space.TnT()
    laplace = ngsolve.BilinearForm(space, symmetric=True, condense=True, keep_internal=False)
    laplace += ngsolve.grad(trial) * ngsolve.grad(test) * ngsolve.dx
    laplace.Assemble()
    top, mass, water, loads = _surface(given, mesh, space, asked)
    found = []
    for half in ("even", "odd") if halves else ("",):
        free = ngsolve.BitArray(space.FreeDofs(True))
        kept: Array = np.arange(len(top))
        if half == "odd":
            middle = space.GetDofs(mesh.Boundaries("middle"))
            free &= ~middle
            kept = np.array([place for place, dof in enumerate(top.tolist()) if not middle[dof]])
        else:
            free.Clear(0)
        found.append(
            frequencies(
                *(given, half, mass[kept][:, kept], np.flatnonzero(np.isin(kept, water)), loads[kept]),
                (top[kept] < mesh.nv).astype(float),  # the first unknowns are those of the vertices
                _answer(laplace.mat, free, top[kept]),
            )
        )
    return np.sort(np.concatenate(found))[:MODES], space.ndof + len(water) + asked.shapes


def sweep(given: Tank, degree: int, halves: bool) -> tuple[Array, int]:
    """Solve a tank for many values of a key, one after the other; return the frequencies of those compared."""
    tanks = [given | {given["key"]: value} for value in given["values"]]
    found = [tank(one, degree, halves and given["key"] != "start") for one in tanks]
    return np.concatenate([values for values, _ in found[:: given["compared"]]]), max(size for _, size in found)


def _answer(matrix: Any, free: Any, dofs: Array) -> Any:
    inverse = matrix.Inverse(free, inverse="sparsecholesky")
    load, potential = matrix.CreateRowVector(), matrix.CreateColVector()
    loads, potentials = load.FV().NumPy(), potential.FV().NumPy()
    loads[:] = 0.0

    def answer(values: Array) -> Array:
        loads[dofs] = values
        inverse.Mult(load, potential)
        return potentials[dofs]

    return answer


def _mesh(given: Tank, asked: Resolution, halves: bool) -> Any:
    geometry = SplineGeometry()
    names = ["water", "beam"] if halves else ["water", "beam", "water"]
    places = [0.0, given["start"], given["start"] + given["beam_length"], given["length"]]
    if halves:
        places[2:] = [0.5 * given["length"]]
    bottom = [geometry.AppendPoint(x, -given["depth"]) for x in (places[0], places[-1])]
    top = [
        geometry.AppendPoint(x, 0.0, **({"hpref": 1} if places[0] < x < places[-1] else {})) for x in reversed(places)
    ]
    geometry.Append(["line", bottom[0], bottom[1]], bc="wall")
    geometry.Append(["line", bottom[1], top[0]], bc="middle" if halves else "wall")
    for name, right, left in zip(reversed(names), top, top[1:], strict=False):
        size = asked.beam_size if name == "beam" else asked.water_size
        geometry.Append(["line", right, left], bc=name, maxh=size)
    geometry.Append(["line", top[-1], bottom[0]], bc="wall")
    mesh = ngsolve.Mesh(geometry.GenerateMesh(maxh=max(2.0 * asked.beam_size, 0.5 * given["depth"]), grading=0.6))
    mesh.RefineHP(asked.rings, RING_RATIO)
    return mesh


def _surface(given: Tank, mesh: Any, space: Any, asked: Resolution) -> tuple[Array, Array, Array, Array]:
    """Unknowns of the top; and on them ∫φφ over the water, those of the water, ∫φW over the beam."""
    trial, test = space.TnT()
    form = ngsolve.BilinearForm(space, check_unused=False)
    form += trial * test * ngsolve.ds("water")
    form.Assemble()
    rows, columns, values = (np.asarray(part) for part in form.mat.COO())
    rows, columns, values = (part[values != 0.0] for part in (rows, columns, values))
    dofs, local = _shape_loads(given, mesh, space, asked)
    water = np.unique(rows)
    top = np.union1d(water, dofs)
    place = np.full(space.ndof, -1)
    place[top] = np.arange(len(top))
    loads = np.zeros((len(top), asked.shapes))
    np.add.at(loads, place[dofs], local)
    mass = scipy.sparse.csr_matrix((values, (place[rows], place[columns])), shape=(len(top), len(top)))
    return top, mass, place[water], loads


def _shape_loads(given: Tank, mesh: Any, space: Any, asked: Resolution) -> tuple[Array, Array]:
    """Unknowns of each edge under the beam, shape (edges, n), and ∫φW there, shape (edges, n, shapes)."""
    places, factors = np.polynomial.legendre.leggauss(asked.degree + 6)
    points, weights = 0.5 * (places + 1.0), 0.5 * factors
    basis, dofs, ends = [], [], []
    for element in space.Elements(ngsolve.BND):
        if element.mat == "beam":
            finite_element = space.GetFE(element)
            basis.append([finite_element.CalcShape(float(x)) for x in points])
            dofs.append(list(element.dofs))
            ends.append([mesh[vertex].point[0] for vertex in element.vertices])
    # The reference edge runs from its second vertex to its first.
    second, first = np.array(ends)[:, 1:], np.array(ends)[:, :1]
    s = np.clip((second + (first - second) * points - given["start"]) / given["beam_length"], 0.0, 1.0)
    weighted = np.array(basis) * (np.abs(second - first) * weights)[:, :, None]
    return np.array(dofs), np.matmul(weighted.transpose(0, 2, 1), dry_shapes(asked.shapes, s).transpose(1, 2, 0))
