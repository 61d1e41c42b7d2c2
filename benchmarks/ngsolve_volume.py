"""Tanks in three dimensions on NGSolve: tetrahedra of a quarter of the tank, or triangles of a quarter of its plan.

A plate lies in the middle; its motion is Ritz' in products of Legendre polynomials. Netgen's OpenCASCADE geometry has
small cells at the plate's edge, the plan its hp-refinement there; unknowns inside of elements are condensed, and
factorized by NGSolve's sparse Cholesky; conjugate gradients with BDDC took ten times as long for a cube of water with
18,000 unknowns. Eigenvalues are by SciPy's ARPACK on the surface unknowns. Loads of the plate are one linear form for
each product of polynomials, as a user would write them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import product
from math import ceil
from typing import Any

import netgen.occ as occ
import ngsolve
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

Array = Any
Tank = Mapping[str, Any]

# Rational approximations of 1/(k tanh kH), H = 3 m, to 1e-4, 1e-5 and 2e-6 for k > 0.2/m: Σ w/(k² + s), by degree.
_POLES = {
    3: (
        (0.3333333333333333, 0.0),
        *((0.6666826368138131, 1.0966285479087494), (0.6752945694820617, 4.39767742827593)),
        *((0.8707343315429759, 10.622218968634849), (1.6273791346519186, 26.339052218836216)),
        *((3.321999894845728, 78.24421008354399), (7.390211621279975, 280.6397378760496)),
        *((20.822809810943685, 1329.4648034879217), (172.31697298299113, 16741.264637816992)),
    ),
    4: (
        (0.3333333333333333, 0.0),
        *((0.6666739856301702, 1.0966253329771158), (0.6716335194069328, 4.392657066203342)),
        *((0.8134959377200817, 10.376895082925142), (1.4239398659896016, 24.055523904769785)),
        *((2.7113342287221154, 64.6449693603057), (5.271337432005288, 198.09309032244312)),
        *((10.669738454810409, 678.3451538529841), (23.547743371427106, 2634.479737914108)),
        *((65.82718542211671, 12957.81991808093), (542.1239615767461, 165285.78799788794)),
    ),
    5: (
        (0.3333333333333333, 0.0),
        *((0.666679014866134, 1.0966272109002366), (0.6736911332847036, 4.39549247856635)),
        *((0.8441541292754176, 10.510847578673344), (1.5157305030150836, 25.184246958826336)),
        *((2.9066480672722945, 70.07683296282393), (5.6400481539383405, 220.22750810022194)),
        *((11.167938962782449, 757.5079782747869), (22.956150451029202, 2820.749922858393)),
        *((51.25125356291872, 11638.43155978408), (144.10544892089487, 59766.473423738345)),
        (1182.9138508001436, 781842.4351806797),
    ),
}
_POLYNOMIALS = {2: 10, 3: 12, 4: 14, 5: 16}

ngsolve.SetNumThreads(1)


def tank(given: Tank, degree: int, size: float = 0.0, cells: int = 0) -> tuple[Array, int]:
    """Return the lowest frequencies, from the mesh on: in the volume with cells of a size at the plate's edge, or with
    a number of cells along a quarter of a cube, else on the plan."""
    mesh = _volume_mesh(given, size, cells) if size or cells else _plan_mesh(given, degree)
    surface = ngsolve.ds if size or cells else ngsolve.dx
    poles = ((1.0, 0.0),) if size or cells else _POLES[degree]
    found, unknowns = [], 0
    for parity in product((0, 1), (0, 1)):
        zero = "|".join(side for side, own in zip(("middle_x", "middle_y"), parity, strict=True) if own)
        space = ngsolve.H1(mesh, order=degree, dirichlet=zero)
        answer = _inverse_of(space, poles, held=not zero)
        values, count = _class_frequencies(given, space, surface, answer, parity, _POLYNOMIALS[degree])
        found.append(values)
        unknowns += count
    return np.sort(np.concatenate(found))[: given["modes"]], unknowns


def _volume_mesh(given: Tank, size: float, cells: int) -> Any:
    box = occ.Box((0, 0, -given["depth"]), (given["length"] / 2.0, given["width"] / 2.0, 0))
    half_length, half_width = (0.5 * side for side in given["plate"])
    whole = box
    if half_length:
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
        if size and abs(z) < 1e-9 and (abs(x - half_length) < 1e-9 or abs(y - half_width) < 1e-9):
            edge.maxh = size
    largest = given["length"] / 2.0 / cells if cells else 1.5
    return ngsolve.Mesh(occ.OCCGeometry(whole).GenerateMesh(maxh=largest, grading=0.5))


def _plan_mesh(given: Tank, degree: int) -> Any:
    half_length, half_width = (0.5 * side for side in given["plate"])
    plate = occ.Rectangle(half_length, half_width).Face()
    water = occ.Rectangle(given["length"] / 2.0, given["width"] / 2.0).Face() - plate
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


def _inverse_of(space: Any, poles: tuple[tuple[float, float], ...], *, held: bool) -> Callable[[Array], Array]:
    """A⁺ on all unknowns; where ψ has a constant, of loads without flux."""
    trial, test = space.TnT()
    inverses = []
    for weight, shift in poles:
        form = ngsolve.BilinearForm(space, symmetric=True, condense=True)
        form += (ngsolve.grad(trial) * ngsolve.grad(test) + shift * trial * test) * ngsolve.dx
        form.Assemble()
        free = ngsolve.BitArray(space.FreeDofs(True))
        if held and shift == 0.0:
            free.Clear(0)
        inverses.append((weight, form, form.mat.Inverse(free, inverse="sparsecholesky")))
    load, potential, rest = (ngsolve.GridFunction(space).vec for _ in range(3))

    def answer(values: Array) -> Array:
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
    given: Tank, space: Any, surface: Any, answer: Callable[[Array], Array], parity: tuple[int, int], polynomials: int
) -> tuple[Array, int]:
    trial, test = space.TnT()
    form = ngsolve.BilinearForm(space, check_unused=False)
    form += trial * test * surface("water")
    form.Assemble()
    rows, columns, values = (np.asarray(part) for part in form.mat.COO())
    mass = 4.0 * sparse.csr_matrix((values, (rows, columns)), shape=(space.ndof, space.ndof))
    water = np.flatnonzero((mass.diagonal() > 0.0) & np.array(list(space.FreeDofs())))
    coupling, weight = mass[:, water].tocsr(), given["density"] * given["gravity"]
    stiffness, inertia = weight * mass[water][:, water], np.zeros(len(water))
    if given["plate"][0]:
        used = [
            (m, n) for m, n in product(range(polynomials), repeat=2) if (m % 2, n % 2) == parity and m + n < polynomials
        ]
        loads = 4.0 * _loads(space, surface, given["plate"], polynomials, used)
        coupling = sparse.hstack([sparse.csr_matrix(loads.T), coupling]).tocsr()
        bending = given["rigidity"] * _bending(given["plate"], given["poisson_ratio"], polynomials, used)
        stiffness = sparse.block_diag([bending + weight * np.eye(len(used)), stiffness])
        inertia = np.concatenate([np.full(len(used), given["mass"]), inertia])
    solver = splu(sparse.csc_matrix(stiffness))
    # The constant has ones at the vertices; ∫ζ = 0 in the class that holds it.
    constant = np.zeros(space.ndof)
    constant[: space.mesh.nv] = 1.0
    volume = coupling.T @ constant
    correction = solver.solve(volume) / (volume @ solver.solve(volume)) * float(sum(parity) == 0)

    def kinetic(values: Array) -> Array:
        kept = values.ravel() - correction * (volume @ values.ravel())
        moved = inertia * kept + given["density"] * (coupling.T @ (answer(coupling @ kept) / 4.0))
        return moved - volume * (correction @ moved)

    size = len(inertia)
    operator = LinearOperator((size, size), matvec=kinetic, dtype=float)
    inverse = LinearOperator((size, size), matvec=solver.solve, dtype=float)
    found = eigsh(operator, k=6, M=sparse.csr_matrix(stiffness), Minv=inverse, which="LA", return_eigenvectors=False)
    return 1.0 / np.sqrt(found), space.ndof + size


def _loads(space: Any, surface: Any, sides: Array, count: int, used: list[tuple[int, int]]) -> Array:
    """∫φW over a quarter of the plate for each product W of Legendre polynomials with ∫W² = 1 over all of it."""
    along, across = (
        _legendre(2.0 * place / side, count, side) for place, side in zip((ngsolve.x, ngsolve.y), sides, strict=True)
    )
    test, rows = space.TestFunction(), []
    for m, n in used:
        form = ngsolve.LinearForm(space)
        form += along[m] * across[n] * test * surface("plate", bonus_intorder=m + n)
        form.Assemble()
        rows.append(form.vec.FV().NumPy().copy())
    return np.array(rows)


def _legendre(place: Any, count: int, side: float) -> list[Any]:
    found = [ngsolve.CoefficientFunction(1.0), place]
    for k in range(1, count - 1):
        found.append(((2 * k + 1) * place * found[k] - k * found[k - 1]) / (k + 1))
    return [np.sqrt((2 * k + 1) / side) * one for k, one in enumerate(found[:count])]


def _bending(sides: Array, poisson: float, count: int, used: list[tuple[int, int]]) -> Array:
    """Kirchhoff's ∫(∇²W)² − (1 − ν)(2 W_xx W_yy − 2 W_xy²) in these products, of D = 1."""
    places, weights = np.polynomial.legendre.leggauss(count + 2)
    parts = []
    for side in sides:
        norms = np.sqrt((2 * np.arange(count) + 1) / side)
        of_order = []
        for order in range(3):
            slopes = np.polynomial.legendre.legder(np.eye(count), order, axis=0) * (2.0 / side) ** order
            of_order.append(norms[:, None] * np.polynomial.legendre.legval(places, slopes))
        parts.append([[0.5 * side * (a * weights) @ b.T for b in of_order] for a in of_order])
    (x, y), (m, n) = parts, np.array(used).T
    pick = [np.ix_(m, m), np.ix_(n, n)]
    first = x[2][2][pick[0]] * y[0][0][pick[1]] + x[0][0][pick[0]] * y[2][2][pick[1]]
    mixed = x[2][0][pick[0]] * y[0][2][pick[1]] + x[0][2][pick[0]] * y[2][0][pick[1]]
    return first + poisson * mixed + 2.0 * (1.0 - poisson) * x[1][1][pick[0]] * y[1][1][pick[1]]
