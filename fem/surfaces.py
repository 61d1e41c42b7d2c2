"""What floats on the liquid: surface unknowns ζ with a stiffness, a mass and a trace on the liquid's boundary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# A surface's basis functions: points (gdim, n) and the number of the function → values (n,).
Shapes = Callable[[NDArray[np.float64], int], NDArray[np.float64]]


@dataclass(frozen=True, kw_only=True)
class Body:
    """A body that moves in a few shapes of its own: w = Σ aᵢ φᵢ, normal displacement on its wetted surface.

    The shapes are orthogonal in both the stiffness and the mass, as dry modes are.

    Attributes:
        surface: physical name of its wetted surface.
        shapes: the functions φᵢ.
        wavenumber: the largest wavenumber among them; it chooses the quadrature.
        labels: what each function is: "heave", "pitch", "elastic 1", …
        stiffness: generalized stiffness of each function, hydrostatic restoring included, shape (functions,).
        bending_stiffness: the part of it that is strain energy, shape (functions,).
        mass: generalized mass of each function, shape (functions,).
    """

    surface: str
    shapes: Shapes
    wavenumber: float
    labels: tuple[str, ...]
    stiffness: NDArray[np.float64]
    bending_stiffness: NDArray[np.float64]
    mass: NDArray[np.float64]

    @property
    def size(self) -> int:
        """Number of functions."""
        return len(self.labels)


@dataclass(frozen=True, kw_only=True)
class FreeSurface:
    """A liquid surface under gravity: K = ρg∫ηη.

    Attributes:
        surface: its physical name.
        gravity: acceleration, in the units of the model.
    """

    surface: str
    gravity: float
