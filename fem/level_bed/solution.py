"""The modes of an upright tank with a level bed, whichever way its plan is solved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from hydroelastic.fem.closed_solution import ClosedSolution
from hydroelastic.fem.modes import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.elastic_tone import ElasticTone
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import LevelTank


class PlanProblem(Protocol):
    """One of the problems into which a tank falls: an order, or a symmetry of the plan."""

    @property
    def order(self) -> int | None:
        """Order n of the second direction; ``None`` where it is not separated."""

    @property
    def symmetry(self) -> str:
        """Name of the symmetry of its modes, "" without one."""

    @property
    def multiplicity(self) -> int:
        """Number of independent modes at each of its frequencies."""

    @property
    def pencil(self) -> CoupledPencil[Any]:
        """Its matrices, with energies of the whole tank."""

    @property
    def modes(self) -> ModeSet:
        """Its lowest modes."""

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """Return a mode at places of the plan.

        Args:
            mode: one of its modes.
            x: dimensionless, shape (places,).
            y: likewise.
            second: whether the second one of two modes with the same frequency is meant.
        """


@dataclass(frozen=True, kw_only=True)
class SampledSurface:
    """One mode on the still surface, dimensionless.

    Attributes:
        elevation: ζ upwards, of the plate where there is one, shape (places,).
        wavenumbers: k of the functions of the plan of which ψ consists, shape (functions,).
        potentials: the part of each of them in ψ on the surface, shape (places, functions). Below it decays like
            cosh k(z + H)/cosh kH.
    """

    elevation: FloatArray
    wavenumbers: FloatArray
    potentials: FloatArray

    def potential(self, z: float, depth: float) -> FloatArray:
        """Return ψ at the height z ≤ 0 below the same places, shape (places,)."""
        k = self.wavenumbers
        below: FloatArray = self.potentials @ (
            np.exp(k * z) * (1.0 + np.exp(-2.0 * k * (z + depth))) / (1.0 + np.exp(-2.0 * k * depth))
        )
        return below


@dataclass(frozen=True, kw_only=True)
class LevelMode:
    """One of the lowest modes.

    Attributes:
        problem: to which it belongs.
        mode: with its shape, at unit generalized mass.
        relative_error: estimated, of ω.
    """

    problem: PlanProblem
    mode: Mode
    relative_error: float

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The plates that move in its problem."""
        return self.problem.pencil.bodies


@dataclass(frozen=True, kw_only=True)
class PlateTone:
    """The first elastic tone of one plate.

    Attributes:
        plate: its index.
        order: order of its lowest elastic dry mode; ``None`` where orders are not separated.
        dry: dimensionless λ of that mode.
        squares: ∫W² of its shape over the plate.
        stiffness: its generalized stiffness.
        mass: its generalized mass.
        tone: the mode of largest participation; ``None`` where it is not attributed to one of the modes.
        eigenvalue: its dimensionless λ.
        relative_error: estimated, of its frequency.
        reason: why there is no tone, or "".
        pressure_release: dimensionless λ of the tone with ψ = 0 on the water; ``None`` without water beside the plate.
        pressure_release_error: relative error of that frequency.
    """

    plate: int
    order: int | None
    dry: float
    squares: float
    stiffness: float
    mass: float
    tone: ElasticTone | None = None
    eigenvalue: float | None = None
    relative_error: float | None = None
    reason: str = ""
    pressure_release: float | None = None
    pressure_release_error: float | None = None


@dataclass(frozen=True, kw_only=True)
class LevelSolution(ClosedSolution[LevelTank]):
    """The solution of an upright tank; what it adds to those of all closed tanks.

    Attributes:
        model: how its plan was solved, in words.
        modes: the lowest modes, ascending; two of the same shape but for a turn about the axis are one with the
            multiplicity 2.
        tones: one for each elastic plate.
        zero_modes: motions without stiffness, which are not modes.
        size: numbers of unknowns and the like, by name.
        solves: applications of the liquid operator.
    """

    model: str
    modes: tuple[LevelMode, ...]
    tones: tuple[PlateTone, ...]
    zero_modes: int
    size: dict[str, int]
    solves: int

    @property
    def residual(self) -> float:
        """Largest residual of the modes."""
        return max((one.mode.residual for one in self.modes), default=0.0)
