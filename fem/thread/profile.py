"""Positions, contact forces and tensions along a thread at rest, as plain tables in SI units.

Tested with functions that are discontinuous between elements, the equations give the force with which an element is
pulled at each of its nodes: ∫ (S τ − EI κ_s)·η_s − ∫ q·η = [N·η]. These forces are more accurate, of order 2p, than
the integrand is there; in the same way ∫ κ·ψ + ∫ r_s·ψ_s = [r_s·ψ] gives the tangent of a thread that bends. Between
nodes N follows from N_s = −q. The tension is T = N·τ.

With Lighthill's reaction N − G is in balance, and G follows from N, whose direction is τ; the moving load has lumps at
nodes, where N − ma W² τ is in balance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import basix.ufl
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import assemble_vector
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from hydroelastic.fem.kernels import compiled_expression, compiled_form
from hydroelastic.fem.thread.equilibrium import Equilibrium, Start, in_space
from hydroelastic.fem.thread.forms import ThreadState
from hydroelastic.fem.thread.table import LineTable, gather_elements, line_table
from hydroelastic.physics.thread import Thread

# Samples of the tension on each element to find the smallest one.
_SAMPLES = 16
# The direction of N and the momentum that depends on it: each round is a contraction by ma W²/T.
_MOST_ROUNDS = 100


@dataclass(frozen=True, kw_only=True)
class ThreadProfile:
    """A thread at rest, SI."""

    model: Thread
    nodes: NDArray[np.float64]  # s of the nodes, m, shape (elements + 1,)
    position_table: LineTable  # r, m
    curvature_table: LineTable | None  # κ, 1/m, of a thread that bends
    force: NDArray[np.float64]  # N at both nodes of each element, N, shape (elements, 2, dimension)
    tension: NDArray[np.float64]  # T there, N, shape (elements, 2)
    # the force in balance with the load, N or N − G, as Legendre series on each element, N, shape (elements, terms,
    # dimension)
    balance: NDArray[np.float64]

    def position(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """r in m at s of shape (n,), shape (n, dimension)."""
        return self.position_table.at(s)

    def contact_force(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """N in N at s of shape (n,), shape (n, dimension); beyond s where a load makes it jump."""
        cells = np.clip(np.searchsorted(self.nodes, s, side="right") - 1, 0, len(self.nodes) - 2)
        return self._force_on(cells, s)

    def tension_at(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """T in N at s of shape (n,), shape (n,); beyond s where a load makes it jump."""
        return _tension(self.model, self.contact_force(s), self.position_table.at(s, 1))

    def smallest_tension(self) -> tuple[float, float]:
        """The smallest T of the whole thread, N, and its s, m."""
        starts, sizes = self.nodes[:-1], np.diff(self.nodes)
        parts = np.linspace(0.0, 1.0, _SAMPLES + 1)[1:-1]
        inner = (starts[:, None] + sizes[:, None] * parts).ravel()
        values = np.column_stack(
            [self.tension[:, 0], self.tension_at(inner).reshape(len(starts), -1), self.tension[:, 1]]
        )
        cell, sample = np.unravel_index(np.argmin(values), values.shape)
        best, place = float(values[cell, sample]), float(starts[cell] + sizes[cell] * sample / _SAMPLES)
        if 0 < sample < _SAMPLES:
            step = float(sizes[cell]) / _SAMPLES
            found = minimize_scalar(
                lambda s: self.tension_at(np.array([s]))[0], bounds=(place - step, place + step), method="bounded"
            )
            if found.fun < best:
                return float(found.fun), float(found.x)
        return best, place

    def reactions(self) -> NDArray[np.float64]:
        """Reactions on the ends A and B, N, shape (2, dimension); zero in components that are not held."""
        ends = self.position_table.at(self.nodes[[0, -1]])
        pulls = np.array([-self.force[0, 0], self.force[-1, 1]])
        for index, end in enumerate(self.model.ends):
            carried = end.load.dead_force
            if end.load.drag > 0.0 and self.model.stream is not None:
                velocity = _velocity(self.model, ends[[index]])[0]
                carried = carried + end.load.drag * np.linalg.norm(velocity) * velocity
            pulls[index] = np.where(end.held, pulls[index] - carried, 0.0)
        return pulls

    def end_moments(self) -> NDArray[np.float64]:
        """EI |κ| at A and B, N m, shape (2,)."""
        if self.curvature_table is None:
            return np.zeros(2)
        curvatures = self.curvature_table.at(self.nodes[[0, -1]])
        moments: NDArray[np.float64] = self.model.flexural_rigidity * np.linalg.norm(curvatures, axis=1)
        return moments

    def _force_on(self, cells: NDArray[np.int64], s: NDArray[np.float64]) -> NDArray[np.float64]:
        points = 2.0 * (s - self.nodes[cells]) / np.diff(self.nodes)[cells] - 1.0
        basis = legendre.legvander(points, self.balance.shape[1] - 1)
        balance: NDArray[np.float64] = np.einsum("mi,mik->mk", basis, self.balance[cells])
        if self.model.reactive != "lighthill":
            return balance
        tangents = self.position_table.at(s, 1) if self.model.bends else None
        return _with_momentum(self.model, balance, _velocity(self.model, self.position(s)), tangents)


def thread_profile(equilibrium: Equilibrium) -> ThreadProfile:
    """Evaluate a thread at rest as tables in SI units."""
    model, units, space = equilibrium.model, equilibrium.units, equilibrium.space
    nodes = space.nodes * units.length
    position = line_table(equilibrium.solution, nodes, 0).times(units.length)
    curvature = line_table(equilibrium.solution, nodes, 2).times(1.0 / units.length) if model.bends else None
    pulls, tangents = _nodal(equilibrium)
    pulls *= units.force
    if tangents is None:
        tangents = position.at_ends(derivative=1)
    force, held = pulls, pulls
    if model.reactive != "none" and model.stream is not None:
        velocity = _velocity(model, position.at_ends().reshape(-1, model.dimension)).reshape(pulls.shape)
        if model.reactive == "moving_load":
            held = pulls - _momentum(model, tangents / _size(tangents), velocity)
        force = _with_momentum(model, held, velocity, tangents if model.bends else None)
    load = _load_table(equilibrium) * (units.force / units.length)
    return ThreadProfile(
        model=model,
        nodes=nodes,
        position_table=position,
        curvature_table=curvature,
        force=force,
        tension=_tension(model, force, tangents),
        balance=_balance(held if model.reactive == "lighthill" else force, load, np.diff(nodes)),
    )


def start_from(profile: ThreadProfile) -> Start:
    """Return a start from a solution of the same thread."""
    table, rigidity = profile.curvature_table, profile.model.flexural_rigidity
    if table is None:
        return Start(position=profile.position, force=profile.tension_at)

    def force(s: NDArray[np.float64]) -> NDArray[np.float64]:
        axial: NDArray[np.float64] = profile.tension_at(s) - rigidity * np.sum(table.at(s) ** 2, axis=1)
        return axial

    return Start(position=profile.position, force=force, curvature=table.at)


def _nodal(equilibrium: Equilibrium) -> tuple[NDArray[np.float64], NDArray[np.float64] | None]:
    space, forms, state = equilibrium.space, equilibrium.forms, equilibrium.state
    element = basix.ufl.element("Lagrange", "interval", space.degree, shape=(space.dimension,), discontinuous=True)
    broken = fem.functionspace(space.mesh, element)
    test = ufl.TestFunction(broken)
    work = forms.contact_work(state, ThreadState(test, None))
    work -= ufl.inner(forms.load(state.position, None), test) * space.dx
    if forms.model.reactive != "none" and forms.stream is not None:
        work -= forms.reactive_elements(state.position, None, test)
    pulls = _ends_of_elements(space.mesh, broken, work)
    tangents = None
    if forms.model.bends:
        arc = ufl.inner(state.curvature, test) + ufl.inner(state.position.dx(0), test.dx(0))
        tangents = _ends_of_elements(space.mesh, broken, arc * space.dx)
    return pulls, tangents


def _ends_of_elements(mesh: Any, broken: Any, form: Any) -> NDArray[np.float64]:
    vector = assemble_vector(compiled_form(form))
    owned = mesh.topology.index_map(1).size_local
    size = broken.dofmap.bs
    local = vector.array.reshape(-1, size)[broken.dofmap.list[:owned, :2]]
    vector.destroy()
    values = gather_elements(mesh, local, np.array([[0.0], [1.0]]))
    # Pulled backwards at the first node.
    values[:, 0] *= -1.0
    return values


def _load_table(equilibrium: Equilibrium) -> NDArray[np.float64]:
    space, forms, state = equilibrium.space, equilibrium.forms, equilibrium.state
    load = forms.load(state.position, None)
    if forms.model.reactive == "moving_load" and forms.stream is not None:
        load = load + forms.moving_load(state.position, None)
    points, _ = basix.make_quadrature(basix.CellType.interval, space.quadrature_degree)
    owned = np.arange(space.mesh.topology.index_map(1).size_local, dtype=np.int32)
    local = compiled_expression(load, points).eval(space.mesh, owned)
    return gather_elements(space.mesh, local.reshape(len(owned), len(points), space.dimension), points)


def _balance(held: NDArray[np.float64], load: NDArray[np.float64], sizes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Legendre series from N_s = −q and the values at the nodes; a linear term corrects the residual at the second
    node."""
    count = load.shape[1]
    points, _ = legendre.leggauss(count)
    terms = np.einsum("ij,ejk->eik", np.linalg.inv(legendre.legvander(points, count - 1)), load)
    series: NDArray[np.float64] = -0.5 * sizes[:, None, None] * legendre.legint(terms, lbnd=-1, axis=1)
    series[:, 0] += held[:, 0]
    left = 0.5 * (held[:, 1] - np.sum(series, axis=1))
    series[:, 0] += left
    series[:, 1] += left
    return series


def _tension(model: Thread, force: NDArray[np.float64], tangents: NDArray[np.float64]) -> NDArray[np.float64]:
    along: NDArray[np.float64] = np.sum(force * tangents, axis=-1) / _size(tangents)[..., 0]
    if model.bends:
        return along
    # N has the thread's direction, and is more accurate than r_s.
    return np.copysign(_size(force)[..., 0], along)


def _velocity(model: Thread, points: NDArray[np.float64]) -> NDArray[np.float64]:
    assert model.stream is not None
    axes = [0, 2] if model.dimension == 2 else [0, 1, 2]
    return np.asarray(model.stream.velocity_at(in_space(points))[:, axes], dtype=np.float64)


def _momentum(model: Thread, tangents: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64]:
    along = np.sum(velocity * tangents, axis=-1, keepdims=True)
    if model.reactive == "moving_load":
        return model.added_mass * along**2 * tangents
    lag = along * tangents - velocity
    return model.added_mass * (along * lag + 0.5 * np.sum(lag**2, axis=-1, keepdims=True) * tangents)


def _with_momentum(
    model: Thread,
    balance: NDArray[np.float64],
    velocity: NDArray[np.float64],
    tangents: NDArray[np.float64] | None,
) -> NDArray[np.float64]:
    if tangents is not None:
        return balance + _momentum(model, tangents / _size(tangents), velocity)
    force = balance
    for _ in range(_MOST_ROUNDS):
        before = force
        force = balance + _momentum(model, force / _size(force), velocity)
        if np.max(np.abs(force - before)) <= 1e-14 * np.max(np.abs(force)):
            break
    return force


def _size(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    size: NDArray[np.float64] = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return size
