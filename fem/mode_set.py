"""Natural modes with their shapes, as the solvers return them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.surfaces import Body


@dataclass(frozen=True, kw_only=True)
class Mode:
    """One natural mode with its shape, scaled to unit generalized mass.

    Attributes:
        eigenvalue: λ = ω².
        values: own surface unknowns ζ of this process.
        displaced: returns ζ.
        shaped: returns ψ, its constant included.
        residual: relative residual ‖Kζ − λ(Mζ + (ρC)ᵀψ)‖ / ‖Kζ‖ in the norm of K⁻¹.
        body_amplitudes: the body part of ζ, on every process.
        energy: share in the potential energy: body unknowns one by one, then each surface of the liquids.
    """

    eigenvalue: float
    values: np.ndarray
    displaced: Callable[[], PETSc.Vec]
    shaped: Callable[[], PETSc.Vec]
    residual: float
    body_amplitudes: np.ndarray
    energy: np.ndarray

    @cached_property
    def displacement(self) -> PETSc.Vec:
        """ζ."""
        return self.displaced()

    @cached_property
    def potential(self) -> PETSc.Vec:
        """ψ, its constant included."""
        return self.shaped()


@dataclass(frozen=True, kw_only=True)
class ModeSet:
    """The lowest modes, in ascending order, and how they were found.

    Attributes:
        eigenvalues: λ of all modes found.
        elastic_amplitudes: body part of each mode at unit generalized mass, free rigid motions left out, shape
            (modes, body unknowns).
        modes: the lowest modes with their shapes.
        completed: returns any other mode with its shape, by index, at the cost of one solution of Laplace's equation
            (collective).
        zero_modes: how many motions without stiffness exist (not reported as modes).
        growing: the motions of an unstable float, λ < 0, that grow like e^{√(−λ) t}.
        converged: number of converged eigenpairs.
        eigenvectors: of all modes that SLEPc found, motions without stiffness left out.
        bounds: of the relative error of each λ by the eigen-solver; ``None`` where it is rounding.
    """

    eigenvalues: np.ndarray
    elastic_amplitudes: np.ndarray
    modes: tuple[Mode, ...]
    completed: Callable[[int], Mode]
    zero_modes: int
    converged: int
    growing: tuple[Mode, ...] = ()
    eigenvectors: tuple[PETSc.Vec, ...] = ()
    bounds: np.ndarray | None = None


def bending_fractions(modes: Sequence[Mode], bodies: tuple[Body, ...]) -> np.ndarray:
    """Return the strain energy of bending over the total potential energy, shape (modes,)."""
    bending = np.concatenate([body.bending_stiffness for body in bodies] or [np.empty(0)])
    amplitudes = np.array([mode.body_amplitudes for mode in modes]).reshape(len(modes), len(bending))
    fractions: np.ndarray = amplitudes**2 @ bending / np.array([mode.eigenvalue for mode in modes])
    return fractions
