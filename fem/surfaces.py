"""Moving boundaries of the liquids: surface unknowns ζ with a stiffness, a mass and a coupling to ψ."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.symmetry import Parity

Shapes = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]
"""Basis functions of a surface: points (gdim, n) and the liquid's outward unit normals there (gdim, n) → normal
displacements (functions, n). A surface between two liquids has a side, and a normal, in each."""


def rigid_shapes(
    displacement: Callable[[Any, NDArray[np.float64]], FloatArray],
    motions: Sequence[Any],
    turn: NDArray[np.float64],
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return normal displacements by combinations of rigid motions, as `Shapes`."""
    outwards = [(displacement(motion, points) * normals).sum(axis=0) for motion in motions]
    shapes: NDArray[np.float64] = turn.T @ np.reshape(outwards, (len(motions), points.shape[1]))
    return shapes


@dataclass(frozen=True, kw_only=True)
class Body:
    """A body with a few shapes, dimensionless: w = Σ aᵢ φᵢ, normal displacement on its wetted surface.

    The shapes are orthogonal in the strain energy and in the whole stiffness, but need not be in the mass.

    Attributes:
        surface: physical name of its wetted surface, in one or both liquids.
        shapes: the functions φᵢ.
        wavenumber: the largest wavenumber among them; it chooses the quadrature.
        dofs: degree of freedom of each function.
        parities: symmetry of each function about the middle of the body.
        stiffness: generalized stiffness of each function, hydrostatic restoring included, shape (functions,).
        bending_stiffness: the part of it that is strain energy, shape (functions,).
        mass: generalized mass, symmetric, shape (functions, functions).
        motions: the functions as columns in the degrees of freedom ``dofs``, shape (functions, functions); the identity
            but for the principal motions of floats.
        singular_points: where the shapes have unbounded slopes, like the square root of the distance; shape (points,
            gdim).
    """

    surface: str
    shapes: Shapes
    wavenumber: float
    dofs: tuple[Dof, ...]
    parities: tuple[Parity, ...]
    stiffness: NDArray[np.float64]
    bending_stiffness: NDArray[np.float64]
    mass: NDArray[np.float64]
    motions: NDArray[np.float64]
    singular_points: NDArray[np.float64] | None = None

    @property
    def size(self) -> int:
        """Number of functions."""
        return len(self.dofs)


@dataclass(frozen=True, kw_only=True)
class LiquidSurface:
    """A surface of a liquid under gravity, or between two: K = (ρ_below − ρ_above) g ∫ηη.

    Attributes:
        surface: its physical name; between two liquids, that of its facets on either side.
        gravity: acceleration, in the units of the model.
        below: index of the layer under it.
        above: index of the layer over it; ``None`` is air.
    """

    surface: str
    gravity: float
    below: int = 0
    above: int | None = None
