"""Modes that the eigen-solver has missed, sought from another start vector: a count where inertia costs too much."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.added_mass import CondensedKinetics
from hydroelastic.fem.mode_set import ModeSet
from hydroelastic.fem.modes import converged_inverses, krylov_schur
from hydroelastic.fem.pencil import CoupledPencil

# Of the Krylov space, and the part of it that is kept: it grows by a product or two at a time, so that none is in vain.
_VECTORS, _KEPT = 8, 0.9
# Of the random vector; SLEPc begins with another one.
_SEED = 2


def lowest_beyond(pencil: CoupledPencil, modes: ModeSet, tolerance: float) -> float:
    """Return λ of the lowest mode that is orthogonal to some modes, from another start vector (collective).

    A mode that was missed, one of two with the same frequency say, has a part in a random vector.
    """
    from slepc4py import SLEPc

    kinetics = CondensedKinetics(pencil)
    found = len(modes.eigenvectors)
    if found >= pencil.size - len(pencil.constraints) - pencil.zero_mode_count:
        return np.inf
    solver = krylov_schur(pencil, kinetics, 1, tolerance, SLEPc.EPS.Which.LARGEST_REAL)
    solver.setDimensions(1, min(_VECTORS, pencil.size))
    solver.setKrylovSchurRestart(_KEPT)
    solver.setDeflationSpace(list(modes.eigenvectors))
    start = pencil.stiffness.createVecRight()
    start.array[:] = np.random.default_rng([_SEED, start.comm.rank]).standard_normal(start.local_size)
    solver.setInitialSpace([start])
    _, (inverse,) = converged_inverses(solver, 1, tolerance)
    return float(1.0 / inverse) if inverse > 0.0 else np.inf
