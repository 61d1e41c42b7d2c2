"""The motion of a thread in a stream, in time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import ceil, inf

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium import Along, Equilibrium, force_scale, in_space, interpolate_part
from hydroelastic.fem.thread.forms import ThreadForms
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd, ThreadMotionError, VectorOfTime
from hydroelastic.fem.thread.motion_results import SLACK, StepHistory, ThreadMotion, at_step_ends, find_slack
from hydroelastic.fem.thread.space import ThreadSpace
from hydroelastic.fem.thread.step import GeneralisedAlpha
from hydroelastic.fem.thread.time_integrator import ExternalActions, TimeIntegrator
from hydroelastic.fem.thread.units import Units
from hydroelastic.fem.thread.vortex_shedding import SheddingLoad
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import Stream
from hydroelastic.physics.thread import Thread

# Of the unit of force: smaller compression at the start is tolerated: it vanishes as the thread turns.
_SLACK_AT_START = 1e-3
# How often a step may be shortened while the thread is slack: shorter folds move faster, and no step resolves them.
_MOST_REJECTED_SLACK = 100

# A step's error is of the third order. Exponents of a controller with proportional and integral part (K. Gustafsson,
# ACM Trans. Math. Softw. 17 (1991) 533).
_PROPORTIONAL, _INTEGRAL = 0.4 / 3.0, 0.7 / 3.0
_SAFETY, _LEAST, _MOST = 0.9, 0.2, 2.0
# First step after a start or a discontinuity, of the longest one; number of halvings at which a step is too short.
_FIRST_PART = 0.125
_HALVINGS = 12


@dataclass(frozen=True, kw_only=True)
class InitialMotion:
    """Positions and velocities at the beginning."""

    # r in m at s of shape (n,) in m, shape (n, dimension); projected to |r_s| = 1 if the thread is inextensible
    position: Along
    velocity: Along | None = None  # r_t in m/s, likewise; ``None`` for a thread at rest


@dataclass
class _TimedStream:
    stream: Stream
    factor: float = 1.0

    @property
    def breaks(self) -> tuple[float, ...]:
        return self.stream.breaks

    def set_factor(self, factor: float) -> None:
        self.factor = factor

    def velocity_at(self, points: FloatArray) -> FloatArray:
        return self.factor * self.stream.velocity_at(points)

    def gradient_at(self, points: FloatArray) -> FloatArray:
        return self.factor * self.stream.gradient_at(points)

    def times(self, factor: float) -> _TimedStream:
        return replace(self, factor=factor * self.factor)


def motion_units(model: Thread) -> Units:
    """The thread's length, the largest force that acts on it, and the time of a transverse wave under that.

    The stream counts with its speed at z = 0; without any force, 1 N.
    """
    speed = 0.0 if model.stream is None else float(np.linalg.norm(model.stream.velocity_at(np.zeros((1, 3)))))
    force = force_scale(model, speed) or 1.0
    inertia = (model.mass + model.added_mass) * model.length + sum(body.mass + body.added_mass for body in model.bodies)
    return Units(length=model.length, force=force, time=float(np.sqrt(inertia * model.length / force)))


def move_thread(
    comm: MPI.Comm,
    model: Thread,
    nodes: NDArray[np.float64],
    start: InitialMotion,
    plan: MotionPlan,
    *,
    degree: int = 2,
) -> ThreadMotion:
    """Solve for the motion of a thread from given positions and velocities."""
    units = motion_units(model)
    space = ThreadSpace(comm, np.asarray(nodes / model.length, dtype=np.float64), degree, model.dimension, model.bends)
    integrator = _make_integrator(model, units, space, plan)
    step, length = integrator.step, units.length
    interpolate_part(step.old_state, 0, start.position, length=length, unit=length)
    if start.velocity is not None:
        interpolate_part(step.old_velocity, 0, start.velocity, length=length, unit=length / units.time)
    return _Run(integrator, units, plan, model.length).go(place=True)


def move_from_rest(equilibrium: Equilibrium, plan: MotionPlan) -> ThreadMotion:
    """Solve for the motion of a thread from rest."""
    model = equilibrium.model
    units = replace(equilibrium.units, time=motion_units(model).time)
    integrator = _make_integrator(model, units, equilibrium.space, plan)
    integrator.step.old_state.x.array[:] = equilibrium.solution.x.array
    return _Run(integrator, units, plan, model.length).go(place=False)


def _make_integrator(model: Thread, units: Units, space: ThreadSpace, plan: MotionPlan) -> TimeIntegrator:
    plan.check(model)
    scaled = units.scaled(model)
    set_factor: Callable[[float], None] = lambda factor: None  # noqa: E731
    if scaled.stream is not None and plan.stream_factor is not None:
        stream = _TimedStream(scaled.stream)
        scaled, set_factor = replace(scaled, stream=stream), stream.set_factor
    forms = ThreadForms(scaled, space)
    factor = plan.stream_factor
    actions = ExternalActions(
        ends=(_scaled_course(plan.ends[0], units), _scaled_course(plan.ends[1], units)),
        stream=None if factor is None else lambda time: factor(time * units.time),
        set_stream=set_factor,
    )
    shedding = None
    if plan.shedding is not None:
        lift = plan.shedding.lift * units.length**3 / (units.force * units.time**2)
        given = replace(plan.shedding, lift=lift, wave_number=plan.shedding.wave_number * units.length)
        shedding = SheddingLoad(forms, given)
    alpha = None if plan.dissipation is None else GeneralisedAlpha(plan.dissipation)
    return TimeIntegrator(forms, actions, alpha=alpha, shedding=shedding)


def _scaled_course(prescribed: PrescribedEnd, units: Units) -> PrescribedEnd:
    def scaled(function: VectorOfTime | None, unit: float) -> VectorOfTime | None:
        if function is None:
            return None
        given = function

        def at(time: float) -> NDArray[np.float64]:
            return np.asarray(np.asarray(given(time * units.time)) / unit, dtype=np.float64)

        return at

    release = None if prescribed.release is None else tuple(time / units.time for time in prescribed.release)
    return PrescribedEnd(
        position=scaled(prescribed.position, units.length), force=scaled(prescribed.force, units.force), release=release
    )


def _fastest_stream(model: Thread, positions: NDArray[np.float64], velocities: NDArray[np.float64]) -> float:
    """The largest speed of the liquid past the thread, of positions and velocities of shape (..., dimension)."""
    past = -in_space(velocities.reshape(-1, model.dimension))
    if model.stream is not None:
        past = past + model.stream.velocity_at(in_space(positions.reshape(-1, model.dimension)))
    return float(np.max(np.linalg.norm(past, axis=1)))


@dataclass
class _Record:
    ends: list[float] = field(default_factory=list)
    energies: list[NDArray[np.float64]] = field(default_factory=list)
    work: list[NDArray[np.float64]] = field(default_factory=list)
    reactions: list[NDArray[np.float64]] = field(default_factory=list)
    tensions: list[NDArray[np.float64]] = field(default_factory=list)
    solutions: list[int] = field(default_factory=list)
    # Tensions and reactions at the start and just after discontinuities, where known, by the number of steps before.
    starts: dict[int, tuple[NDArray[np.float64], NDArray[np.float64]] | None] = field(default_factory=dict)
    # Number of steps before, positions, velocities.
    output: list[tuple[int, NDArray[np.float64], NDArray[np.float64]]] = field(default_factory=list)


class _Run:
    """One motion, in steps that end at all output times and discontinuities."""

    def __init__(self, integrator: TimeIntegrator, units: Units, plan: MotionPlan, length: float) -> None:
        self._integrator, self._units, self._plan, self._length = integrator, units, plan, length
        self._record = _Record()
        self._control = StepControl(plan.step / units.time, plan.tolerance if plan.grid is None else None)
        self._velocity_change, self._rejected, self._rejected_slack = 0.0, 0, 0
        self._rate_age = 0.0

    def go(self, *, place: bool) -> ThreadMotion:
        integrator, unit = self._integrator, self._units.time
        stops, breaks = self._plan.stops()
        wanted = {float(time) for time in self._plan.times}
        integrator.time = float(self._plan.times[0]) / unit
        moved = integrator.project_positions() if place else 0.0
        if moved is None:
            self._fail(
                "there is no thread near the given positions, or its tension is undetermined; give positions with "
                "|r_s| = 1 nearby, and more thread than the distance of its held ends"
            )
        self._begin(velocities_jump=True, check_slack=self._plan.tension_at_start)
        self._record.ends.append(integrator.time)
        self._record.energies.append(integrator.energies())
        self._output()
        still = None
        for stop in stops:
            still = self._reach(stop / unit)
            if stop in breaks and still is None:
                self._begin(velocities_jump=stop in self._plan.breaks)
            if stop in wanted or still is not None:
                self._output()
            if still is not None:
                break
        return self._result(moved * self._length if moved else 0.0, still)

    def _begin(self, *, velocities_jump: bool, check_slack: bool = False) -> None:
        """Consistent velocities, accelerations and tensions at the start, or after a discontinuity."""
        integrator = self._integrator
        if velocities_jump:
            velocity_change = integrator.project_velocities()
            if velocity_change is None:
                self._fail("no impulse of the ends gives the thread the velocities asked for")
            else:
                self._velocity_change = max(self._velocity_change, velocity_change)
        if check_slack and not integrator.forms.model.bends:
            self._refuse_slack()
        tensions = integrator.solve_accelerations()
        if tensions is None:
            self._fail("the accelerations are undetermined; is the thread straight between two held ends?")
        else:
            # The rate of Lighthill's momentum has terms besides that of the acceleration.
            known = integrator.forms.model.reactive != "lighthill"
            steps = len(self._record.work)
            self._record.starts[steps] = (tensions, integrator.start_reactions()) if known else None
        self._control.restart()
        self._rate_age = 0.0

    def _refuse_slack(self) -> None:
        tensions = self._integrator.tension_without_stretch()
        if tensions is None or np.min(tensions) > -_SLACK_AT_START:
            return
        self._fail(
            f"the thread starts slack: to keep its length, it would have to bear {self._worst(tensions)}, and without "
            "bending stiffness it bears no compression; start in a direction in which weight and forces pull it "
            "straight, or give it flexural_rigidity"
        )

    def _worst(self, tensions: NDArray[np.float64]) -> str:
        place = float(self._integrator.forms.space.nodes[np.argmin(tensions)]) * self._length
        return f"{float(np.min(tensions)) * self._units.force:.4g} N at s = {place:.4g} m"

    def _reach(self, stop: float) -> float | None:
        """Take steps up to a time, or to an earlier one at which the thread is at rest."""
        integrator, plan = self._integrator, self._plan
        while stop - integrator.time > 1e-9 * self._control.longest:
            length = self._take(self._next(stop))
            if stop - integrator.time < 1e-9 * length:
                integrator.time = stop
            self._record.ends[-1] = integrator.time
            if (
                plan.rest_speed is not None
                and integrator.largest_velocity() * self._length / self._units.time < plan.rest_speed
            ):
                return integrator.time
        return None

    def _next(self, stop: float) -> float:
        now, grid = self._integrator.time, self._plan.grid
        if grid is None:
            return self._control.next_length(stop - now)
        beyond = grid[grid / self._units.time > now + 1e-9 * self._control.longest]
        return min(stop, float(beyond[0]) / self._units.time if len(beyond) else stop) - now

    def _take(self, length: float) -> float:
        integrator, control, record = self._integrator, self._control, self._record
        while True:
            solutions = integrator.solve_step(length)
            error = inf if solutions is None else 0.0
            if control.adaptive and solutions is not None:
                error = integrator.local_error(length, self._rate_age)
            if solutions is not None and control.is_acceptable(error):
                break
            self._rejected += 1
            length = control.reject(length, error)
            slack = self._slack()
            if slack is not None:
                self._rejected_slack += 1
                if self._rejected_slack > _MOST_REJECTED_SLACK:
                    self._fail(
                        f"the thread is slack, with {self._worst(slack)}: it folds faster than steps can follow, of "
                        f"which {self._rejected_slack} had to be shortened; give it flexural_rigidity, or ask for an "
                        "earlier last time"
                    )
            if control.is_too_short(length):
                self._fail(
                    "Newton's method did not converge in steps however short; look for slack or a fold before this "
                    "time, give the thread flexural rigidity, or refine the mesh"
                )
        tensions, (reactions, end_powers) = integrator.tensions(), integrator.reactions()
        work = length * np.append(integrator.powers(), end_powers.sum())
        integrator.accept(length)
        self._rate_age = 0.5 * length
        record.ends.append(integrator.time)
        record.energies.append(integrator.energies())
        record.work.append(work)
        record.reactions.append(reactions)
        record.tensions.append(tensions)
        record.solutions.append(solutions or 0)
        control.accept(length, error)
        return length

    def _slack(self) -> NDArray[np.float64] | None:
        """Tensions of the last step, if the thread was in compression and has no bending stiffness."""
        tensions = self._record.tensions[-1] if self._record.tensions else None
        if tensions is None or self._integrator.forms.model.bends or np.min(tensions) > -SLACK:
            return None
        return tensions

    def _output(self) -> None:
        self._record.output.append((len(self._record.work), *self._integrator.state()))

    def _fail(self, cause: str) -> None:
        time = self._integrator.time * self._units.time
        raise ThreadMotionError(f"the motion cannot be followed beyond t = {time:.6g} s: {cause}")

    def _result(self, moved: float, still: float | None) -> ThreadMotion:
        units, record, length = self._units, self._record, self._length
        speed, work = length / units.time, units.force * length
        nodes = self._integrator.forms.space.nodes * length
        ends = np.array(record.ends)
        tensions, reactions = (
            at_step_ends(
                ends,
                np.array(middles),
                {step: None if known is None else known[part] for step, known in record.starts.items()},
                self._integrator.force_part,
            )
            for part, middles in enumerate((record.tensions, record.reactions))
        )
        history = StepHistory(
            ends=ends * units.time,
            energies=np.array(record.energies) * work,
            work=np.array(record.work) * work,
            reactions=reactions * units.force,
            tensions=tensions * units.force,
            solutions=np.array(record.solutions),
        )
        rows = [steps for steps, _, _ in record.output]
        positions = np.array([positions for _, positions, _ in record.output])
        velocities = np.array([velocities for _, _, velocities in record.output])
        model = self._integrator.forms.model
        return ThreadMotion(
            times=history.ends[rows],
            nodes=nodes,
            positions=positions * length,
            velocities=velocities * speed,
            tensions=history.tensions[rows],
            force_scale=force_scale(model, _fastest_stream(model, positions, velocities)) * units.force,
            history=history,
            moved=moved,
            velocity_change=self._velocity_change * speed,
            rejected=self._rejected,
            slack=()
            if self._integrator.forms.model.bends
            else find_slack(history.ends, nodes, history.tensions, units.force),
            rest_time=None if still is None else still * units.time,
        )


class StepControl:
    """Lengths of the steps of a time integration.

    Args:
        longest: of all steps.
        tolerance: of a step's error; equal steps without it.

    Attributes:
        longest: as given.
        adaptive: whether there is a tolerance.
    """

    def __init__(self, longest: float, tolerance: float | None) -> None:
        self.longest, self.adaptive = longest, tolerance is not None
        self._tolerance = inf if tolerance is None else tolerance
        self._length, self._last_error = longest, inf
        self.restart()

    def restart(self) -> None:
        """Start anew after a discontinuity, with a short step if steps adapt."""
        self._length = _FIRST_PART * self.longest if self.adaptive else self.longest
        self._last_error = self._tolerance

    def next_length(self, remaining: float) -> float:
        """Return the length of the next step, such that equal ones end at the end of the remaining time."""
        return remaining / max(1, ceil(remaining / self._length * (1.0 - 1e-9)))

    def is_acceptable(self, error: float) -> bool:
        """Whether the error of a step is within the tolerance."""
        return error <= self._tolerance

    def reject(self, length: float, error: float) -> float:
        """Return the length of the repeated step, after one that failed (infinite error) or was not accurate enough."""
        if error == inf:
            self._length = 0.5 * length
        else:
            self._length = length * max(_LEAST, _SAFETY * (self._tolerance / error) ** (1.0 / 3.0))
        return self._length

    def is_too_short(self, length: float) -> bool:
        """Whether a step is so short that the integration is to be given up."""
        return length < self.longest * 0.5**_HALVINGS * (1e-3 if self.adaptive else 1.0)

    def accept(self, length: float, error: float) -> None:
        """Adapt the length after an accepted step."""
        if not self.adaptive:
            # Steps that had to be halved grow again.
            self._length = min(self.longest, 2.0 * length)
            return
        error = max(error, 1e-6 * self._tolerance)
        growth = (self._tolerance / error) ** _INTEGRAL * (self._last_error / error) ** _PROPORTIONAL
        # By the allowed length, which may be longer than the time that was left to the next stop.
        base = max(length, min(self._length, 2.0 * length))
        self._length = min(self.longest, base * min(_MOST, max(_LEAST, _SAFETY * growth)))
        self._last_error = error
