"""The modes of a tank in three dimensions, whichever model it is solved in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from hydroelastic.fem.closed.tones import ElasticTone
from hydroelastic.fem.closed_solution import ClosedSolution
from hydroelastic.fem.kept_tolerance import excess
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import LevelTank

BY_INERTIA = "inertia"
"""What confirms the number of modes: the signs of the pivots of the matrices of a coarser model."""


class LevelProblem(Protocol):
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


@runtime_checkable
class PlanProblem(LevelProblem, Protocol):
    """A problem whose modes are sampled at places of the plan."""

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """Return a mode at places of the plan."""


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
        bodies: those whose amplitudes and energies the mode has.
        mode: with its shape, at unit generalized mass.
        relative_error: estimated, of ω.
    """

    problem: LevelProblem
    bodies: tuple[Body, ...]
    mode: Mode
    relative_error: float


@dataclass(frozen=True, kw_only=True)
class PlateTone:
    """The first elastic tone of one plate.

    Attributes:
        plate: its index.
        order: order of its lowest elastic dry mode; ``None`` where orders are not separated.
        dry: dimensionless λ of that mode; infinite of a plate without mass.
        squares: ∫W² of its shape over the plate.
        stiffness: its generalized stiffness.
        mass: its generalized mass.
        symmetry: name of the symmetry of that mode, "" without one.
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
    symmetry: str = ""
    tone: ElasticTone | None = None
    eigenvalue: float | None = None
    relative_error: float | None = None
    reason: str = ""
    pressure_release: float | None = None
    pressure_release_error: float | None = None


@dataclass(frozen=True, kw_only=True)
class LevelSolution(ClosedSolution[LevelTank]):
    """The solution of a tank in three dimensions; what it adds to those of all closed tanks.

    Attributes:
        model: how it was solved, in words.
        modes: the lowest modes, ascending; two of the same shape but for a turn about the axis are one with the
            multiplicity 2.
        tones: one for each elastic plate.
        zero_modes: motions without stiffness, which are not modes.
        size: numbers of unknowns and the like, by name.
        count_method: what confirms the number of modes, in words.
    """

    model: str
    modes: tuple[LevelMode, ...]
    tones: tuple[PlateTone, ...]
    zero_modes: int
    size: dict[str, int]
    count_method: str = BY_INERTIA

    @property
    def residual(self) -> float:
        """Largest residual of the modes."""
        return max((one.mode.residual for one in self.modes), default=0.0)


def shift_above(eigenvalues: np.ndarray) -> float:
    """Return the middle of the widest of the last gaps between λ, where the number of modes is counted."""
    if len(eigenvalues) < 2:
        return 2.0 * float(eigenvalues[-1]) if len(eigenvalues) else 1.0
    gaps = eigenvalues[1:] / eigenvalues[:-1]
    first = max(0, len(gaps) - 4)
    widest = first + int(np.argmax(gaps[first:]))
    return float(np.sqrt(eigenvalues[widest] * eigenvalues[widest + 1]))


def shortcomings(solution: LevelSolution) -> Iterator[str]:
    """Yield messages on why a solution does not keep the tolerance or is incomplete."""
    tolerance, estimated = solution.tolerance, "has an estimated relative error"
    errors = [one.relative_error for one in solution.modes]
    if errors:
        yield from excess(f"mode {int(np.argmax(errors)) + 1} {estimated}", max(errors), tolerance)
    if not solution.counted:
        yield f"an independent count of the modes by {solution.count_method} disagrees: a mode may be missing"
    for tone in solution.tones:
        plate = f"of plate {tone.plate + 1}"
        if tone.tone is not None and not tone.tone.certain:
            yield f"the first elastic tone {plate} may lie above the modes computed"
        yield from excess(f"the first elastic tone {plate} {estimated}", tone.relative_error, tolerance)
        # In boxes and plans it is a companion of fewer digits, told with its error.
        if tone.order is not None:
            yield from excess(f"the pressure-release tone {plate} {estimated}", tone.pressure_release_error, tolerance)
