"""Modes of plans with ψ = 0 on the water beside their plates, to a tolerance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import count as numbered

import numpy as np

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.level_bed.solution import shift_above
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import ClassModes, SymmetryClass, mirrored_classes
from hydroelastic.fem.plan.plan import PlanModel, PlanResolution, PlanSolution, plan_resolution
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.plan.plate_tone import released_limits
from hydroelastic.fem.plan.released import ReleasedModes, ReleasedProblem, released_modes
from hydroelastic.fem.plan.truncation import finer_count
from hydroelastic.fem.progress import Report
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.arrays import FloatArray

_MOST_ATTEMPTS, _MOST_LAYERS = 4, 6
# To know about the highest λ.
_COARSE = 1e-2
# Shapes of a plate, beyond the number of modes, with which modes are sought.
_SPARE = 6
_SEED = 7


@dataclass(frozen=True, kw_only=True)
class _ClassSolution:
    """One class at three resolutions, the pencil and the modes of the last one, λ and errors of their limit."""

    one: SymmetryClass
    plates: tuple[PlanPlate, ...]
    values: tuple[FloatArray, ...]
    errors: FloatArray
    poles: int


def solve_released(
    model: PlanModel,
    *,
    tolerance: float,
    count: int,
    report: Report = lambda _message: None,
) -> PlanSolution:
    """Solve a dimensionless tank whose plates alone move, alike on each process.

    ψ ~ r^{1/2} at their edges, and the error falls like the thickness of the innermost layer: as of the first elastic
    tone, three resolutions give the limit and its error. The last one has a degree and a quarter of the polynomials of
    the plates more, so that it shows their errors too.
    """
    attempts, parities = numbered(1), mirrored_classes(model.mirrors)

    def solve(resolution: PlanResolution) -> PlanSolution:
        report(f"attempt {next(attempts)}: degree {resolution.degree}, {resolution.layers} layers and more")
        found = list(filter(None, (_solved_class(model, resolution, parity, count) for parity in parities)))
        ordered = sorted(
            (float(value), number, place)
            for number, one in enumerate(found)
            for place, value in enumerate(one.one.modes.eigenvalues)
        )[: count + 1]
        modes = ClassModes(
            classes=tuple(one.one for one in found),
            eigenvalues=np.array([value for value, _, _ in ordered]),
            origins=tuple((number, place) for _, number, place in ordered),
        )
        shift = shift_above(modes.eigenvalues)
        return PlanSolution(
            modes=modes,
            plates={one.one.parity: one.plates for one in found},
            errors=np.array([[found[number].errors[place] for _, number, place in ordered]]),
            counted=all(len({int(np.sum(values < shift)) for values in one.values[1:]}) == 1 for one in found),
            sizes={
                "problems": len(found),
                "degree": resolution.degree + 1,
                "layers": resolution.layers + 2,
                "poles": max((one.poles for one in found), default=0),
            },
            count_method="a second start",
        )

    coarse = [
        _values(model, plan_resolution(model.tank, _COARSE, 1.0, released=True), parity, count) for parity in parities
    ]
    highest = np.sort(np.concatenate(coarse))[:count].max(initial=0.0)
    return adaptive_solve(
        plan_resolution(model.tank, tolerance, float(highest), released=True),
        solve,
        lambda solution: ErrorEstimate(
            discretization=float(solution.relative_errors[:count].max(initial=0.0)), missing=int(not solution.counted)
        ),
        lambda resolution, _: (
            replace(resolution, layers=resolution.layers + 1, degree=resolution.degree + 1)
            if resolution.layers < _MOST_LAYERS
            else None
        ),
        tolerance,
        rounds=_MOST_ATTEMPTS,
    ).solution


def _values(model: PlanModel, resolution: PlanResolution, parity: ClassParity, count: int) -> FloatArray:
    if model.problem(resolution, parity)[0] is None:
        return np.empty(0)
    return _lowest(model.released(resolution, parity), count, second=False).eigenvalues


def _solved_class(
    model: PlanModel, resolution: PlanResolution, parity: ClassParity, count: int
) -> _ClassSolution | None:
    finest = replace(
        resolution,
        layers=resolution.layers + 2,
        degree=resolution.degree + 1,
        polynomials=tuple(map(finer_count, resolution.polynomials)),
    )
    pencil, plates = model.problem(finest, parity)
    if pencil is None:
        return None
    problem = model.released(finest, parity)
    last = _lowest(problem, count + 1, second=True)
    before = [
        _values(model, replace(resolution, layers=resolution.layers + more), parity, count + 1) for more in (0, 1)
    ]
    values = (*before, last.eigenvalues)
    kept = min(map(len, values))
    limits, errors = released_limits([one[:kept] for one in values], resolution.degree)
    modes = _mode_set(replace(pencil, constraints=()), problem, last, limits)
    return _ClassSolution(
        one=SymmetryClass(parity=parity, pencil=replace(pencil, constraints=()), modes=modes),
        plates=plates,
        values=values,
        errors=errors + last.errors[:kept],
        poles=problem.poles,
    )


def _lowest(problem: ReleasedProblem, count: int, *, second: bool) -> ReleasedModes:
    """The lowest modes, from the softest shapes or from random ones."""
    stiffness = problem.stiffness
    softest = np.argsort(np.where(stiffness > 0.0, stiffness, np.inf))[: int(np.sum(stiffness > 0.0))]
    size = min(count + _SPARE, len(softest))
    start = np.eye(len(stiffness))[softest[:size]]
    if second:
        compliance = np.divide(1.0, stiffness, out=np.zeros_like(stiffness), where=stiffness > 0.0)
        start = np.random.default_rng(_SEED).standard_normal((size, len(stiffness))) * np.sqrt(compliance)
    return released_modes(problem, start, lambda inverses, _: np.argsort(-inverses)[:count])


def _mode_set(pencil: CoupledPencil, problem: ReleasedProblem, found: ReleasedModes, limits: FloatArray) -> ModeSet:
    completed: Callable[[int], Mode] = partial(_completed, pencil, problem, found, limits)
    return ModeSet(
        eigenvalues=limits,
        elastic_amplitudes=found.amplitudes[: len(limits)],
        modes=(),
        completed=completed,
        zero_modes=int(np.sum(problem.stiffness == 0.0)),
        converged=len(limits),
    )


def _completed(
    pencil: CoupledPencil, problem: ReleasedProblem, found: ReleasedModes, limits: FloatArray, place: int
) -> Mode:
    displacement, potential = pencil.coupling.createVecs()
    amplitudes = found.amplitudes[place]
    displacement.array[:] = amplitudes
    potential.set(0.0)
    potential.array[problem.free] = found.potentials[place]
    energy = problem.stiffness * amplitudes**2
    return Mode(
        eigenvalue=float(limits[place]),
        values=displacement.array_r,
        displaced=lambda: displacement,
        shaped=lambda: potential,
        residual=float(np.sqrt(found.errors[place])),
        body_amplitudes=amplitudes,
        energy=energy / energy.sum(),
    )
