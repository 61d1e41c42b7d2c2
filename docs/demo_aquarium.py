# # A beam afloat in a tank
#
# The flagship of this project on one page: the equations, the same in UFL, the eigenproblem by SLEPc, and the error of
# each frequency. A test runs this page.
#
# **Strong form.** The displacement potential $\psi$ of a liquid at rest in $0<x<L$, $-H<y<0$ obeys
#
# $$\Delta\psi = 0, \qquad \partial_n\psi = 0 \text{ on walls}, \qquad \partial_y\psi = \zeta \text{ on } y = 0,$$
#
# where $\zeta$ is the elevation $\eta$ of the free surface, and on the beam its deflection $w=\sum a_i\varphi_i$ in
# its dry modes. With the time factor $e^{-i\omega t}$ the pressures balance: $\omega^2\psi = g\eta$, and
# $EIw'''' - m\omega^2 w = \omega^2\rho\psi$.
#
# **Weak form.** For all $q$, and for all variations of $\zeta=(a,\eta)$ that keep the volume,
#
# $$\int\nabla\psi\cdot\nabla q = \int\zeta q \quad (A\psi = C\zeta), \qquad K\zeta = \omega^2\,(M +
# \rho\,C^TA^+C)\,\zeta.$$

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from petsc4py import PETSc
from slepc4py import SLEPc

from hydroelastic.meshes.distribute import distribute_nodes
from hydroelastic.meshes.outline import Curve, Outline, Region
from hydroelastic.meshes.section import SectionSizes, section_triangles
from hydroelastic.modal.beam.dry_modes import free_free_shapes, free_free_wavenumber

# ## The tank
# Per metre of width. In units of its length, $g$ and $\rho$ rounding is the same for a glass and a harbour.

length, depth, start, beam = 10.0, 5.0, 3.0, 4.0  # m
rigidity, mass, density, gravity = 5e3, 50.0, 1000.0, 9.81  # N m, kg/m², kg/m³, m/s²
H, s, span = depth / length, start / length, beam / length
EI, m = rigidity / (density * gravity * length**4), mass / (density * length)
shapes, count = 40, 10

# ## The mesh
# gmsh's triangles by a size field. At the tips of the beam $\psi\sim r\ln r$: cells there have the geometry $r =
# s^3$, on which that
# is three times smoother.

corners = [(0.0, -H), (1.0, -H), (1.0, 0.0), (s + span, 0.0), (s, 0.0), (0.0, 0.0)]
names = ["bottom", "wall", "water", "beam", "water", "wall"]
curves = [
    Curve(name=name, start=a, end=b) for name, a, b in zip(names, corners, corners[1:] + corners[:1], strict=True)
]
outline = Outline(curves=tuple(curves), regions=(Region(name="liquid", loop=tuple((i, True) for i in range(6))),))
tips = {(s, 0.0): (0.03, 1.15), (s + span, 0.0): (0.03, 1.15)}  # size of cells, and their largest angle
triangles = section_triangles(outline, SectionSizes(bulk=0.15, points=tips))
tagged = distribute_nodes(MPI.COMM_SELF, triangles.noded(dict.fromkeys(tips, 3), 3))
mesh = tagged.mesh
ds = ufl.Measure("ds", mesh, subdomain_data=tagged.facet_tags)


# ## Matrices
# $A$ and the loads $C$ of the water's elevation and of the beam's dry modes; these are interpolated at a degree
# four higher.


def matrix(form):
    assembled = fem_petsc.assemble_matrix(fem.form(form))
    assembled.assemble()
    return assembled


def dense(values):
    return PETSc.Mat().createDense(values.shape, array=np.asfortranarray(values), comm=MPI.COMM_SELF)


def matrices(degree):
    V, W = (fem.functionspace(mesh, ("Lagrange", p)) for p in (degree, degree + 4))
    psi, q, w = ufl.TrialFunction(V), ufl.TestFunction(V), ufl.TrialFunction(W)
    more = 3
    A = matrix(ufl.inner(ufl.grad(psi), ufl.grad(q)) * ufl.dx(metadata={"quadrature_degree": 2 * degree + more}))
    of_water = ds(tagged.facet_names["water"], metadata={"quadrature_degree": 2 * degree + more})
    of_beam = ds(tagged.facet_names["beam"], metadata={"quadrature_degree": 2 * degree + 4 + more})
    water, wet = matrix(psi * q * of_water), matrix(w * q * of_beam)
    surface = fem.locate_dofs_topological(V, 1, tagged.facets("water"))
    touched = fem.locate_dofs_topological(W, 1, tagged.facets("beam"))
    x = np.clip((W.tabulate_dof_coordinates()[touched, 0] - s) / span, 0.0, 1.0)
    everything = range(V.dofmap.index_map.size_local)
    of_surface = water.getValues(everything, surface)
    C = np.hstack([wet.getValues(everything, touched) @ free_free_shapes(shapes, x).T, of_surface])
    bending = np.array([EI * span * (free_free_wavenumber(n) / span) ** 4 for n in range(shapes)])
    K = np.zeros((C.shape[1],) * 2)
    K[:shapes, :shapes], K[shapes:, shapes:] = np.diag(bending), of_surface[surface]
    M = np.diag([m * span] * shapes + [0.0] * len(surface))
    return A, C, K, M


# ## Modes
# $\psi$ is known up to a constant, so one unknown is fixed, and $\zeta$ keeps the volume: one of its unknowns
# follows from the others.
# The largest $1/(\lambda+\sigma)$ are the lowest modes; $\sigma>0$ makes $K+\sigma M$ definite, as the beam's rigid
# motions have no stiffness.


def frequencies(degree, kept=shapes):
    A, C, K, M = matrices(degree)
    some = np.r_[:kept, shapes : C.shape[1]]
    C, K, M = C[:, some], K[np.ix_(some, some)], M[np.ix_(some, some)]
    volume = C.sum(axis=0)
    pivot = int(np.argmax(abs(volume)))
    free = np.delete(np.eye(len(volume)), pivot, axis=1)
    free[pivot] = -np.delete(volume, pivot) / volume[pivot]
    flux = C @ free
    flux[0] = 0.0
    A.zeroRowsColumns([0], 1.0)
    solver = PETSc.KSP().create(MPI.COMM_SELF)
    solver.setOperators(A)
    solver.setType("preonly")
    solver.getPC().setType("cholesky")
    psi = dense(np.zeros(flux.shape))
    solver.matSolve(dense(flux), psi)
    K, T = free.T @ K @ free, free.T @ M @ free + flux.T @ psi.getDenseArray()
    scale = 1.0 / np.sqrt(np.diag(K) + np.diag(T))
    K, T = scale[:, None] * K * scale, scale[:, None] * T * scale
    sigma = 0.05
    eigen = SLEPc.EPS().create(MPI.COMM_SELF)
    eigen.setOperators(dense(T), dense(K + sigma * T))
    eigen.setProblemType(SLEPc.EPS.ProblemType.GHEP)
    eigen.setWhichEigenpairs(SLEPc.EPS.Which.LARGEST_REAL)
    eigen.setDimensions(count + 2)
    eigen.setTolerances(1e-14)
    eigen.solve()
    values = np.array([1.0 / eigen.getEigenvalue(n).real - sigma for n in range(eigen.getConverged())])
    return np.sqrt(values[values > 1e-8][:count] * gravity / length)


# ## Errors
# Three degrees on one mesh tell the rate of convergence, and what is left of a geometric series; so do all, half
# and a quarter of the
# dry modes.


def remainder(finest, finer, coarse, least):
    last, before = abs(finest / finer - 1), abs(finer / coarse - 1)
    rate = np.clip(last / before, least, 0.5)
    return 3 * last * rate / (1 - rate)


omega, *coarser = (frequencies(degree) for degree in (10, 9, 8))
liquid = remainder(omega, *coarser, 0.1)
dry_modes = remainder(omega, frequencies(10, shapes // 2), frequencies(10, shapes // 4), 0.01)
error = liquid + dry_modes + 1e-12  # and rounding

if __name__ == "__main__":
    for mode in range(count):
        print(f"{mode + 1:3}  {omega[mode]:.12f} rad/s   estimated relative error {error[mode]:.0e}")
