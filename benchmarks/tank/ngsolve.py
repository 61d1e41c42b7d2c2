"""The tanks on NGSolve: Netgen's triangles with its hp-refinement at the beam's ends, static condensation, Lanczos.

What was tried, and measured on one thread for ten modes of the tank base_s0 at an error near 1e-8. The first of each
is used:

- Mesh: Netgen's triangles with `RefineHP` at the ends; quadrilaterals of `graded_quads` (1.1 to 1.4 times the seconds).
- Matrix: unknowns inside of elements condensed, neither kept nor recovered, because loads on the top do not see them;
  all unknowns in the factorization (twice the seconds).
- Factorization: NGSolve's own sparse Cholesky; UMFPACK (1.4 to 1.9 times the seconds). The wheel has no PARDISO, and
  the factorization is less than a sixth of the whole.
- Eigen-solver: Lanczos on the top in NumPy (`surface_modes`); SciPy's ARPACK on the same functions (the same seconds).
- Threads: one. With more, the factorization waits for them ten times longer than it computes.
"""

from __future__ import annotations

import ngsolve
import numpy as np
import scipy.sparse
from netgen.geom2d import SplineGeometry

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.cases import BenchmarkTank, tank_named
from hydroelastic.benchmarks.tank.dry_shapes import dry_shapes
from hydroelastic.benchmarks.tank.peer_resolution import RING_RATIO, PeerResolution, PeerRule, peer_resolution
from hydroelastic.benchmarks.tank.peer_surface import Surface, class_frequencies
from hydroelastic.benchmarks.tank.symmetry import ModeClass, lowest_of, mode_classes
from hydroelastic.physics.arrays import FloatArray

_RULE = PeerRule(waves_on_water=0.5, waves_under_beam=0.25, degrees_per_ring=3)
_SPARE_POINTS = 6

ngsolve.SetNumThreads(1)


def versions() -> dict[str, str]:
    """What computes."""
    return {"NGSolve": ngsolve.__version__}


def solve(case: Case) -> Answer:
    """The ten lowest frequencies of a tank, from the mesh on."""
    return solve_tank(tank_named(case.tank), case.degree, halves=case.variant == "halves")


def solve_tank(tank: BenchmarkTank, degree: int, *, halves: bool) -> Answer:
    """As `solve`, of a tank at a degree."""
    resolution = peer_resolution(tank, degree, _RULE)
    mesh = _mesh(tank, resolution, halves=halves)
    space = ngsolve.H1(mesh, order=degree)
    trial, test = space.TnT()
    laplace = ngsolve.BilinearForm(space, symmetric=True, condense=True, keep_internal=False)
    laplace += ngsolve.grad(trial) * ngsolve.grad(test) * ngsolve.dx
    laplace.Assemble()
    top, surface = _surface(tank, mesh, space, resolution, halves=halves)
    found = [
        _class_frequencies(tank, mesh, space, laplace.mat, top, surface, modes)
        for modes in mode_classes(resolution.shapes, halves=halves)
    ]
    return Answer(values=lowest_of(tuple(found)), unknowns=space.ndof + len(surface.water) + resolution.shapes)


def _mesh(tank: BenchmarkTank, resolution: PeerResolution, *, halves: bool) -> ngsolve.Mesh:
    beam = tank.beam
    geometry = SplineGeometry()
    names = ["water", "beam"] if halves else ["water", "beam", "water"]
    places = [0.0, beam.start, beam.start + beam.length, beam.tank_length]
    if halves:
        places[2:] = [0.5 * beam.tank_length]
    bottom = [geometry.AppendPoint(x, -beam.depth) for x in (places[0], places[-1])]
    top = [
        geometry.AppendPoint(x, 0.0, **({"hpref": 1} if places[0] < x < places[-1] else {})) for x in reversed(places)
    ]
    geometry.Append(["line", bottom[0], bottom[1]], bc="wall")
    geometry.Append(["line", bottom[1], top[0]], bc="middle" if halves else "wall")
    for name, right, left in zip(reversed(names), top, top[1:], strict=False):
        size = resolution.beam_size if name == "beam" else resolution.water_size
        geometry.Append(["line", right, left], bc=name, maxh=size)
    geometry.Append(["line", top[-1], bottom[0]], bc="wall")
    largest = max(2.0 * resolution.beam_size, 0.5 * beam.depth)
    mesh = ngsolve.Mesh(geometry.GenerateMesh(maxh=largest, grading=0.6))
    mesh.RefineHP(resolution.rings, RING_RATIO)
    return mesh


def _surface(
    tank: BenchmarkTank, mesh: ngsolve.Mesh, space: ngsolve.H1, resolution: PeerResolution, *, halves: bool
) -> tuple[np.ndarray, Surface]:
    trial, test = space.TnT()
    form = ngsolve.BilinearForm(space, check_unused=False)
    form += trial * test * ngsolve.ds("water")
    form.Assemble()
    rows, columns, values = (np.asarray(part) for part in form.mat.COO())
    kept = values != 0.0
    rows, columns, values = rows[kept], columns[kept], values[kept]
    dofs, local = _shape_loads(tank, mesh, space, resolution)
    water = np.unique(rows)
    top = np.union1d(water, dofs)
    place = np.full(space.ndof, -1)
    place[top] = np.arange(len(top))
    loads = np.zeros((len(top), resolution.shapes))
    np.add.at(loads, place[dofs], local)
    surface = Surface(
        water_mass=scipy.sparse.csr_matrix((values, (place[rows], place[columns])), shape=(len(top), len(top))),
        water=place[water],
        loads=loads,
        constant=(top < mesh.nv).astype(float),  # the first unknowns are those of the vertices
        beam_length=tank.beam.length * (0.5 if halves else 1.0),
    )
    return top, surface


def _shape_loads(
    tank: BenchmarkTank, mesh: ngsolve.Mesh, space: ngsolve.H1, resolution: PeerResolution
) -> tuple[np.ndarray, FloatArray]:
    """Unknowns of each edge under the beam, shape (edges, n), and ∫φW there, shape (edges, n, shapes)."""
    places, factors = np.polynomial.legendre.leggauss(resolution.degree + _SPARE_POINTS)
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
    s = np.clip((second + (first - second) * points - tank.beam.start) / tank.beam.length, 0.0, 1.0)
    weighted = np.array(basis) * (np.abs(second - first) * weights)[:, :, None]
    values = dry_shapes(resolution.shapes, s)
    return np.array(dofs), np.matmul(weighted.transpose(0, 2, 1), values.transpose(1, 2, 0))


def _class_frequencies(
    tank: BenchmarkTank,
    mesh: ngsolve.Mesh,
    space: ngsolve.H1,
    matrix: ngsolve.BaseMatrix,
    top: np.ndarray,
    surface: Surface,
    modes: ModeClass,
) -> tuple[float, ...]:
    free = ngsolve.BitArray(space.FreeDofs(True))
    if modes.antisymmetric:
        middle = space.GetDofs(mesh.Boundaries("middle"))
        free &= ~middle
        kept = np.array([place for place, dof in enumerate(top.tolist()) if not middle[dof]])
    else:
        free.Clear(0)
        kept = np.array(range(len(top)))
    inverse = matrix.Inverse(free, inverse="sparsecholesky")
    load, potential = matrix.CreateRowVector(), matrix.CreateColVector()
    loads, potentials = load.FV().NumPy(), potential.FV().NumPy()
    loads[:] = 0.0
    dofs = top[kept]

    def answer(values: FloatArray) -> FloatArray:
        loads[dofs] = values
        inverse.Mult(load, potential)
        on_top: FloatArray = potentials[dofs]
        return on_top

    return class_frequencies(tank, surface.restricted(kept, modes.shapes), modes, answer)
