"""Frequency error of modes of the second degree in a volume, from the energy that the third degree adds.

With ψ₂ the mode and ψ₃ the answer of Laplace's equation in the third degree to the same motion of the surfaces,

    (λ₂ − λ)/λ ≈ ρ ∫|∇(ψ₃ − ψ₂)|²    at unit generalized mass.

e = ψ₃ − ψ₂ is orthogonal, in energy, to all polynomials of the second degree, so that no coarser level contributes to
it: a few steps of conjugate gradients with the diagonal of the matrix find it. The matrix is only applied, cell by
cell; three times as many unknowns as those of the modes stand in five vectors.
"""

from __future__ import annotations

from itertools import chain

import basix
import numpy as np
import ufl
from dolfinx import fem, la
from numpy.typing import NDArray
from scipy.sparse import csr_array, vstack

from hydroelastic.fem.cells import cell_jacobians, is_straight, owned_cells
from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.liquid import LiquidSpace, as_functions, liquid_space
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.shape_loads import shape_loads
from hydroelastic.fem.volume.loads import plate_loads
from hydroelastic.meshes.geometry import FREE_SURFACE

DEGREE = 2
"""Of the modes."""

# The energy only grows from step to step; it is taken where two steps add less than this part of it. Measured: eight
# to ten steps.
_ADDED = 0.02
_MOST_STEPS = 40
_MIDDLE = np.full((1, 3), 0.25)


def cubic_errors(
    pencil: CoupledPencil[LiquidSpace], plates: tuple[PlanPlate, ...], modes: list[Mode]
) -> NDArray[np.float64]:
    """Estimate (λ₂ − λ)/λ of modes at unit generalized mass, cell by cell."""
    quadratic = pencil.liquid
    tank = quadratic.tank
    cubic = liquid_space(tank, DEGREE + 1, quadratic.zero_potential)
    moving = [plate for plate in plates if plate.body.size]
    rows = chain(
        (load for plate in moving for load in plate_loads(cubic, plate)),
        (load for body in pencil.bodies[len(moving) :] for load in shape_loads(cubic, body)),
    )
    # Sparse, as they are of surfaces.
    loads = vstack([csr_array((1, len(cubic.numbering.owned_dofs))), *(csr_array(row[None]) for row in rows)]).tocsr()[
        1:
    ]
    equation = _CubicEquation(cubic, quadratic, waves=bool(pencil.surfaces))
    errors = []
    for mode, potential in zip(modes, as_functions(quadratic, [mode.potential for mode in modes]), strict=True):
        equation.energy_of(potential, mode.eigenvalue, loads.T @ mode.body_amplitudes)
        errors.append(equation.cell_energies())
    return np.array(errors).reshape(len(modes), len(owned_cells(tank.mesh)))


class _CubicEquation:
    """∫∇e·∇q = ∫ζq − ∫∇ψ₂·∇q in the third degree, without a matrix."""

    def __init__(self, cubic: LiquidSpace, quadratic: LiquidSpace, *, waves: bool) -> None:
        mesh = cubic.tank.mesh
        self._comm, self._cells = mesh.comm, len(owned_cells(mesh))
        self._owned = cubic.space.dofmap.index_map.size_local
        self._error, self._direction = fem.Function(cubic.space), fem.Function(cubic.space)
        self._potential = fem.Function(quadratic.space)
        self._eigenvalue = fem.Constant(mesh, 0.0)
        test = ufl.TestFunction(cubic.space)
        # Two digits are enough of an error.
        more = 0 if is_straight(mesh) else 2
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2 * DEGREE + more})
        residual = -ufl.inner(ufl.grad(self._potential), ufl.grad(test)) * dx
        if waves:
            # On the water η = λψ, with g = 1.
            water = ufl.Measure(
                "ds",
                domain=mesh,
                subdomain_data=cubic.tank.facet_tags,
                subdomain_id=cubic.tank.facet_names[FREE_SURFACE],
                metadata={"quadrature_degree": 2 * DEGREE + 1 + more},
            )
            residual += self._eigenvalue * self._potential * test * water
        self._residual = compiled_form(residual)
        self._applied = compiled_form(ufl.inner(ufl.grad(self._direction), ufl.grad(test)) * dx)
        of_cells = ufl.TestFunction(fem.functionspace(mesh, ("Discontinuous Lagrange", 0)))
        gradient = ufl.grad(self._error)
        self._energies = compiled_form(ufl.inner(gradient, gradient) * of_cells * dx)
        self._free = np.ones(self._owned, dtype=bool)
        self._free[cubic.zero_dofs()] = False
        self._inverse = self._free / self._diagonal(cubic)

    def energy_of(self, potential: fem.Function, eigenvalue: float, loads: NDArray[np.float64]) -> None:
        """Find e of a mode, with the loads of its bodies (collective)."""
        self._potential.x.array[:] = potential.x.array
        self._eigenvalue.value = eigenvalue
        error, direction = self._error.x.array, self._direction.x.array
        error[:] = direction[:] = 0.0
        rest = self._free * (self._vector(self._residual) + loads)
        energies: list[float] = [0.0]
        before = 1.0
        for _ in range(_MOST_STEPS):
            scaled = self._inverse * rest
            product = self._dot(rest, scaled)
            if product == 0.0:
                break
            direction[: self._owned] = scaled + product / before * direction[: self._owned]
            self._direction.x.scatter_forward()
            applied = self._free * self._vector(self._applied)
            step = product / self._dot(applied, direction[: self._owned])
            error[: self._owned] += step * direction[: self._owned]
            rest -= step * applied
            before = product
            energies.append(energies[-1] + step * product)
            if len(energies) > 2 and energies[-1] - energies[-3] < _ADDED * energies[-1]:
                break
        self._error.x.scatter_forward()

    def cell_energies(self) -> NDArray[np.float64]:
        """∫|∇e|² of each owned cell."""
        energies: NDArray[np.float64] = fem.assemble_vector(self._energies).array[: self._cells]
        return energies

    def _vector(self, form: fem.Form) -> NDArray[np.float64]:
        """Owned entries of an assembled vector (collective)."""
        vector = fem.assemble_vector(form)
        vector.scatter_reverse(la.InsertMode.add)
        owned: NDArray[np.float64] = vector.array[: self._owned]
        return owned

    def _dot(self, one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
        return float(self._comm.allreduce(float(one @ other)))

    def _diagonal(self, cubic: LiquidSpace) -> NDArray[np.float64]:
        """The diagonal of the matrix of straight cells, owned entries (collective)."""
        mesh = cubic.tank.mesh
        cells = owned_cells(mesh)
        points, weights = basix.make_quadrature(basix.CellType.tetrahedron, 2 * DEGREE)
        slopes = cubic.space.element.basix_element.tabulate(1, points)[1:, :, :, 0]
        table = np.einsum("q,aqi,bqi->abi", weights, slopes, slopes).reshape(9, -1)
        jacobian = cell_jacobians(mesh, cells, _MIDDLE)[:, 0]
        inverse, measure = np.linalg.inv(jacobian), np.abs(np.linalg.det(jacobian))
        metric = measure[:, None, None] * (inverse @ inverse.transpose(0, 2, 1))
        vector = la.vector(cubic.space.dofmap.index_map)
        dofs = cubic.space.dofmap.list[: len(cells)]
        vector.array[:] = np.bincount(dofs.ravel(), (metric.reshape(-1, 9) @ table).ravel(), len(vector.array))
        vector.scatter_reverse(la.InsertMode.add)
        owned: NDArray[np.float64] = vector.array[: self._owned]
        return owned
