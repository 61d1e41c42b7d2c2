"""Virtual work of a thread in a stream: contact force, load, reaction of the liquid, inertia.

For all η, μ, ψ

    ∫ (S τ − EI κ_s)·η_s − ∫ q·η − Σ F_k·η(s_k) = 0,    ∫ μ (|r_s| − 1 − S/EA) = 0,
    ∫ κ·ψ + ∫ r_s·ψ_s − [|r_s| t_c·ψ] = 0    (only where the thread bends),

with τ = r_s/|r_s| and the load of the liquid per length without stretch

    q = −w e_z + kn |u_n| u_n + kt |u_t| u_t τ + nv u_n,    u_r = u − v,  u_t = u_r·τ,  u_n = u_r − u_t τ.

The tension is T = S + EI |κ|². The equations are those of any consistent units.

The stream at the thread: velocities and gradients at quadrature points and nodes, updated as the thread moves.

A form sees u(r) as u_k + G_k (r − r_k) about the positions r_k of the last `update`: its value there and its derivative
are exact for every profile, and one compiled form serves them all.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any

import basix.ufl
import numpy as np
import ufl
from dolfinx import fem
from numpy.typing import NDArray

from hydroelastic.fem.kernels import compiled_expression
from hydroelastic.fem.thread.space import ThreadSpace
from hydroelastic.physics.stream import Stream
from hydroelastic.physics.thread import PointLoad, Thread

# Regularization of speeds, of the unit of speed: √(v² + ν²) is differentiable at rest.
_SMOOTHED_SPEED = 1e-8
# Of the unit of length: penalty of the curvature along a clamp.
_STIFF = 1e6


@dataclass(frozen=True)
class ThreadState:
    """Unknowns of a form, or test functions: functions or expressions of UFL."""

    position: Any  # r or η
    force: Any  # S or μ
    curvature: Any = None  # κ or ψ, of a thread that bends


class ThreadForms:
    """Terms of the equations of one thread on one mesh, as UFL forms.

    Args:
        model: the thread, in the units of the space's nodes.
        space: the mesh and its function spaces; all points of `model.loads` must be nodes.

    Attributes:
        model: as given.
        space: as given.
        stream: at the position of the thread, or none in a liquid at rest; to be updated with that position.
        point_force: dead forces at nodes, a function that may be changed.
        dead_force: dead forces of the model at nodes.
    """

    def __init__(self, model: Thread, space: ThreadSpace) -> None:
        self.model, self.space = model, space
        self.stream = None
        if model.stream is not None and (model.drags or model.reactive != "none"):
            self.stream = StreamField(space.mesh, model.dimension, model.stream, space.quadrature_degree)
        loads: dict[float, PointLoad] = {0.0: model.ends[0].load, model.length: model.ends[1].load, **model.loads}
        self.point_force = space.at_nodes({s: load.dead_force for s, load in loads.items()}, space.vectors)
        self.dead_force = self.point_force.copy()
        self._drag = self._at_nodes({s: load.drag for s, load in loads.items()})
        self._mass = self._at_nodes({s: load.mass for s, load in loads.items()})
        self._added_mass = self._at_nodes({s: load.added_mass for s, load in loads.items()})
        self._clamp = None
        clamps = {s: end.clamp for s, end in zip((0.0, model.length), model.ends, strict=True)}
        if model.bends:
            given = {s: clamp for s, clamp in clamps.items() if clamp is not None}
            self._clamp = space.at_nodes(given, space.vectors) if given else None
        self._up = ufl.as_vector([0.0] * (model.dimension - 1) + [1.0])
        self._normal = ufl.FacetNormal(space.mesh)[0]

    def _at_nodes(self, values: dict[float, float]) -> Any:
        given = {s: value for s, value in values.items() if value != 0.0}
        return self.space.at_nodes(given, self.space.scalars) if given else None

    def constant(self, value: float) -> Any:
        """A constant of the forms whose value is not compiled into them."""
        return fem.Constant(self.space.mesh, value)

    def contact_work(self, state: ThreadState, test: ThreadState) -> Any:
        """∫ (S τ − EI κ_s)·η_s."""
        return self.tension_work(state.force * tangent(state.position), state, test)

    def tension_work(self, axial: Any, state: ThreadState, test: ThreadState) -> Any:
        """∫ (N − EI κ_s)·η_s for a given axial vector N."""
        contact = axial
        if self.model.bends:
            contact = contact - self.constant(self.model.flexural_rigidity) * state.curvature.dx(0)
        return ufl.inner(contact, test.position.dx(0)) * self.space.dx

    def stretch(self, state: ThreadState, test: ThreadState) -> Any:
        """∫ μ (|r_s| − 1 − S/EA)."""
        # The same compiled kernel serves extensible and inextensible threads.
        compliance = self.constant(1.0 / self.model.axial_rigidity)
        excess = _length(state.position.dx(0)) - 1.0 - compliance * state.force
        return test.force * excess * self.space.dx

    def bending(self, state: ThreadState, test: ThreadState) -> Any:
        """∫ κ·ψ + r_s·ψ_s − [t_c·ψ]; of a thread that stretches − [(r_s·t_c) t_c·ψ], and κ·t_c = 0 at a clamp."""
        form = (
            ufl.inner(state.curvature, test.curvature) + ufl.inner(state.position.dx(0), test.curvature.dx(0))
        ) * self.space.dx
        if self._clamp is not None:
            along = self._normal * ufl.inner(self._clamp, test.curvature)
            if self.model.axial_rigidity == inf:
                return form - along * self.space.ds
            # r_s has the clamp's direction, whatever its length. This leaves the curvature along the clamp, that of a
            # varying stretch, undetermined: it is set to zero.
            form -= ufl.inner(state.position.dx(0), self._clamp) * along * self.space.ds
            bent = ufl.inner(state.curvature, self._clamp) * ufl.inner(self._clamp, test.curvature)
            form += self.constant(_STIFF) * bent * self.space.ds
        return form

    def _relative(self, position: Any, velocity: Any, *, nodes: bool = False) -> Any:
        if self.stream is None:
            return -velocity
        stream = self.stream.at_nodes(position) if nodes else self.stream.along(position)
        return stream if velocity is None else stream - velocity

    def load_of_weight(self) -> Any:
        """−w e_z."""
        return -self.constant(self.model.weight) * self._up

    def load(self, position: Any, velocity: Any) -> Any:
        """q for the thread's velocity v, which is ``None`` for a thread at rest."""
        model = self.model
        load = self.load_of_weight()
        if model.normal_drag + model.tangential_drag + model.viscous_drag == 0.0:
            return load
        if self.stream is None and velocity is None:
            return load
        rs = position.dx(0)
        tau = rs / _length(rs)
        relative = self._relative(position, velocity)
        along = ufl.inner(relative, tau)
        across = relative - along * tau
        drag = (
            self.constant(model.normal_drag) * _speed(across) * across
            + self.constant(model.tangential_drag) * _speed(along) * along * tau
        )
        if model.stretch_drag == "volume":
            drag = ufl.sqrt(_length(rs)) * drag
        if model.viscous_drag > 0.0:
            drag = drag + self.constant(model.viscous_drag) * across
        return load + drag

    def point_load(self, position: Any, velocity: Any) -> Any:
        """Dead force and drag of the bodies at nodes."""
        if self._drag is None or (self.stream is None and velocity is None):
            return self.point_force
        relative = self._relative(position, velocity, nodes=True)
        return self.point_force + self._drag * _speed(relative) * relative

    def load_work(self, position: Any, velocity: Any, test: Any) -> Any:
        """∫ q·η + Σ F_k·η(s_k)."""
        work = ufl.inner(self.load(position, velocity), test) * self.space.dx
        return work + self.node_work(self.point_load(position, velocity), test)

    def node_work(self, force: Any, test: Any) -> Any:
        """Σ F_k·η(s_k) over the ends, and over the inner nodes if the thread carries bodies there."""
        work = ufl.inner(force, test)
        form = work * self.space.ds
        # Continuous on both sides: the mean is the value.
        return form + ufl.avg(work) * self.space.dS if self.model.loads else form

    def reactive_work(self, position: Any, velocity: Any, test: Any) -> Any:
        """Reaction of the moving liquid besides the inertia of the added mass; ``None`` if `reactive` is "none".

        Lighthill: ∫ G·η_s − (1 − f) [G·η] at free ends with G = ma (W V_n + |V_n|² τ/2), W = u_t, V_n = P(v − u). At
        an end that is free of all constraints and does not bend, τ is the direction of the force on it: with the
        boundary value of r_s the order of convergence drops by half.
        The moving load: −∫ ma (W² τ_s + 2 W P v_s)·η with the jumps of τ at nodes, also that to the direction of the
        force on a free end, + f ma [W V_n·η] there.
        """
        model = self.model
        if model.reactive == "none" or (self.stream is None and velocity is None):
            return None
        mass = self.constant(model.added_mass)
        work = self.reactive_elements(position, velocity, test) + self._reactive_ends(position, velocity, test, mass)
        if model.reactive == "lighthill":
            return work
        tau = tangent(position)
        at_node = ufl.inner(ufl.avg(self._relative(position, velocity, nodes=True)), ufl.avg(tau))
        # Left less right: the outward normals of the two elements.
        jump = tau("+") * self._normal("+") + tau("-") * self._normal("-")
        return work + mass * at_node**2 * ufl.inner(jump, ufl.avg(test)) * self.space.dS

    def reactive_elements(self, position: Any, velocity: Any, test: Any) -> Any:
        """Reactive work within the elements: ∫ G·η_s, or −∫ ma (W² τ_s + 2 W P v_s)·η of the moving load."""
        if self.model.reactive == "lighthill":
            mass = self.constant(self.model.added_mass)
            tau = tangent(position)
            relative = self._relative(position, velocity)
            return ufl.inner(_lighthill(mass, relative, tau), test.dx(0)) * self.space.dx
        return ufl.inner(self.moving_load(position, velocity), test) * self.space.dx

    def moving_load(self, position: Any, velocity: Any) -> Any:
        """−ma (W² τ_s + 2 W P v_s), the load of the added mass that moves along the thread, within elements."""
        tau = tangent(position)
        along = ufl.inner(self._relative(position, velocity), tau)
        load = -self.constant(self.model.added_mass) * along**2 * tau.dx(0)
        if velocity is None:
            return load
        turning = velocity.dx(0) - ufl.inner(velocity.dx(0), tau) * tau
        return load - 2.0 * self.constant(self.model.added_mass) * along * turning

    def _reactive_ends(self, position: Any, velocity: Any, test: Any, mass: Any) -> Any:
        work = 0
        relative = self._relative(position, velocity, nodes=True)
        trace = tangent(position)
        for tag, end in enumerate(self.model.ends, start=1):
            if all(end.held):
                continue
            tau = trace
            pulled = end.load.drag > 0.0 or end.load.dead_force.any()
            if pulled and not self.model.bends and not any(end.held):
                force = self.point_load(position, velocity)
                tau = self._normal * force / _length(force)
            along = ufl.inner(relative, tau)
            if self.model.reactive == "lighthill":
                momentum = -self.constant(1.0 - end.taper) * _lighthill(mass, relative, tau)
            else:
                momentum = self.constant(end.taper) * mass * along * (along * tau - relative)
                momentum -= mass * along**2 * (tau - trace)
            work += self._normal * ufl.inner(momentum, test) * self.space.ds(tag)
        return work

    def inertia(self, position: Any, acceleration: Any, test: Any) -> Any:
        """∫ η·(m + ma P) a + Σ (M_k + M_a,k) η·a."""
        rs = position.dx(0)
        tau = rs / _length(rs)
        across = acceleration - ufl.inner(acceleration, tau) * tau
        total = self.constant(self.model.mass) * acceleration + self.constant(self.model.added_mass) * across
        return ufl.inner(total, test) * self.space.dx + self.carried_inertia(acceleration, test)

    def carried_inertia(self, acceleration: Any, test: Any) -> Any:
        """Σ (M_k + M_a,k) η·a."""
        carried = [part for part in (self._mass, self._added_mass) if part is not None]
        total = sum(carried) if carried else self.constant(0.0)
        return self.node_work(total * acceleration, test)

    def static_residual(self, state: ThreadState, test: ThreadState) -> Any:
        """The equations of a thread at rest, as one form."""
        form = self.contact_work(state, test) - self.load_work(state.position, None, test.position)
        reactive = self.reactive_work(state.position, None, test.position)
        if reactive is not None:
            form -= reactive
        form += self.stretch(state, test)
        return form + self.bending(state, test) if self.model.bends else form


def tangent(position: Any) -> Any:
    """τ = r_s/|r_s|."""
    return position.dx(0) / _length(position.dx(0))


def _length(vector: Any) -> Any:
    return ufl.sqrt(ufl.inner(vector, vector))


def _speed(velocity: Any) -> Any:
    return ufl.sqrt(ufl.inner(velocity, velocity) + _SMOOTHED_SPEED**2)


def _lighthill(mass: Any, relative: Any, tau: Any) -> Any:
    """G = ma (W V_n + |V_n|² τ/2)."""
    along = ufl.inner(relative, tau)
    lag = along * tau - relative
    return mass * (along * lag + 0.5 * ufl.inner(lag, lag) * tau)


class _Places:
    """u and ∂u/∂r at the points of one kind of function space."""

    def __init__(self, mesh: Any, element: Any, shape: tuple[int, ...], points: NDArray[np.float64]) -> None:
        dimension = shape[0]
        self.position = fem.Function(fem.functionspace(mesh, element(shape)))
        self.velocity = fem.Function(self.position.function_space)
        self.gradient = fem.Function(fem.functionspace(mesh, element((dimension, dimension))))
        self._points = points
        # The last position and its expression: creating an expression takes longer than evaluating it.
        self._expression: tuple[Any, Any] = (None, None)

    def update(self, position: Any, stream: Stream) -> None:
        if self._expression[0] is not position:
            self._expression = position, compiled_expression(position, self._points)
        self.position.interpolate(self._expression[1])
        dimension = self.position.function_space.dofmap.bs
        places = self.position.x.array.reshape(-1, dimension)
        points = np.zeros((len(places), 3))
        axes = [0, 2] if dimension == 2 else [0, 1, 2]
        points[:, axes] = places
        self.velocity.x.array[:] = stream.velocity_at(points)[:, axes].ravel()
        self.gradient.x.array[:] = stream.gradient_at(points)[:, axes][:, :, axes].ravel()

    def at(self, position: Any) -> Any:
        return self.velocity + ufl.dot(self.gradient, position - self.position)


class StreamField:
    """The stream about the thread's last position.

    Args:
        mesh: intervals in s.
        stream: u(r).
        quadrature_degree: of the forms that will use it.
    """

    def __init__(self, mesh: Any, dimension: int, stream: Stream, quadrature_degree: int) -> None:
        self.stream = stream
        rule, _ = basix.make_quadrature(basix.CellType.interval, quadrature_degree)

        def quadrature(shape: tuple[int, ...]) -> Any:
            return basix.ufl.quadrature_element("interval", value_shape=shape, degree=quadrature_degree)

        def linear(shape: tuple[int, ...]) -> Any:
            return basix.ufl.element("Lagrange", "interval", 1, shape=shape)

        self._cells = _Places(mesh, quadrature, (dimension,), rule)
        self._nodes = _Places(mesh, linear, (dimension,), np.array([[0.0], [1.0]]))

    def update(self, position: Any) -> None:
        """Evaluate the stream at the position of the thread."""
        self._cells.update(position, self.stream)
        self._nodes.update(position, self.stream)

    def along(self, position: Any) -> Any:
        """u for integrals over elements, linear about the last update."""
        return self._cells.at(position)

    def at_nodes(self, position: Any) -> Any:
        """u for terms at nodes, linear about the last update."""
        return self._nodes.at(position)
