"""The sweeps of the benchmark: the tank base_s0 over the position of its beam, and over its flexural rigidity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from hydroelastic.benchmarks.cases import Case, Code, Variant
from hydroelastic.benchmarks.tank.cases import MODES, BenchmarkTank, tank_named
from hydroelastic.modal.beam.gravity_added_mass import gravity_tones

# Dry shapes of the reference, whose errors are checked for the tanks of the benchmark with 96; and its highest λ over
# that of the tank base_s0 at its own position.
_SHAPES, _HIGHEST = 64, 8.0


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """Values of one key.

    Attributes:
        key: of the scene.
        values: of it.
        compared: every so many points are compared with exact frequencies.
    """

    key: str
    values: tuple[float, ...]
    compared: int


SWEEPS = {
    "position": Sweep(key="body.1.start", values=tuple(map(float, np.linspace(0.5, 5.5, 40).round(6))), compared=8),
    "stiffness": Sweep(
        key="body.1.flexural_rigidity",
        values=tuple(map(float, np.geomspace(5e2, 5e4, 100).round(6))),
        compared=20,
    ),
}
_DEGREES = (8, 10)
_TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7)
_JOBS: tuple[Variant, ...] = ("one process", "two processes")


@cache
def tanks(sweep: str) -> tuple[BenchmarkTank, ...]:
    """Return the tank at every point, with the frequencies of the tank base_s0, which give the wavelengths."""
    base, asked = tank_named("base_s0"), SWEEPS[sweep]
    if sweep == "position":
        return tuple(replace(base, beam=replace(base.beam, start=value)) for value in asked.values)
    return tuple(replace(base, beam=replace(base.beam, flexural_rigidity=value)) for value in asked.values)


@cache
def exact(sweep: str) -> np.ndarray:
    """Return the lowest ω at the points that are compared, shape (points, modes)."""
    found = []
    for tank in tanks(sweep)[:: SWEEPS[sweep].compared]:
        tones = gravity_tones(tank.beam, tuple(range(_SHAPES)), _HIGHEST * tank.frequencies[-1] ** 2)
        found.append(np.sqrt(tones.squared_frequencies[:MODES]))
    return np.array(found)


def sweep_error(sweep: str, values: tuple[float, ...]) -> float:
    """Largest relative error at the points that are compared, of all frequencies one after the other."""
    frequencies = np.array(values).reshape(-1, MODES)[:: SWEEPS[sweep].compared]
    return float(np.abs(frequencies / exact(sweep) - 1.0).max())


def sweep_cases(sweep: str, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a sweep; a quick run takes one resolution of each code."""
    own: Code = "sweep"
    tolerances, degrees = (_TOLERANCES[1:], _DEGREES[1:]) if quick else (_TOLERANCES, _DEGREES)
    # A moved beam has no mirror plane.
    variant: Variant = "whole" if sweep == "position" else "halves"
    return (
        *(Case(code=own, tank=sweep, variant=jobs, tolerance=tolerance) for jobs in _JOBS for tolerance in tolerances),
        *(Case(code="ngsolve loop", tank=sweep, variant=variant, degree=degree) for degree in degrees),
    )
