"""Error against cost of each model of a tank in three dimensions, tolerance by tolerance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.level_bed.choice import LevelModel, level_model, models_of
from hydroelastic.fem.level_bed.solution import LevelSolution
from hydroelastic.fem.plan.solve import solve_smallest_model
from hydroelastic.fem.progress import peak_memory
from hydroelastic.modal.plate.closed_forms import exact_frequencies
from hydroelastic.physics.level_tank import LevelTank

# Tolerance of the reference in each model: as many digits as double precision and its finest resolution give.
_FINEST: dict[LevelModel, float] = {"orders": 1e-11, "plan": 1e-8}
# A reference tells errors that are this many times its own.
_TOLD = 3.0


@dataclass(frozen=True, kw_only=True)
class LevelReference:
    """What errors are measured against.

    Attributes:
        name: what it is.
        omega: frequencies, each as often as it occurs, rad/s, shape (modes,).
        uncertainty: its own relative error.
    """

    name: str
    omega: np.ndarray
    uncertainty: float

    @property
    def floor(self) -> float:
        """Errors below it are not significant."""
        return max(_TOLD * self.uncertainty, 1e-12)


@dataclass(frozen=True, kw_only=True)
class LevelRow:
    """One solution of a study.

    Attributes:
        model: how the plan was solved.
        tolerance: requested relative error.
        degree: of ψ.
        layers: at each edge.
        poles: of the depth.
        problems: orders or symmetry classes.
        unknowns: of all problems.
        errors: ω/ω_exact − 1 of the requested frequencies.
        floor: see `LevelReference.floor`.
        estimate: largest estimated error.
        reasons: why the tolerance is not kept.
        seconds: time that it took, s.
        memory: highest resident memory above what was held before, bytes; ``None`` where it is unknown.
    """

    model: LevelModel
    tolerance: float
    degree: int
    layers: int
    poles: int
    problems: int
    unknowns: int
    errors: tuple[float, ...]
    floor: float
    estimate: float
    reasons: tuple[str, ...]
    seconds: float
    memory: int | None

    @property
    def error(self) -> float:
        """Largest relative error."""
        return max(map(abs, self.errors))


def level_reference(tank: LevelTank, modes: int) -> LevelReference:
    """Return a closed form, or the smallest model at its finest tolerance (collective)."""
    exact = exact_frequencies(tank, modes)
    if exact:
        return LevelReference(name=exact[0].formula, omega=np.array([one.omega for one in exact]), uncertainty=0.0)
    model = level_model(tank)
    omega, solution = _frequencies(tank, model, _FINEST[model], modes)
    uncertainty = max((one.relative_error for one in solution.modes), default=0.0)
    return LevelReference(name=f"the model of {model} at {_FINEST[model]:g}", omega=omega, uncertainty=uncertainty)


def level_rows(
    tank: LevelTank, reference: LevelReference, tolerances: Sequence[float], modes: int
) -> Iterator[LevelRow]:
    """Solve in each model that takes the tank, to each tolerance that its reference can judge (collective)."""
    for model in models_of(tank):
        # Forms are compiled before the time is measured.
        _frequencies(tank, model, 1e-2, 1)
        for tolerance in tolerances:
            if tolerance < max(_FINEST[model], reference.uncertainty):
                continue
            start = perf_counter()
            with peak_memory(MPI.COMM_WORLD) as memory:
                omega, solution = _frequencies(tank, model, tolerance, modes)
            size = solution.size
            yield LevelRow(
                model=model,
                tolerance=tolerance,
                degree=size["degree"],
                layers=size["layers"],
                poles=size["poles"],
                problems=size["problems"],
                unknowns=size["dofs"],
                errors=tuple(map(float, omega / reference.omega[: len(omega)] - 1.0)),
                floor=reference.floor,
                estimate=max((one.relative_error for one in solution.modes), default=0.0),
                reasons=solution.reasons,
                seconds=perf_counter() - start,
                memory=memory.peak,
            )


def _frequencies(tank: LevelTank, model: LevelModel, tolerance: float, modes: int) -> tuple[np.ndarray, LevelSolution]:
    """The lowest frequencies, each as often as it occurs, and the solution."""
    solution = solve_smallest_model(tank, tolerance=tolerance, modes=modes, model=model, tones=False)
    omega = [solution.omega(one.mode.eigenvalue) for one in solution.modes for _ in range(one.problem.multiplicity)]
    return np.array(omega[:modes]), solution
