"""The shapes in which a beam moves: dry modes in closed form where it is uniform, else computed ones.

All are orthogonal in the bending energy and in plain ∫wᵢwⱼ, so that the hydrostatic restoring stays diagonal: those of
a stepped or jointed beam are its dry modes with an even mass. Only the mass of one whose sections differ in it couples
them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from hydroelastic.modal.beam.dry_modes import free_free_shape, free_free_shapes, free_free_wavenumber
from hydroelastic.modal.beam.jointed_modes import jointed_modes
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.dofs import FIRST_ELASTIC, Dof

if TYPE_CHECKING:
    from hydroelastic.modal.beam.jointed_modes import JointedModes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class BeamShapes:
    """The first shapes of a beam, ∫wᵢwⱼ = l δᵢⱼ."""

    dofs: tuple[Dof, ...]  # degree of freedom of each
    # +1 or −1: the mirror image of a shape about the middle of its beam is ± a shape of the mirrored beam
    parities: tuple[int, ...]
    deflections: Callable[[Array], Array]  # distances from the left end → w of all shapes, shape (shapes, points)
    # distances from the left end, within the beam, and order 0 … 3 of the derivative → that of all shapes, shape
    # (shapes, points); of free ends
    tabulated: Callable[[Array, int], Array]
    moments: Callable[[Array], Array]  # the same points → bending moments EI w″ of all shapes, shape (shapes, points)
    shears: Callable[[Array], Array]  # the same points → shear forces (EI w″)′, shape (shapes, points)
    bending: Array  # twice the strain energy of each, in units of the beam, shape (shapes,)
    mass: Array  # ∫m wᵢwⱼ, shape (shapes, shapes)
    wavenumber: float  # the largest wavenumber among them, 1/m or dimensionless as the beam


def beam_shapes(beam: Beam, count: int) -> BeamShapes:
    """Return the first shapes of a beam, rigid ones included."""
    return _closed_shapes(beam, count) if beam.is_uniform else _computed_shapes(beam, count)


@lru_cache(maxsize=256)
def _closed_shapes(beam: Beam, count: int) -> BeamShapes:
    alike, rigidity = _alike_shapes(beam.ends == "guided", beam.length, count), beam.flexural_rigidity
    return replace(
        alike,
        dofs=beam.dofs(count),
        moments=lambda x: rigidity * alike.moments(x),
        shears=lambda x: rigidity * alike.shears(x),
        bending=rigidity * alike.bending,
        mass=beam.mass_per_length * alike.mass,
    )


@lru_cache(maxsize=16)
def _alike_shapes(guided: bool, length: float, count: int) -> BeamShapes:
    """The shapes of all uniform beams of one length, with EI = 1 and m = 1."""
    roots = _roots(guided, count)

    def deflections(x: Array) -> Array:
        if guided:
            values = [guided_shape(number, x / length) for number in range(count)]
            return np.array(values, dtype=np.float64).reshape(count, len(x))
        return np.asarray(free_free_shapes(count, x / length), dtype=np.float64)

    def tabulated(x: Array, derivative: int) -> Array:
        values = [free_free_shape(number, np.clip(x / length, 0.0, 1.0), derivative) for number in range(count)]
        return np.asarray(np.array(values).reshape(count, len(x)) / length**derivative, dtype=np.float64)

    return BeamShapes(
        dofs=(),
        parities=tuple(1 - 2 * (number % 2) for number in range(count)),
        deflections=_AtLastPoints(deflections),
        tabulated=tabulated,
        moments=lambda x: tabulated(x, 2),
        shears=lambda x: tabulated(x, 3),
        bending=(roots / length) ** 4 * length,
        mass=np.eye(count) * length,
        wavenumber=float(roots.max(initial=0.0)) / length,
    )


@lru_cache(maxsize=64)
def _roots(guided: bool, count: int) -> Array:
    wavenumber = guided_wavenumber if guided else free_free_wavenumber
    return np.array([wavenumber(number) for number in range(count)])


def _computed_shapes(beam: Beam, count: int) -> BeamShapes:
    modes = uniform_mass_modes(beam, count)
    length = beam.length
    # Exactly diagonal where it is so.
    mass = beam.mass_per_length * np.eye(len(modes.dofs)) if beam.has_uniform_mass else modes.products(beam)
    scale = float(np.sqrt(length))
    return BeamShapes(
        dofs=modes.dofs,
        parities=modes.parities,
        # Lengths in units of the tank end within rounding of each other.
        deflections=_AtLastPoints(lambda x: scale * modes.shapes(np.minimum(x, length))),
        tabulated=lambda x, derivative: scale * modes.shapes(np.clip(x, 0.0, modes.beam.length), derivative),
        moments=lambda x: scale * modes.bending_moments(np.clip(x, 0.0, modes.beam.length)),
        shears=lambda x: scale * modes.shear_forces(np.clip(x, 0.0, modes.beam.length)),
        bending=modes.squared_frequencies * length,
        mass=mass * length,
        wavenumber=float(modes.wavenumbers.max()),
    )


class _AtLastPoints:
    """Keeps the values at the last points: both halves of a symmetric tank ask for them at the same ones."""

    def __init__(self, deflections: Callable[[Array], Array]) -> None:
        self._deflections = deflections
        self._points: Array | None = None
        self._values: Array = np.empty((0, 0))

    def __call__(self, x: Array) -> Array:
        # Also at no points, where a process has none, there are as many shapes.
        if self._points is None or not np.array_equal(x, self._points):
            self._values = self._deflections(x)
            self._points = x.copy()
        return self._values


def uniform_mass_modes(beam: Beam, count: int) -> JointedModes:
    """Dry modes of a stepped or jointed beam as if its mass were 1 everywhere."""
    return jointed_modes(beam.with_uniform_mass(), count)


def first_dry_eigenvalue(beam: Beam) -> float:
    """λ of the first elastic mode of a beam in vacuum."""
    if not beam.is_uniform:
        rigid = 2 + len(beam.hinges)
        return float(jointed_modes(beam, rigid + 1).squared_frequencies[rigid])
    shapes = beam_shapes(beam, 3)
    first = shapes.dofs.index(FIRST_ELASTIC)
    return float(shapes.bending[first] / shapes.mass[first, first])


def first_bending(beam: Beam) -> float:
    """Twice the strain energy of the first elastic shape over ∫w²: EI κ⁴ of a uniform beam."""
    shapes = beam_shapes(beam, 3 + len(beam.hinges))
    return float(shapes.bending[shapes.dofs.index(FIRST_ELASTIC)] / beam.length)


def guided_wavenumber(index: int) -> float:
    """Return κ l = index·π; index 0 is heave."""
    return index * math.pi


def guided_shape(index: int, s: npt.ArrayLike) -> FloatArray:
    """Return cos(index π s), scaled to ∫₀¹ W² ds = 1.

    Args:
        index: 0 heave, 1, 2, … elastic.
        s: z/l along the beam, 0 to 1.

    Returns:
        Values in the shape of ``s``.
    """
    scale = 1.0 if index == 0 else math.sqrt(2.0)
    return scale * np.cos(index * math.pi * np.asarray(s, dtype=np.float64))
