"""Modes of a box with rectangular plates to a tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count as numbered
from itertools import product

import numpy as np

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.level_bed.resolution import expected_eigenvalue
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.box_pencil import BoxLiquid, box_pencil, plate_loads, water_columns, water_masses
from hydroelastic.fem.plan.box_resolution import BoxResolution, axis_space, box_resolution
from hydroelastic.fem.plan.classes import ClassModes, SymmetryClass, count_is_confirmed, merged_errors, solve_classes
from hydroelastic.fem.plan.rectangle_body import AxisParity, ClassParity, RectangleBody, rectangle_body, rectangle_of
from hydroelastic.fem.plan.released import ReleasedProblem
from hydroelastic.fem.plan.released_box import released_box
from hydroelastic.fem.plan.truncation import finer_count, rectangle_energies
from hydroelastic.fem.progress import Report
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Rectangle
from hydroelastic.physics.tank import ROUND_OFF

_MOST_ATTEMPTS = 6
# Measured: the finer answer shows 0.98 to 1 of the error.
_SAFETY = 1.3
# Relative rounding of frequencies without and with elastic plates, measured; the stiffest shape of a plate is 10⁹
# times as stiff as the softest.
_ROUNDING, _ROUNDING_OF_PLATES = 3e-13, 5e-11


@dataclass(frozen=True, kw_only=True)
class BoxModel:
    """The problems of a box; see `ClassModel`.

    Attributes:
        tank: the dimensionless box.
    """

    tank: LevelTank

    def problem(
        self, resolution: BoxResolution, parity: ClassParity
    ) -> tuple[CoupledPencil[BoxLiquid] | None, tuple[RectangleBody, ...]]:
        """See `ClassModel.problem`."""
        return box_problem(self.tank, resolution, parity)

    def released(self, resolution: BoxResolution, parity: ClassParity) -> ReleasedProblem:
        """See `ClassModel.released`."""
        return released_box(_liquid(self.tank, resolution, parity), _bodies(self.tank, resolution, parity))

    def errors(
        self, resolution: BoxResolution, one: SymmetryClass, plates: tuple[RectangleBody, ...], modes: list[Mode]
    ) -> np.ndarray:
        """See `ClassModel.errors`: by the liquid and by the plates."""
        return np.array(
            [_liquid_errors(self.tank, resolution, one, plates, modes), _plate_errors(self.tank, one, plates, modes)]
        )

    def refined(self, resolution: BoxResolution, errors: np.ndarray, tolerance: float) -> BoxResolution | None:
        """See `ClassModel.refined`."""
        liquid, plates = (float(part.max(initial=0.0)) / (0.5 * tolerance) for part in errors)
        return resolution.refined(liquid, plates)

    def start(self, tolerance: float, eigenvalue: float, *, released: bool = False) -> BoxResolution:
        """See `ClassModel.start`."""
        return box_resolution(self.tank, tolerance, eigenvalue, released=released)


@dataclass(frozen=True, kw_only=True)
class BoxSolution:
    """Modes of a dimensionless box.

    Attributes:
        tank: the tank.
        resolution: the last one.
        modes: the lowest modes of all symmetry classes, one more than asked for.
        plates: the plates in the shapes of each class.
        liquid_errors: relative error of each frequency by the space of ψ, shape (modes,).
        plate_errors: relative error by the polynomials of the plates, shape (modes,).
        counted: whether a coarser model confirms the number of modes.
    """

    tank: LevelTank
    resolution: BoxResolution
    modes: ClassModes
    plates: dict[ClassParity, tuple[RectangleBody, ...]]
    liquid_errors: np.ndarray
    plate_errors: np.ndarray
    counted: bool

    @property
    def sizes(self) -> dict[str, int]:
        """Numbers of its resolution, by name."""
        return {
            "problems": len(self.modes.classes),
            "degree": self.resolution.degree,
            "layers": self.resolution.layers,
            "poles": 0,
        }

    @property
    def relative_errors(self) -> np.ndarray:
        """Estimated relative error of each frequency, shape (modes,)."""
        elastic = any(plate.is_elastic for plate in self.tank.plates)
        errors: np.ndarray = self.liquid_errors + self.plate_errors + (_ROUNDING_OF_PLATES if elastic else _ROUNDING)
        return errors


def symmetries(tank: LevelTank) -> tuple[ClassParity, ...]:
    """Return the classes of a box: both parities along each axis in whose middle all plates lie."""
    assert isinstance(tank.plan, Box)

    def along(axis: int, length: float) -> tuple[AxisParity, ...]:
        middles = [_outline(tank, index).position[axis] for index in range(len(tank.plates))]
        return (0, 1) if all(abs(middle - 0.5 * length) <= ROUND_OFF for middle in middles) else (None,)

    return tuple(product(along(0, tank.plan.length), along(1, tank.plan.width)))


def solve_box(tank: LevelTank, *, tolerance: float, count: int, report: Report = lambda _message: None) -> BoxSolution:
    """Solve a dimensionless box with rectangular plates, alike on each process."""
    attempts, model = numbered(1), BoxModel(tank=tank)

    def solve(resolution: BoxResolution) -> BoxSolution:
        report(f"attempt {next(attempts)}: degree {resolution.degree}, {resolution.layers} layers")
        problems = {parity: model.problem(resolution, parity) for parity in symmetries(tank)}
        pencils = {parity: one for parity, (one, _) in problems.items() if one is not None}
        modes = solve_classes(pencils, count + 1, tolerance)
        liquid, plates = merged_errors(
            modes, 2, lambda one, own: model.errors(resolution, one, problems[one.parity][1], own)
        )
        coarser = resolution.coarser()
        return BoxSolution(
            tank=tank,
            resolution=resolution,
            modes=modes,
            plates={parity: bodies for parity, (_, bodies) in problems.items()},
            liquid_errors=liquid,
            plate_errors=plates,
            counted=count_is_confirmed(modes, lambda parity: box_problem(tank, coarser, parity, dense=True)[0]),
        )

    def refine(resolution: BoxResolution, solution: BoxSolution) -> BoxResolution | None:
        errors = np.array([solution.liquid_errors[:count], solution.plate_errors[:count]])
        return model.refined(resolution, errors, tolerance)

    return adaptive_solve(
        box_resolution(tank, tolerance, expected_eigenvalue(tank, count)),
        solve,
        lambda solution: ErrorEstimate(
            discretization=float(solution.relative_errors[:count].max(initial=0.0)), missing=int(not solution.counted)
        ),
        refine,
        tolerance,
        rounds=_MOST_ATTEMPTS,
    ).solution


def _outline(tank: LevelTank, index: int) -> Rectangle:
    return rectangle_of(tank.plates[index].outline)


def _liquid(tank: LevelTank, resolution: BoxResolution, parity: ClassParity) -> BoxLiquid:
    assert isinstance(tank.plan, Box)
    spaces = []
    for axis, length in enumerate((tank.plan.length, tank.plan.width)):
        edges = [
            _outline(tank, index).position[axis] + sign * 0.5 * _outline(tank, index).size[axis]
            for index in range(len(tank.plates))
            for sign in (-1.0, 1.0)
        ]
        spaces.append(axis_space(resolution, length, tuple(edges), parity[axis]))
    images = 2 ** sum(own is not None for own in parity)
    return BoxLiquid(spaces=(spaces[0], spaces[1]), depth=tank.depth, images=images)


def _bodies(tank: LevelTank, resolution: BoxResolution, parity: ClassParity) -> tuple[RectangleBody, ...]:
    assert isinstance(tank.plan, Box)
    return tuple(
        rectangle_body(tank.plan, index, plate, resolution.polynomials[index], parity)
        for index, plate in enumerate(tank.plates)
    )


def box_problem(
    tank: LevelTank, resolution: BoxResolution, parity: ClassParity, *, dense: bool = False
) -> tuple[CoupledPencil[BoxLiquid] | None, tuple[RectangleBody, ...]]:
    """Return the problem of a symmetry class, ``None`` where nothing moves in it, and the plates in its shapes."""
    bodies = _bodies(tank, resolution, parity)
    liquid = _liquid(tank, resolution, parity)
    return box_pencil(liquid, bodies, waves=tank.top == "free", dense=dense), bodies


def _liquid_errors(
    tank: LevelTank,
    resolution: BoxResolution,
    one: SymmetryClass,
    bodies: tuple[RectangleBody, ...],
    modes: list[Mode],
) -> np.ndarray:
    """Relative error of ω from the added mass that the motion of each mode has in a finer space beyond its own.

    At unit generalized mass the Rayleigh quotient of that motion is λ/(1 + δ), δ the difference of ζᵀM_aζ. The motion
    of the finer mode differs from it by a part of higher order in g k/λ of the waves that the coarser space lacks.
    """
    liquid: BoxLiquid = one.pencil.liquid
    finer = _liquid(tank, resolution.finer(), one.parity)
    embeddings = [fine.embedding(coarse) for fine, coarse in zip(finer.spaces, liquid.spaces, strict=True)]
    moving = [body for body in bodies if body.body.size]
    values = np.array([mode.values for mode in modes]).reshape(len(modes), one.pencil.size)
    *amplitudes, heights = np.split(values, np.cumsum([body.body.size for body in moving]), axis=1)
    loads = np.zeros((len(modes), finer.size))
    for body, own in zip(moving, amplitudes, strict=True):
        loads += plate_loads(finer, body, np.tensordot(own, body.coefficients, 1))
    if one.pencil.surfaces:
        surface = np.zeros((len(modes), liquid.size))
        surface[:, water_columns(water_masses(liquid, bodies))] = heights
        fine = embeddings[0] @ surface.reshape(-1, *liquid.shape) @ embeddings[1].T
        for along, across in water_masses(finer, bodies):
            loads += (along @ fine @ across).reshape(loads.shape)
    answers = finer.answer(loads.reshape(-1, *finer.shape)).reshape(loads.shape)
    added = np.array([(one.pencil.coupling * mode.displacement).dot(mode.potential) for mode in modes])
    return _SAFETY * 0.5 * np.abs((loads * answers).sum(axis=1) - added)


def _plate_errors(
    tank: LevelTank, one: SymmetryClass, bodies: tuple[RectangleBody, ...], modes: list[Mode]
) -> np.ndarray:
    """Relative error of ω from the energy that the plates' polynomials lack."""
    assert isinstance(tank.plan, Box)
    values = np.array([mode.eigenvalue for mode in modes])
    potentials = np.array([mode.potential.array_r for mode in modes])
    errors, first = np.zeros(len(modes)), 0
    for body in bodies:
        last = first + body.body.size
        if body.plate.is_elastic and body.body.size and modes:
            amplitudes = np.array([mode.body_amplitudes[first:last] for mode in modes])
            finer = rectangle_body(
                tank.plan, body.index, body.plate, finer_count(body.coefficients.shape[1]), one.parity
            )
            pressures = potentials @ plate_loads(one.pencil.liquid, finer, finer.coefficients).T
            errors += rectangle_energies(body, finer, amplitudes, values, pressures)
        first = last
    return 0.5 * errors / values
