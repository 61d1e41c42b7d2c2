"""The tanks on scikit-fem: graded quadrilaterals of any degree, static condensation in NumPy, SciPy's factorization.

What was tried, and measured on one thread for ten modes of the tank base_s0 at an error near 1e-8. The first of each
is used:

- Element: `ElementQuadP` on `graded_quads`; `ElementTriP4`, its highest on triangles, on the same mesh cut in two and
  refined (five times the seconds at 1e-6, and its error falls more slowly).
- Local matrices: one product of arrays for each shape that an element has, for in the plane ∫∇ψ·∇q does not depend on
  its size; the same for all elements (twice to three times the seconds); `BilinearForm`, which calls Python for each
  pair of basis functions (four times).
- Matrix: unknowns inside of elements condensed; all unknowns in the factorization (1.6 times the seconds).
- Factorization: SuperLU of SciPy with the ordering for symmetric matrices. SciPy has no other.
- Eigen-solver: as for NGSolve.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import skfem
from skfem.element import ElementLinePp, ElementQuadP

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.cases import BenchmarkTank, tank_named
from hydroelastic.benchmarks.tank.dry_shapes import dry_shapes
from hydroelastic.benchmarks.tank.graded_quads import QuadGrading, graded_quads
from hydroelastic.benchmarks.tank.peer_resolution import RING_RATIO, PeerResolution, PeerRule, peer_resolution
from hydroelastic.benchmarks.tank.peer_surface import Surface, class_frequencies
from hydroelastic.benchmarks.tank.symmetry import ModeClass, lowest_of, mode_classes
from hydroelastic.physics.arrays import FloatArray

_RULE = PeerRule(waves_on_water=0.5, waves_under_beam=0.4, degrees_per_ring=2)
_SPARE_POINTS = 6
_HEIGHT = 3.0

# Vertices between which the four edges of ElementQuadP run.
_EDGE_STARTS = np.array([0, 1, 3, 0])
_EDGE_ENDS = np.array([1, 2, 2, 3])


def versions() -> dict[str, str]:
    """What computes."""
    return {"scikit-fem": skfem.__version__}


def solve(case: Case) -> Answer:
    """The ten lowest frequencies of a tank, from the mesh on."""
    tank, halves = tank_named(case.tank), case.variant == "halves"
    resolution = peer_resolution(tank, case.degree, _RULE)
    mesh = _mesh(tank, resolution, halves=halves)
    space, skeleton = _skeleton(mesh, case.degree)
    facets = _TopFacets.of(mesh, space)
    surface = _surface(tank, facets, resolution, halves=halves)
    found = [
        _class_frequencies(tank, mesh, space, skeleton, facets.dofs, surface, modes)
        for modes in mode_classes(resolution.shapes, halves=halves)
    ]
    return Answer(values=lowest_of(tuple(found)), unknowns=int(space.N) + len(surface.water) + resolution.shapes)


def _mesh(tank: BenchmarkTank, resolution: PeerResolution, *, halves: bool) -> skfem.MeshQuad:
    beam = tank.beam
    mesh = graded_quads(
        beam.tank_length * (0.5 if halves else 1.0),
        beam.depth,
        (beam.start, beam.start + beam.length),
        QuadGrading(
            water_size=resolution.water_size,
            beam_size=resolution.beam_size,
            height=_HEIGHT * max(resolution.water_size, resolution.beam_size),
            rings=resolution.rings,
            ratio=RING_RATIO,
        ),
    )
    return skfem.MeshQuad(np.ascontiguousarray(mesh.nodes.T), np.ascontiguousarray(mesh.quads.T), validate=False)


def _skeleton(mesh: skfem.MeshQuad, degree: int) -> tuple[skfem.Dofs, scipy.sparse.csc_matrix]:
    """Unknowns, and ∫∇ψ·∇q with the unknowns inside of elements condensed; those come last."""
    corners = mesh.p[:, mesh.t]
    edges = corners - corners[:, :1]
    shapes = np.round((edges / np.hypot(*edges[:, 1])).transpose(2, 0, 1).reshape(mesh.nelements, -1), 9)
    _, examples, kinds = np.unique(shapes, axis=0, return_index=True, return_inverse=True)
    basis = skfem.CellBasis(mesh, ElementQuadP(degree), elements=examples, quadrature=_gauss_square(degree + 1))
    gradients = np.stack([np.asarray(field[0].grad) for field in basis.basis]).transpose(2, 0, 1, 3)
    flat = gradients.reshape(*gradients.shape[:2], -1)
    weighted = (gradients * basis.dx[:, None, None, :]).reshape(flat.shape)
    local = np.matmul(weighted, flat.transpose(0, 2, 1))
    count = 4 * degree
    outer, mixed, inner = local[:, :count, :count], local[:, count:, :count], local[:, count:, count:]
    condensed = (outer - np.matmul(mixed.transpose(0, 2, 1), np.linalg.solve(inner, mixed)))[kinds.ravel()]
    dofs = basis.dofs.element_dofs[:count].T
    size = int(dofs.max()) + 1
    rows, columns = np.repeat(dofs, count, axis=1).ravel(), np.tile(dofs, (1, count)).ravel()
    return basis.dofs, scipy.sparse.coo_matrix((condensed.ravel(), (rows, columns)), shape=(size, size)).tocsc()


def _gauss_square(count: int) -> tuple[FloatArray, FloatArray]:
    points, weights = _gauss(count)
    x, y = np.meshgrid(points, points, indexing="ij")
    return np.vstack([x.ravel(), y.ravel()]), np.outer(weights, weights).ravel()


def _gauss(count: int) -> tuple[FloatArray, FloatArray]:
    points, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (points + 1.0), 0.5 * weights


@dataclass(frozen=True, kw_only=True)
class _TopFacets:
    """Edges on y = 0.

    Attributes:
        starts: abscissae at which the basis functions of an edge begin, m.
        ends: abscissae at which they end, m.
        facet_dofs: unknowns of each edge as places in ``dofs``, shape (edges, degree + 1).
        dofs: unknowns of the top, those of vertices first.
        vertices: how many of them belong to vertices.
    """

    starts: FloatArray
    ends: FloatArray
    facet_dofs: np.ndarray
    dofs: np.ndarray
    vertices: int

    @staticmethod
    def of(mesh: skfem.MeshQuad, space: skfem.Dofs) -> _TopFacets:
        facets = np.flatnonzero((mesh.p[1][mesh.facets] == 0.0).all(axis=0))
        elements = mesh.f2t[0][facets]
        place = np.argmax(mesh.t2f[:, elements] == facets, axis=0)
        first, last = mesh.t[_EDGE_STARTS[place], elements], mesh.t[_EDGE_ENDS[place], elements]
        own = np.vstack([first, last, space.facet_dofs[:, facets]]).T
        dofs, places = np.unique(own, return_inverse=True)
        return _TopFacets(
            starts=mesh.p[0][first],
            ends=mesh.p[0][last],
            facet_dofs=places.reshape(own.shape),
            dofs=dofs,
            vertices=int(np.count_nonzero(dofs < mesh.nvertices)),
        )


def _surface(tank: BenchmarkTank, facets: _TopFacets, resolution: PeerResolution, *, halves: bool) -> Surface:
    beam = tank.beam
    points, weights = _gauss(resolution.degree + _SPARE_POINTS)
    element = ElementLinePp(resolution.degree)
    basis = np.stack([element.lbasis(points[None, :], number)[0] for number in range(resolution.degree + 1)])
    middle = 0.5 * (facets.starts + facets.ends)
    under = (middle > beam.start) & (middle < beam.start + beam.length)
    lengths = np.abs(facets.ends - facets.starts)
    wet = facets.facet_dofs[~under]
    mass = ((basis * weights) @ basis.T) * lengths[~under][:, None, None]
    rows, columns = np.repeat(wet, wet.shape[1], axis=1).ravel(), np.tile(wet, (1, wet.shape[1])).ravel()
    size = len(facets.dofs)
    start, step = facets.starts[under, None], (facets.ends - facets.starts)[under, None]
    values = dry_shapes(resolution.shapes, np.clip((start + step * points - beam.start) / beam.length, 0.0, 1.0))
    local = np.matmul(basis * weights, values.transpose(1, 2, 0)) * lengths[under][:, None, None]
    loads = np.zeros((size, resolution.shapes))
    np.add.at(loads, facets.facet_dofs[under], local)
    return Surface(
        water_mass=scipy.sparse.coo_matrix((mass.ravel(), (rows, columns)), shape=(size, size)).tocsr(),
        water=np.unique(wet),
        loads=loads,
        constant=(np.arange(size) < facets.vertices).astype(float),
        beam_length=beam.length * (0.5 if halves else 1.0),
    )


def _class_frequencies(
    tank: BenchmarkTank,
    mesh: skfem.MeshQuad,
    space: skfem.Dofs,
    skeleton: scipy.sparse.csc_matrix,
    top: np.ndarray,
    surface: Surface,
    modes: ModeClass,
) -> tuple[float, ...]:
    free = np.ones(skeleton.shape[0], dtype=bool)
    if modes.antisymmetric:
        plane = 0.5 * tank.beam.tank_length
        middle = np.flatnonzero((mesh.p[0][mesh.facets] == plane).all(axis=0))
        free[mesh.facets[:, middle]] = False
        free[space.facet_dofs[:, middle]] = False
    else:
        free[np.argmin(mesh.p[1])] = False
    unknowns = np.flatnonzero(free)
    factor = scipy.sparse.linalg.splu(
        skeleton[unknowns][:, unknowns],
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    kept = np.flatnonzero(free[top])
    places = np.searchsorted(unknowns, top[kept])
    right_side = np.zeros(len(unknowns))

    def answer(values: FloatArray) -> FloatArray:
        right_side[places] = values
        on_top: FloatArray = factor.solve(right_side)[places]
        return on_top

    return class_frequencies(tank, surface.restricted(kept, modes.shapes), modes, answer)
