"""What the coupled pencil asks of a liquid, whichever way Laplace's equation is solved.

A liquid is an operator: a load on the moving surfaces → ψ on them. For the unit displacements ζ of the surfaces the
load on ψ is C ζ, a functional on N unknowns of ψ, and

    A ψ = C ζ,    ψ = A⁺ C ζ,    added mass M_a = (ρC)ᵀ A⁺ C,    all dimensionless (ρ = g = 1, lengths in one unit).

The N unknowns need not fill the volume. What the pencil, its modes, errors and counts use of them is only this:

* Volume: polynomials in the liquid, `fem.liquid.LiquidSpace`; A = ∫∇ψ·∇q.
* Surface alone, over a level bed: the unknowns are those of ψ on z = 0, a space V on the plan with K₂ = ∫∇ψ·∇q and
  M₂ = ∫ψq over the plan. With K₂ v = k² M₂ v and vᵀM₂v = 1,

      A⁺ = Σ v vᵀ / (k tanh kH),     A = Σ M₂v (k tanh kH) (M₂v)ᵀ.

* Plan with poles, 1/(k tanh kH) ≈ Σⱼ cⱼ/(k² + dⱼ) with d₀ = 0: the unknowns are one potential ψⱼ on the plan for each
  pole, ψ = Σⱼ cⱼ ψⱼ. Then A is block diagonal, cⱼ (K₂ + dⱼ M₂), C has the blocks cⱼ C₂ upon each other, and (ρC)ᵀψ
  is the whole pressure. Count and condensation hold as they are; "ψ" of a mode is that stack.

The constant: where ψ = 0 nowhere on the boundary of a layer, A has the constant in its null space. A load of nonzero
flux has no answer then; A⁺ takes the flux out of it first, and gives ψ with ∫ψ = 0 over the moving surfaces:

    A⁺ = Πᵀ A⁻¹ Π,    Π b = b − (1ᵀb) s/|s|,    s = ∫q over the moving surfaces, |s| = 1ᵀs

where 1 has ones at the unknowns of that layer which carry the constant: with poles at those of d₀ = 0 only. Such a
layer is told to the pencil as *closed*; it then keeps ∫ζ = 0 itself, and adds the constant to ψ of the modes.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc


class LiquidUnknowns(Protocol):
    """The unknowns of ψ, as the pencil needs to know them.

    Attributes:
        densities: ρ of each layer, from the bottom up.
    """

    @property
    def densities(self) -> tuple[float, ...]:
        """Density ρ of each layer, from the bottom up."""

    @property
    def size(self) -> int:
        """Number of all unknowns N, those with a prescribed value included."""

    @property
    def owned_layer_of(self) -> np.ndarray:
        """Layer of each unknown that this process owns, shape (owned unknowns,).

        −1 for unknowns that carry no constant of a layer, as those of the poles dⱼ > 0; there is one density then.
        """

    def zero_dofs(self) -> np.ndarray:
        """Owned unknowns, as local indices, at which ψ = 0 is prescribed (collective)."""


class LiquidOperator(Protocol):
    """A⁺.

    Attributes:
        solves: how many loads were answered.
    """

    solves: int

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """``potential`` ← A⁺ ``load``, both on all N unknowns; ``load`` is not changed (collective)."""


def first_dof(liquid: LiquidUnknowns, layer: int, owned: tuple[int, int], comm: MPI.Comm) -> np.ndarray:
    """The first of all unknowns of a layer, as a local index, on the process that owns it; empty elsewhere."""
    own = np.flatnonzero(liquid.owned_layer_of == layer)[:1]
    first, last = owned
    lowest = comm.allreduce(int(own[0]) + first if len(own) else np.iinfo(np.int64).max, op=MPI.MIN)
    return np.array([lowest - first] if first <= lowest < last else [], dtype=np.int32)
