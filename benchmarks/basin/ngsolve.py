"""The basin on NGSolve: tetrahedra of a quarter of the tank, or triangles of a quarter of its plan with the same poles.

Both take this project's Ritz modes of the plate, and eigenvalues by SciPy's ARPACK on the surface unknowns. What is
used of NGSolve: Netgen's OpenCASCADE geometry with small cells at the plate's edge, or its hp-refinement on the plan;
unknowns inside of elements condensed; its sparse Cholesky. Loads of the plate are one linear form for each product of
Legendre polynomials, as a user would write them.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import ceil

import netgen.occ as occ
import ngsolve
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from hydroelastic.benchmarks.basin.cases import basin_named
from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.modal.liquid.vertical_poles import vertical_poles
from hydroelastic.modal.plate.rectangle import rectangle_modes
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Rectangle

_POLYNOMIALS = {2: 10, 3: 12, 4: 14, 5: 16}
_POLE_ERRORS = {3: 1e-4, 4: 1e-5, 5: 2e-6}
_MODES_OF_A_CLASS = 6

ngsolve.SetNumThreads(1)


def versions() -> dict[str, str]:
    """What computes."""
    return {"NGSolve": ngsolve.__version__}


def solve(case: Case) -> Answer:
    """The twelve lowest frequencies, from the mesh on."""
    basin = basin_named(case.tank)
    tank = basin.tank
    if case.code == "ngsolve volume":
        mesh, surface = _volume_mesh(tank, case.size), ngsolve.ds
    else:
        mesh, surface = _plan_mesh(tank, case.degree), ngsolve.dx
    found: list[float] = []
    unknowns = 0
    for parity in product((0, 1), (0, 1)):
        zero = "|".join(side for side, own in zip(("middle_x", "middle_y"), parity, strict=True) if own)
        space = ngsolve.H1(mesh, order=case.degree, dirichlet=zero)
        answers = _answers(tank, space, case, closed=not zero)
        values, size = _class_frequencies(tank, space, surface, answers, parity, _POLYNOMIALS[case.degree])
        found += values
        unknowns += size
    return Answer(values=tuple(sorted(found)[: len(basin.omega)]), unknowns=unknowns)


def _quarter(tank: LevelTank) -> tuple[float, float, float, float]:
    """Half the sides of the box and of the plate, whose common middle is the origin."""
    assert isinstance(tank.plan, Box)
    outline = tank.plates[0].outline
    assert isinstance(outline, Rectangle)
    return 0.5 * tank.plan.length, 0.5 * tank.plan.width, 0.5 * outline.size[0], 0.5 * outline.size[1]


def _volume_mesh(tank: LevelTank, size: float) -> ngsolve.Mesh:
    length, width, half_length, half_width = _quarter(tank)
    box = occ.Box((0, 0, -tank.depth), (length, width, 0))
    plate = occ.WorkPlane(occ.Axes((0, 0, 0), n=occ.Z, h=occ.X)).Rectangle(half_length, half_width).Face()
    whole = occ.Glue([box, plate])
    for face in whole.faces:
        x, y, z = face.center
        if abs(z) < 1e-9:
            face.name = "plate" if x < half_length and y < half_width else "water"
        elif abs(x) < 1e-9:
            face.name = "middle_x"
        elif abs(y) < 1e-9:
            face.name = "middle_y"
    for edge in whole.edges:
        x, y, z = edge.center
        if abs(z) < 1e-9 and (abs(x - half_length) < 1e-9 or abs(y - half_width) < 1e-9):
            edge.maxh = size
    return ngsolve.Mesh(occ.OCCGeometry(whole).GenerateMesh(maxh=1.5, grading=0.5))


def _plan_mesh(tank: LevelTank, degree: int) -> ngsolve.Mesh:
    length, width, half_length, half_width = _quarter(tank)
    plate = occ.Rectangle(half_length, half_width).Face()
    water = occ.Rectangle(length, width).Face() - plate
    plate.faces.name, water.faces.name = "plate", "water"
    whole = occ.Glue([plate, water])
    for edge in whole.edges:
        x, y, _ = edge.center
        if abs(x) < 1e-9:
            edge.name = "middle_x"
        elif abs(y) < 1e-9:
            edge.name = "middle_y"
        elif x < half_length + 1e-9 and y < half_width + 1e-9:
            edge.hpref = 1
    for vertex in whole.vertices:
        # Without its corner an edge is refined wrongly: ψ is then off by per cents.
        if abs(vertex.p.x - half_length) < 1e-9 and abs(vertex.p.y - half_width) < 1e-9:
            vertex.hpref = 1
    mesh = ngsolve.Mesh(occ.OCCGeometry(whole, dim=2).GenerateMesh(maxh=1.2))
    mesh.RefineHP(ceil(0.5 * degree), 0.2)
    return mesh


def _answers(tank: LevelTank, space: ngsolve.H1, case: Case, *, closed: bool) -> Callable[[FloatArray], FloatArray]:
    """A⁺ on all unknowns; where ψ has a constant, of loads without flux."""
    trial, test = space.TnT()
    poles = [(1.0, 0.0)]
    if case.code == "ngsolve plan":
        found = vertical_poles(tank.depth, 4.0, _POLE_ERRORS[case.degree], lowest=0.2)
        poles = list(zip(found.weights, found.shifts, strict=True))
    inverses = []
    for weight, shift in poles:
        form = ngsolve.BilinearForm(space, symmetric=True, condense=True)
        form += (ngsolve.grad(trial) * ngsolve.grad(test) + float(shift) * trial * test) * ngsolve.dx
        form.Assemble()
        free = ngsolve.BitArray(space.FreeDofs(True))
        if closed and shift == 0.0:
            free.Clear(0)
        inverse = form.mat.Inverse(free, inverse="sparsecholesky")
        inverses.append((float(weight), form, inverse))
    load, potential, rest = (ngsolve.GridFunction(space).vec for _ in range(3))

    def answer(values: FloatArray) -> FloatArray:
        load.FV().NumPy()[:] = values
        total = np.zeros(len(values))
        for weight, form, inverse in inverses:
            rest.data = load + form.harmonic_extension_trans * load
            potential.data = inverse * rest
            potential.data += form.harmonic_extension * potential
            potential.data += form.inner_solve * load
            total += weight * potential.FV().NumPy()
        return total

    return answer


def _class_frequencies(
    tank: LevelTank,
    space: ngsolve.H1,
    surface: Callable[..., ngsolve.comp.DifferentialSymbol],
    answer: Callable[[FloatArray], FloatArray],
    parity: tuple[int, int],
    polynomials: int,
) -> tuple[list[float], int]:
    trial, test = space.TnT()
    form = ngsolve.BilinearForm(space, check_unused=False)
    form += trial * test * surface("water")
    form.Assemble()
    rows, columns, values = (np.asarray(part) for part in form.mat.COO())
    mass = sparse.csr_matrix((values, (rows, columns)), shape=(space.ndof, space.ndof))
    free = np.array(list(space.FreeDofs()))
    water = np.flatnonzero((mass.diagonal() > 0.0) & free)
    mass = 4.0 * mass[:, water]
    plate = tank.plates[0]
    outline = plate.outline
    assert isinstance(outline, Rectangle)
    modes = rectangle_modes(outline.size, plate.poisson_ratio, polynomials, parities=(parity[0], parity[1]))  # type: ignore[arg-type]
    loads = 4.0 * _loads(space, surface, outline, modes.coefficients) * np.sqrt(outline.area)
    coupling = sparse.hstack([sparse.csr_matrix(loads.T), mass]).tocsr()
    squares = np.full(len(loads), outline.area)
    bending = plate.flexural_rigidity * modes.stiffness * squares
    weight = tank.density * tank.gravity
    stiffness = sparse.block_diag([sparse.diags(bending + weight * squares), weight * mass[water]], "csc")
    solver = splu(stiffness)
    # The constant has ones at the vertices; ∫ζ = 0 in the class that holds it.
    vertices = np.zeros(space.ndof)
    vertices[: space.mesh.nv] = 1.0
    volume = coupling.T @ vertices
    correction = solver.solve(volume) / (volume @ solver.solve(volume)) * float(sum(parity) == 0)
    inertia = np.concatenate([plate.mass_per_area * squares, np.zeros(len(water))])

    def kinetic(values: FloatArray) -> FloatArray:
        kept = values.ravel() - correction * (volume @ values.ravel())
        moved: FloatArray = inertia * kept + tank.density * (coupling.T @ (answer(coupling @ kept) / 4.0))
        return moved - volume * (correction @ moved)

    size = len(inertia)
    operator = LinearOperator((size, size), matvec=kinetic, dtype=float)
    inverse = LinearOperator((size, size), matvec=solver.solve, dtype=float)
    found = eigsh(operator, k=_MODES_OF_A_CLASS, M=stiffness, Minv=inverse, which="LA", return_eigenvectors=False)
    return [float(value) for value in 1.0 / np.sqrt(found)], space.ndof + size


def _loads(
    space: ngsolve.H1,
    surface: Callable[..., ngsolve.comp.DifferentialSymbol],
    outline: Rectangle,
    coefficients: FloatArray,
) -> FloatArray:
    """∫φW over the plate for each mode W, shape (modes, unknowns)."""
    count = coefficients.shape[1]
    along, across = (
        _legendre(2.0 * place / side, count, side)
        for place, side in zip((ngsolve.x, ngsolve.y), outline.size, strict=True)
    )
    used = np.argwhere(np.abs(coefficients).max(axis=0) > 0.0)
    test = space.TestFunction()
    rows = []
    for m, n in used:
        form = ngsolve.LinearForm(space)
        form += along[m] * across[n] * test * surface("plate", bonus_intorder=int(m + n))
        form.Assemble()
        rows.append(form.vec.FV().NumPy().copy())
    return np.asarray(coefficients[:, used[:, 0], used[:, 1]] @ np.array(rows))


def _legendre(place: ngsolve.CoefficientFunction, count: int, side: float) -> list[ngsolve.CoefficientFunction]:
    found = [ngsolve.CoefficientFunction(1.0), place]
    for k in range(1, count - 1):
        found.append(((2 * k + 1) * place * found[k] - k * found[k - 1]) / (k + 1))
    return [np.sqrt((2 * k + 1) / side) * one for k, one in enumerate(found[:count])]
