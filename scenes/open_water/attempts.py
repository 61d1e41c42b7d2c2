"""Solve at a resolution, judge, refine where the error comes from, and keep the best of a few attempts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from hydroelastic.fem.memory import hand_back_memory
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, refined
from hydroelastic.fem.tank.resolution import Resolution, sharpest_exponent, workable_tolerance
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.basin import open_basin
from hydroelastic.scenes.open_water.model import Band, first_resolution

Result = TypeVar("Result")

_MOST_ATTEMPTS = 4


@dataclass(frozen=True, kw_only=True)
class Attempt(Generic[Result]):
    """A result and what it says of itself.

    Attributes:
        result: it.
        causes: its errors by cause.
        resolution: that it was found with.
    """

    result: Result
    causes: FrequencyErrors
    resolution: Resolution

    @property
    def error(self) -> float:
        """The largest error."""
        return float(self.causes.total.max(initial=0.0))


def attempted(
    solve: Callable[[Resolution], Attempt[Result]], first: Resolution, tolerance: float, exponent: float
) -> Attempt[Result]:
    """The first attempt that keeps the tolerance, or the best of a few (collective).

    Args:
        solve: solves at a resolution.
        first: where to start.
        tolerance: asked relative error.
        exponent: α of ψ ~ r^α at the sharpest tips.
    """
    resolution: Resolution | None = first
    best: Attempt[Result] | None = None
    for _ in range(_MOST_ATTEMPTS):
        if resolution is None:
            break
        attempt = solve(resolution)
        hand_back_memory()
        if best is None or attempt.error < best.error:
            best = attempt
        if attempt.error <= tolerance:
            break
        resolution = refined(resolution, attempt.causes, tolerance, exponent=exponent, own_mesh=True)
    assert best is not None
    return best


def attempted_over(scene: TankScene, band: Band, solve: Callable[[Resolution], Attempt[Result]]) -> Attempt[Result]:
    """The best of a few attempts over a range of frequencies, from the resolution that it needs (collective).

    Args:
        scene: with open ends.
        band: the frequencies.
        solve: solves at a resolution.
    """
    tank = open_basin(scene, band.wavenumbers(scene)[1]).tank
    return attempted(
        solve,
        first_resolution(scene, band),
        workable_tolerance(scene.accuracy.tolerance, tank.depth),
        sharpest_exponent(tank, released=False),
    )
