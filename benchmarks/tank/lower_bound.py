"""A bare lower bound: what the ten eigenvalues of our matrices cost if nothing but their factorization and use costs.

Counted are one sparse factorization of A, by the fastest that is at hand, and for each Lanczos step a product with C,
a solution and a product with Cᵀ. Not counted are mesh, assembly, the rest of the iteration, and all that certifies the
result. The number of steps is the one in which the Lanczos method with full reorthogonalization, the best in the space
that these products span, brings the eigenvalues to a tenth of the model's own true error.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank import hydroelastic as hydroelastic_tank
from hydroelastic.benchmarks.tank.bare_pencil import BarePencil
from hydroelastic.benchmarks.tank.cases import MODES, BenchmarkTank, tank_named
from hydroelastic.benchmarks.tank.factorizations import Factorize, available_factorizations
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.scenes.tank.solve import solve_scene

_STRICT = 1e-13
_TRIALS = 3


@dataclass(frozen=True, kw_only=True)
class BareWork:
    """What is to be timed for one pencil.

    Attributes:
        pencil: the matrices.
        steps: how many solutions.
        factorize: the fastest factorization.
        name: of that factorization.
    """

    pencil: BarePencil
    steps: int
    factorize: Factorize
    name: str


@dataclass(frozen=True, kw_only=True)
class Bound:
    """All work of one tank, and the frequencies that it finds, rad/s."""

    work: tuple[BareWork, ...]
    frequencies: tuple[float, ...]


def versions() -> dict[str, str]:
    """What computes."""
    return hydroelastic_tank.versions()


def prepare(case: Case) -> Bound:
    """Solve a case once, and find out what is to be timed."""
    solution = solve_scene(hydroelastic_tank.prepare(case))
    return bound_of(solution, tank_named(case.tank))


def pencils_of(solution: TankSolution) -> tuple[CoupledPencil, ...]:
    """The pencils whose modes together are those of the solution."""
    return tuple(part.pencil for part in solution.field.parts)


def bound_of(solution: TankSolution, tank: BenchmarkTank) -> Bound:
    """What the modes of a solution take at the least."""
    pencils = [BarePencil.of(pencil) for pencil in pencils_of(solution)]
    solvers = [available_factorizations()["SuperLU"](pencil.laplace) for pencil in pencils]
    values = [
        pencil.lowest_modes(solve, MODES, _STRICT).eigenvalues for pencil, solve in zip(pencils, solvers, strict=True)
    ]
    lowest = np.sort(np.concatenate(values))[:MODES]
    frequencies = tuple(solution.omega(value) for value in lowest)
    # λ errs twice as much as ω; a tenth of that.
    tolerance = max(0.2 * float(np.abs(np.array(frequencies) / tank.frequencies - 1.0).max()), _STRICT)
    work = []
    for pencil, solve, own in zip(pencils, solvers, values, strict=True):
        share = int(np.count_nonzero(own <= lowest[-1]))
        steps = pencil.lowest_modes(solve, share, tolerance).solves if share else 0
        work.append(_with_the_fastest(pencil, steps))
    return Bound(work=tuple(work), frequencies=frequencies)


def _with_the_fastest(pencil: BarePencil, steps: int) -> BareWork:
    candidates = [
        BareWork(pencil=pencil, steps=steps, factorize=factorize, name=name)
        for name, factorize in available_factorizations().items()
    ]
    return min(candidates, key=lambda work: min(_seconds(work) for _ in range(_TRIALS)))


def _seconds(work: BareWork) -> float:
    start = time.perf_counter()
    run(work)
    return time.perf_counter() - start


def run(work: BareWork) -> None:
    """One factorization, and the products and solutions of all steps."""
    coupling = work.pencil.coupling
    transposed = coupling.T
    surface = np.ones(coupling.shape[1])
    solve = work.factorize(work.pencil.laplace)
    for _ in range(work.steps):
        transposed @ solve(coupling @ surface)


def solve(bound: Bound) -> Answer:
    """Do all that counts."""
    for work in bound.work:
        run(work)
    names = sorted({work.name for work in bound.work})
    steps = " + ".join(str(work.steps) for work in bound.work)
    return Answer(
        values=bound.frequencies,
        unknowns=sum(work.pencil.unknowns for work in bound.work),
        note=f"{', '.join(names)}, {steps} solutions",
    )
