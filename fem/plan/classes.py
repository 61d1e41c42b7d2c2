"""The lowest modes of a tank whose symmetries leave several problems, merged into one ascending list."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.level_bed.solution import shift_above
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.modes import HIDDEN, solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.second_start import lowest_beyond
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.modal.plate.rectangle import AxisParity, ClassParity
from hydroelastic.physics.arrays import FloatArray

OF_RESIDUALS = 1e-3
"""Of the tolerance, the residual to which modes are solved."""

# Relative residual of what a second start finds: an eigenvalue is as near.
_OF_SECOND_START = 1e-2


def mirrored_classes(mirrors: Mirrors) -> tuple[ClassParity, ...]:
    """Return the symmetry classes of a plan: even and odd about each of its mirror planes."""
    choices: list[tuple[AxisParity, ...]] = [(None,) if mirror is None else (0, 1) for mirror in mirrors]
    return tuple(product(choices[0], choices[1]))


@dataclass(frozen=True, kw_only=True)
class SymmetryClass:
    """The problem of one symmetry, with its modes.

    Attributes:
        parity: about the middle of the tank along x and y.
        pencil: its problem, with energies of the whole tank.
        modes: its lowest modes.
    """

    parity: ClassParity
    pencil: CoupledPencil
    modes: ModeSet

    @property
    def label(self) -> str:
        """What the class is called: xS even and xA odd along x, "" without a symmetry."""
        return "".join(f"{axis}{'SA'[own]}" for axis, own in zip("xy", self.parity, strict=True) if own is not None)

    def folded(self, points: FloatArray, mirrors: Mirrors) -> tuple[FloatArray, FloatArray]:
        """Return points (2, n) on the kept side of mirror planes, and the signs of modes at the given ones, (n,)."""
        places, signs = points.copy(), np.ones(points.shape[1])
        for axis, (mirror, own) in enumerate(zip(mirrors, self.parity, strict=True)):
            if mirror is not None:
                beyond = places[axis] < mirror
                places[axis, beyond] = 2.0 * mirror - places[axis, beyond]
                signs[beyond & (own == 1)] *= -1.0
        return places, signs


@dataclass(frozen=True, kw_only=True)
class ClassProblem:
    """A symmetry class as a problem of the common solution; see `LevelProblem`.

    Attributes:
        symmetry_class: its problem and modes.
    """

    symmetry_class: SymmetryClass

    @property
    def order(self) -> int | None:
        """Orders are not separated."""
        return None

    @property
    def symmetry(self) -> str:
        """Name of the symmetry."""
        return self.symmetry_class.label

    @property
    def multiplicity(self) -> int:
        """Equal frequencies are different modes."""
        return 1

    @property
    def pencil(self) -> CoupledPencil:
        """Its matrices."""
        return self.symmetry_class.pencil

    @property
    def modes(self) -> ModeSet:
        """Its lowest modes."""
        return self.symmetry_class.modes


@dataclass(frozen=True, kw_only=True)
class ClassModes:
    """The modes of all classes.

    Attributes:
        classes: the problems.
        eigenvalues: λ of the lowest modes of all, ascending, shape (modes,).
        origins: index of the class, and index in it, of each mode.
    """

    classes: tuple[SymmetryClass, ...]
    eigenvalues: np.ndarray
    origins: tuple[tuple[int, int], ...]

    @property
    def bounds(self) -> FloatArray:
        """Of the relative error of each λ by the eigen-solver, zero where it is rounding, shape (modes,)."""
        found = (self.classes[number].modes.bounds for number, _ in self.origins)
        places = (place for _, place in self.origins)
        return np.array([0.0 if one is None else one[place] for one, place in zip(found, places, strict=True)])

    def completed(self, index: int) -> Mode:
        """Return a mode with its shape, at unit generalized mass."""
        number, place = self.origins[index]
        return self.classes[number].modes.completed(place)


ClassSolver = Callable[[ClassParity, CoupledPencil, int], ModeSet]
"""Returns some of the lowest modes of a class."""


def solve_classes(
    pencils: dict[ClassParity, CoupledPencil],
    count: int,
    tolerance: float,
    *,
    solve: ClassSolver | None = None,
    shares: dict[ClassParity, int] | None = None,
) -> ClassModes:
    """Solve each class for its share of the modes, and for more where the shares are not enough (collective)."""

    def solve_class(_parity: ClassParity, pencil: CoupledPencil, share: int) -> ModeSet:
        # The error of λ is that of the residual squared.
        return solve_modes(pencil, share, shapes=0, tolerance=max(OF_RESIDUALS * tolerance, 1e-12))

    solve = solve or solve_class
    if not pencils:
        return ClassModes(classes=(), eigenvalues=np.empty(0), origins=())
    alike = count if len(pencils) == 1 else count // len(pencils) + 2
    asked = [alike if shares is None else shares[parity] for parity in pencils]
    classes = [
        SymmetryClass(parity=parity, pencil=pencil, modes=solve(parity, pencil, share))
        for (parity, pencil), share in zip(pencils.items(), asked, strict=True)
    ]
    while True:
        limit = min((float(one.modes.eigenvalues[0]) for one in classes if len(one.modes.eigenvalues)), default=np.inf)
        limit /= HIDDEN
        # A class that gives fewer than requested has no more above rounding.
        reached = [
            min(one.modes.eigenvalues[-1], limit) if len(one.modes.eigenvalues) == share else limit
            for one, share in zip(classes, asked, strict=True)
        ]
        complete = sum(int(np.sum(one.modes.eigenvalues <= min(reached))) for one in classes)
        if complete >= count or min(reached) >= limit:
            break
        short = int(np.argmin(reached))
        asked[short] += max(4, count - complete)
        one = classes[short]
        classes[short] = replace(one, modes=solve(one.parity, one.pencil, asked[short]))
    ordered = sorted(
        (float(value), number, place)
        for number, one in enumerate(classes)
        for place, value in enumerate(one.modes.eigenvalues)
        if value <= limit
    )[:count]
    return ClassModes(
        classes=tuple(classes),
        eigenvalues=np.array([value for value, _, _ in ordered]),
        origins=tuple((number, place) for _, number, place in ordered),
    )


def count_is_confirmed(
    solution: ClassModes, coarse: Callable[[ClassParity], CoupledPencil | None], *, repeated: bool = False
) -> bool:
    """Whether a coarser model of each class has as many modes below the widest of the last gaps (collective).

    Ritz values of the coarser space are not below those of the finer: it has no more modes under any limit, and as many
    where the gap is wider than its error. Its matrices give the number by their inertia, without an iteration.
    """
    values = solution.eigenvalues
    if len(values) < 2:
        return True
    shift = shift_above(values)
    for one in solution.classes:
        pencil = coarse(one.parity)
        assert pencil is not None
        own = int(np.sum(one.modes.eigenvalues < shift))
        found = count_below(pencil, shift)
        if found != own and not (repeated and found < own and count_below(one.pencil, shift) == own):
            return False
    return True


def no_mode_is_beyond(solution: ClassModes) -> bool:
    """Whether a second start finds no further mode of any class below the widest of the last gaps (collective).

    Each eigenvalue found has another one within its residual, so that none is too many.
    """
    shift = shift_above(solution.eigenvalues)
    return all(
        lowest_beyond(one.pencil, one.modes, _OF_SECOND_START) > (1.0 + _OF_SECOND_START) * shift
        for one in solution.classes
    )


def merged_errors(
    solution: ClassModes, causes: int, estimate: Callable[[SymmetryClass, list[Mode]], np.ndarray]
) -> np.ndarray:
    """Return the errors of all modes by cause, shape (causes, modes)."""
    errors = np.zeros((causes, len(solution.origins)))
    for number, one in enumerate(solution.classes):
        own = [index for index, (origin, _) in enumerate(solution.origins) if origin == number]
        if own:
            errors[:, own] = estimate(one, [solution.completed(index) for index in own])
    return errors
