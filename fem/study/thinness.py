"""Linearized thin-float condition compared with the exact one: their difference as a float becomes thinner.

The same float is solved with its boundary condition on the contour and on its middle line, for repeatedly halved half
widths; its mass follows from Archimedes' principle. The relative difference of the two models falls

    in ω of heave and its modal mass           like the square of the thinness
    in the added mass at infinite frequency    like the thinness
    in ω of waves in a tank of length L        like half width/L: the thin float displaces no liquid

as expected: the next order of the condition on the middle line is that of the squared thinness, and the added mass over
the mass itself falls like the thinness. See docs, studies.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.study.rates import DIFFERENCE, fitted_slope
from hydroelastic.fem.tank.solve import TankSolution, solve_tank
from hydroelastic.physics.tank import Tank

ASKED = 1e-8
"""Tolerance of both models: far below their difference."""

_WAVES = 2
# Multiple of the uncertainty of both models above which their difference is significant.
_CLEAR = 10.0
_POINTS = 3


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """A value by both models.

    Attributes:
        thin: value, in its unit in `QUANTITIES`, with the condition on the middle line.
        exact: value with the condition on the contour.
        uncertainty: sum of the estimated relative errors of both.
    """

    thin: float
    exact: float
    uncertainty: float

    @property
    def difference(self) -> float:
        """thin/exact − 1."""
        return self.thin / self.exact - 1.0

    @property
    def is_clear(self) -> bool:
        """Whether the difference is larger than the errors of the solutions."""
        return abs(self.difference) > _CLEAR * self.uncertainty


@dataclass(frozen=True, kw_only=True)
class ThinnessRow:
    """Both models of one float.

    Attributes:
        half_width: half width of the float, m.
        thinness: half width over half height.
        breadth: half width over tank length.
        compared: values by both models, by the name in `QUANTITIES`; without heave if neither model finds it.
        shared: whether heave couples with waves of nearby frequency in one of the models.
    """

    half_width: float
    thinness: float
    breadth: float
    compared: dict[str, Comparison]
    shared: bool


@dataclass(frozen=True, kw_only=True)
class ThinnessRate:
    """An observed rate, difference ~ (half width)^rate.

    Attributes:
        quantity: name in `QUANTITIES`.
        observed: dimensionless rate, fitted to the thinnest three floats whose difference is clear.
        deviation: standard error of the fit.
        expected: rate of theory.
        shared: whether the heave of one of these floats couples with waves of nearby frequency, which affects the rate.
    """

    quantity: str
    observed: float
    deviation: float
    expected: float
    shared: bool

    @property
    def agrees(self) -> bool:
        """Whether it differs by at most a tenth from theory."""
        return abs(self.observed - self.expected) <= DIFFERENCE * self.expected


QUANTITIES: dict[str, tuple[str, float]] = {
    "heave": ("ω of heave, rad/s", 2.0),
    "modal mass": ("modal mass of heave, kg/m", 2.0),
    "added mass": ("added mass at infinite frequency, kg/m", 1.0),
    **{f"wave {number}": (f"ω of wave {number}, rad/s", 1.0) for number in range(1, _WAVES + 1)},
}
"""Compared quantities by name: description, and power of the thinness with which the difference falls."""

OF_HEAVE = ("heave", "modal mass")
"""Quantities of the heave mode, which may couple with waves."""


def thinness_rows(pairs: Iterable[tuple[Tank, Tank]], modes: int) -> Iterator[ThinnessRow]:
    """Solve both models of a float, one width after the other (collective).

    It ends early where a model does not keep its tolerance.

    Args:
        pairs: pairs of tanks in SI units, with one float that only heaves: with the thin and the exact condition.
        modes: number of modes.

    Raises:
        EigenSolverError: if the eigen-solver fails.
        MeshError: if no mesh can be made.
    """
    for pair in pairs:
        thin, exact = (solve_tank(tank, tolerance=ASKED, modes=modes) for tank in pair)
        if thin.reasons or exact.reasons:
            return
        yield _row(thin, exact)


def _row(thin: TankSolution, exact: TankSolution) -> ThinnessRow:
    one, other = _values(thin), _values(exact)
    (body,) = exact.physical.floats.values()
    profile = body.hull.profile
    assert profile is not None
    return ThinnessRow(
        half_width=profile.half_width,
        thinness=profile.half_width / profile.half_height,
        breadth=profile.half_width / exact.physical.length,
        compared={
            name: Comparison(thin=one[name][0], exact=other[name][0], uncertainty=one[name][1] + other[name][1])
            for name in QUANTITIES
            if name in one and name in other
        },
        shared=any(solution.float_modes[0].is_shared for solution in (thin, exact)),
    )


def _values(solution: TankSolution) -> dict[str, tuple[float, float]]:
    """Values in SI units and their estimated relative errors, by the name in `QUANTITIES`; of those that there are."""
    heave, unit = solution.float_modes[0], solution.units.density * solution.units.length**2
    found: dict[str, tuple[float, float]] = {}
    if heave.index is not None:
        error = float(solution.relative_errors[heave.index])
        found["heave"] = solution.omega(float(solution.modes.eigenvalues[heave.index])), error
        found["modal mass"] = heave.modal_mass * unit, error
    if solution.added_mass is not None:
        (body,) = solution.tank.floats
        added = float(solution.added_mass.block(solution.tank, body)[0, 0])
        found["added mass"] = added * unit, solution.added_mass.error
    waves = [index for index in range(len(solution.asked)) if index != heave.index]
    for number, index in enumerate(waves[:_WAVES], 1):
        omega = solution.omega(solution.asked[index].eigenvalue)
        found[f"wave {number}"] = omega, float(solution.relative_errors[index])
    return found


def fitted_thinness(rows: Sequence[ThinnessRow]) -> tuple[ThinnessRate, ...]:
    """Fit the rate of every quantity whose difference is significant for three floats."""
    rates = []
    for quantity, (_, expected) in QUANTITIES.items():
        used = [row for row in rows if quantity in row.compared and row.compared[quantity].is_clear][-_POINTS:]
        if len(used) < _POINTS:
            continue
        slope, deviation = fitted_slope(
            np.log([row.thinness for row in used]), np.log([abs(row.compared[quantity].difference) for row in used])
        )
        shared = quantity in OF_HEAVE and any(row.shared for row in used)
        rates.append(
            ThinnessRate(quantity=quantity, observed=slope, deviation=deviation, expected=expected, shared=shared)
        )
    return tuple(rates)
