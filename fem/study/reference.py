"""Reference frequencies of a study: a closed form, or a finer solution with its estimated error."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.tank.error_estimates import frequency_errors
from hydroelastic.fem.tank.field_model import build_mesh
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.resolution import Resolution, initial_resolution
from hydroelastic.modal.tank_estimates import exact_frequencies
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

# Tolerance, stricter than that of any row, that determines dry modes, rings and elements of all rows.
_STRICTEST = 1e-11
# Factor of the number of dry modes, with which the truncation error in rows and reference falls to a sixth.
_MORE_SHAPES = 1.3
# With the degree the discretization error falls and rounding grows: the better of two is taken. Measured on three tanks
# with frequencies known to twelve digits: true errors of 5e-13 to 2e-12, estimated 1.8e-11, nearly all rounding.
_DEGREES = (9, 10)
_FINER = 0.7
_RING_RATIO = 0.5


@dataclass(frozen=True, kw_only=True)
class Reference:
    """Frequencies that count as exact.

    Attributes:
        name: formula, or description of the solution.
        omega: the frequencies, rad/s, ascending.
        uncertainty: their estimated relative error; 0 for a formula.
        parities: symmetry of each mode where the tank was solved as two halves; empty for a formula.
    """

    name: str
    omega: np.ndarray
    uncertainty: float
    parities: tuple[Parity | None, ...] = ()


def finest_resolution(tank: Tank, modes: int) -> Resolution:
    """Return elements, rings and dry modes of a dimensionless tank for a tolerance below that of any row of a study."""
    return initial_resolution(tank, _STRICTEST, modes=modes).with_shapes(_MORE_SHAPES)


def reference_of(physical: Tank, count: int, *, half: bool) -> Reference:
    """The lowest frequencies of a tank by the closed form where there is one, else by a finer solution (collective)."""
    formula, frequencies = exact_frequencies(physical, count)
    if frequencies:
        return Reference(name=formula, omega=np.array(frequencies), uncertainty=0.0)
    finest = finest_resolution(physical.scaled(), count)
    sizes = tuple(_FINER * size for size in finest.surface_sizes)
    finest = replace(finest, surface_sizes=sizes, ring_ratio=_RING_RATIO)
    candidates = [_solved(physical, count, replace(finest, degree=degree), half=half) for degree in _DEGREES]
    return min(candidates, key=lambda candidate: candidate.uncertainty)


def _solved(physical: Tank, count: int, resolution: Resolution, *, half: bool) -> Reference:
    tank = physical.scaled()
    mesh = build_mesh(MPI.COMM_WORLD, tank, resolution, half=half)
    field = solve_field(mesh, tank, resolution, count, half=half)
    indices = list(range(len(field.modes.eigenvalues)))
    modes = [field.modes.completed(index) for index in indices]
    errors = frequency_errors(field, modes, [field.origins[index] for index in indices], resolution, tank).total
    dry_modes = f", {sum(resolution.shapes)} dry modes" if resolution.shapes else ""
    return Reference(
        name=f"degree {resolution.degree} on geometric rings, {field.dofs} unknowns{dry_modes}",
        omega=np.sqrt(field.modes.eigenvalues) * physical.units.frequency,
        uncertainty=float(errors.max()),
        parities=tuple(field.parity(index) for index in indices),
    )
