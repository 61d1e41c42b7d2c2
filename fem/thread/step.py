"""One step of a moving thread: the midpoint rule with the constraint at its end, or generalised alpha.

Unknowns are the mean velocity v̄ = (r₁ − r₀)/Δt, the axial force S in the middle, and the curvature κ₁.

The midpoint rule (J. C. Simo, N. Tarnow, K. K. Wong, Comput. Methods Appl. Mech. Eng. 100 (1992) 63; O. Gonzalez, J.
Nonlinear Sci. 6 (1996) 449), with r_m = (r₀ + r₁)/2 and a = 2 (v̄ − v₀)/Δt, v₁ = 2 v̄ − v₀:

    ∫ η·M(r_m) a + ∫ (S 2 r_m,s/(|r₀,s| + |r₁,s|) − EI κ_m,s)·η_s − ∫ q(r_m, v̄)·η − Σ F_k·η(s_k) = 0,
    ∫ μ (|r₁,s| − 1 − S₁/EA) = 0,    ∫ κ₁·ψ + ∫ r₁,s·ψ_s − [t_c·ψ] = 0,    S = (S₀ + S₁)/2.

The axial force does the work ∫ S (|r₁,s| − |r₀,s|), which equals the growth of ∫ S²/2EA, and is zero if EA is infinite:
without liquid the energy is kept exactly.

Generalised alpha (J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371) takes the equations of `ThreadForms` at
t + (1 − α_f) Δt with the acceleration at t + (1 − α_m) Δt, but |r₁,s| = 1 at the end, and damps frequencies that the
step does not resolve.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Any

import ufl
from dolfinx import fem

from hydroelastic.fem.thread.forms import ThreadForms, ThreadState

# A force per length besides those of the model, by position and velocity.
ExtraLoad = Callable[[Any, Any], Any]


@dataclass(frozen=True)
class Weights:
    """Weights of v̄, v₀ and a₀ in the position, velocity and acceleration of the equations.

    r = r₀ + c v̄,  v = b·(v̄, v₀, a₀),  a = d·(v̄, v₀, a₀).
    """

    position: float  # c
    velocity: tuple[float, float, float]  # b
    acceleration: tuple[float, float, float]  # d


def midpoint_weights(step: float) -> Weights:
    """Return the weights of the midpoint rule."""
    return Weights(0.5 * step, (1.0, 0.0, 0.0), (2.0 / step, -2.0 / step, 0.0))


@dataclass(frozen=True)
class GeneralisedAlpha:
    """Parameters of the method of Chung and Hulbert."""

    radius: float  # spectral radius at infinite frequency, 0 to 1

    @property
    def mass_shift(self) -> float:
        """α_m."""
        return (2.0 * self.radius - 1.0) / (self.radius + 1.0)

    @property
    def force_shift(self) -> float:
        """α_f."""
        return self.radius / (self.radius + 1.0)

    @property
    def gamma(self) -> float:
        """γ of Newmark."""
        return 0.5 - self.mass_shift + self.force_shift

    @property
    def beta(self) -> float:
        """β of Newmark."""
        return 0.25 * (1.0 - self.mass_shift + self.force_shift) ** 2

    def end_acceleration(self, step: float) -> tuple[float, float, float]:
        """a₁ from (v̄, v₀, a₀)."""
        beta = self.beta
        return 1.0 / (beta * step), -1.0 / (beta * step), -(0.5 - beta) / beta

    def end_velocity(self, step: float) -> tuple[float, float, float]:
        """v₁ from (v̄, v₀, a₀)."""
        new = [self.gamma * step * weight for weight in self.end_acceleration(step)]
        return new[0], new[1] + 1.0, new[2] + (1.0 - self.gamma) * step

    def weights(self, step: float) -> Weights:
        """Those of the equations at t + (1 − α_f) Δt."""
        force, mass = self.force_shift, self.mass_shift
        speed = [(1.0 - force) * weight for weight in self.end_velocity(step)]
        rate = [(1.0 - mass) * weight for weight in self.end_acceleration(step)]
        return Weights((1.0 - force) * step, (speed[0], speed[1] + force, speed[2]), (rate[0], rate[1], rate[2] + mass))


class ThreadStep:
    """The equations of a step as forms of UFL.

    Args:
        forms: of the thread, in units of length, force and time.
        conservative: the midpoint rule; otherwise generalised alpha.
        extra: force per length besides that of the model, of position and velocity.

    Attributes:
        unknown: (v̄, S, κ₁), a function of the mixed space.
        before: (r₀, S₀, κ₀).
        speed: v₀, in the part of positions.
        rate: a₀, in the part of positions.
        position: r of the equations.
        velocity: v of the equations.
        residual: the equations.
        tension: T of the equations.
    """

    def __init__(self, forms: ThreadForms, *, conservative: bool, extra: ExtraLoad | None = None) -> None:
        self.forms, self.conservative = forms, conservative
        mixed = forms.space.mixed
        self.unknown, self.old_state, self.old_velocity, self.old_acceleration = (fem.Function(mixed) for _ in range(4))
        self._c, self._step = (fem.Constant(forms.space.mesh, 0.0) for _ in range(2))
        self._b, self._d = ([fem.Constant(forms.space.mesh, 0.0) for _ in range(3)] for _ in range(2))
        parts, old = ufl.split(self.unknown), ufl.split(self.old_state)
        past = (ufl.split(self.old_velocity)[0], ufl.split(self.old_acceleration)[0])
        self._mean, self._old = parts[0], old
        self._force, self._curvature = parts[1], parts[2] if forms.model.bends else None
        self._speed = past[0]
        self.position = old[0] + self._c * parts[0]
        self.velocity = _combine(self._b, (parts[0], *past))
        self.acceleration = _combine(self._d, (parts[0], *past))
        self._end = old[0] + self._step * parts[0]
        tests = ufl.TestFunctions(mixed)
        self._test = ThreadState(tests[0], tests[1], tests[2] if forms.model.bends else None)
        self._extra = extra
        self.residual = self._momentum() + (self._kept() if conservative else self._collocated())
        self.tension = self._force
        if forms.model.bends:
            bend = self._middle_curvature
            self.tension = self._force + forms.constant(forms.model.flexural_rigidity) * ufl.inner(bend, bend)

    def set_weights(self, weights: Weights, step: float) -> None:
        """Set the rule and the length of the step."""
        self._step.value, self._c.value = step, weights.position
        for constants, values in ((self._b, weights.velocity), (self._d, weights.acceleration)):
            for constant, value in zip(constants, values, strict=True):
                constant.value = value

    @property
    def _middle_curvature(self) -> Any:
        return 0.5 * (self._old[2] + self._curvature) if self.conservative else self._curvature

    def _momentum(self) -> Any:
        """Inertia less loads, contact force without the axial part's law."""
        forms, test = self.forms, self._test
        contact = ThreadState(self.position, self._force, self._middle_curvature if forms.model.bends else None)
        form = forms.tension_work(self._axial(), contact, test)
        form -= forms.load_work(self.position, self.velocity, test.position)
        if self._extra is not None:
            form -= ufl.inner(self._extra(self.position, self.velocity), test.position) * forms.space.dx
        return form + self._inertia() - self.liquid_work(test.position)

    def _axial(self) -> Any:
        if not self.conservative:
            return self._force * _tangent(self.position.dx(0))
        lengths = _length(self._old[0].dx(0)) + _length(self._end.dx(0))
        return self._force * 2.0 * self.position.dx(0) / lengths

    def _inertia(self) -> Any:
        forms = self.forms
        own = forms.constant(forms.model.mass) * ufl.inner(self.acceleration, self._test.position)
        return own * forms.space.dx + forms.carried_inertia(self.acceleration, self._test.position)

    def liquid_work(self, test: Any) -> Any:
        """Virtual work of the liquid's inertia, and of its reaction to the flow along the thread."""
        forms, model = self.forms, self.forms.model
        form = -self._added_momentum_rate(test) * forms.space.dx
        work = forms.reactive_work(self.position, self.velocity, test) if model.reactive != "none" else None
        return form if work is None else form + work

    def _added_momentum_rate(self, test: Any) -> Any:
        forms, model = self.forms, self.forms.model
        mass = forms.constant(model.added_mass)
        if model.reactive != "lighthill" or not self.conservative:
            return mass * ufl.inner(_across(self.acceleration, self.position), test)
        # The momentum of the liquid at the end of the step less that at its beginning.
        lag = _across(self._lag(self._end, 2.0 * self._mean - self._speed), self._end)
        lag -= _across(self._lag(self._old[0], self._speed), self._old[0])
        return mass / self._step * ufl.inner(lag, test)

    def _lag(self, position: Any, velocity: Any) -> Any:
        stream = self.forms.stream
        return velocity if stream is None else velocity - stream.along(position)

    def _kept(self) -> Any:
        forms, test = self.forms, self._test
        last = 2.0 * self._force - self._old[1]
        state = ThreadState(self._end, last, self._curvature)
        # Over Δt, so that neither block of the matrix grows as the step falls.
        form = forms.stretch(state, ThreadState(None, test.force / self._step))
        return form + forms.bending(state, test) if forms.model.bends else form

    def _collocated(self) -> Any:
        """Constraints of stretch and curvature at the time of the equations; inextensibility at the end of the step."""
        forms, test = self.forms, self._test
        place = self._end if forms.model.axial_rigidity == inf else self.position
        form = forms.stretch(ThreadState(place, self._force), ThreadState(None, test.force / self._step))
        if not forms.model.bends:
            return form
        return form + forms.bending(ThreadState(self.position, self._force, self._curvature), test)

    def energies(self, weight: Any) -> Any:
        """Kinetic, potential, elastic and bending energy of (r₀, v₀, S₀, κ₀), each times a component of `weight`.

        The potential is that of the weight and of the model's dead forces; the kinetic energy that of the thread and of
        what it carries, without liquid. By generalised alpha S₀ is that of the last equations, before the step's end.
        """
        forms, model = self.forms, self.forms.model
        position, speed = self._old[0], self._speed
        dx = forms.space.dx
        kinetic, potential, elastic, bending = weight
        form = 0.5 * forms.constant(model.mass) * ufl.inner(speed, speed) * kinetic * dx
        form += forms.carried_inertia(0.5 * speed, kinetic * speed)
        form += forms.constant(model.weight) * position[model.dimension - 1] * potential * dx
        form -= forms.node_work(forms.dead_force, potential * position)
        if model.axial_rigidity < inf:
            form += 0.5 / forms.constant(model.axial_rigidity) * self._old[1] ** 2 * elastic * dx
        if model.bends:
            form += 0.5 * forms.constant(model.flexural_rigidity) * ufl.inner(self._old[2], self._old[2]) * bending * dx
        return form

    def powers(self, weight: Any) -> Any:
        """Mean powers of drag, of the liquid's inertia, and of changes of the dead forces, each times its `weight`."""
        forms = self.forms
        drag, liquid, force = weight
        mean = self._mean
        weightless = forms.load(self.position, self.velocity) - forms.load_of_weight()
        if self._extra is not None:
            weightless += self._extra(self.position, self.velocity)
        form = ufl.inner(weightless, mean) * drag * forms.space.dx
        carried = forms.point_load(self.position, self.velocity) - forms.point_force
        form += forms.node_work(carried, drag * mean) + self.liquid_work(liquid * mean)
        return form + forms.node_work(forms.point_force - forms.dead_force, force * mean)


def _combine(weights: Any, values: Any) -> Any:
    first, *rest = (weight * value for weight, value in zip(weights, values, strict=True))
    return sum(rest, first)


def _length(vector: Any) -> Any:
    return ufl.sqrt(ufl.inner(vector, vector))


def _tangent(slope: Any) -> Any:
    return slope / _length(slope)


def _across(vector: Any, position: Any) -> Any:
    tau = _tangent(position.dx(0))
    return vector - ufl.inner(vector, tau) * tau
