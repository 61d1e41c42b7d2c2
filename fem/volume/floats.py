"""Solid floats as bodies of a volume: rigid motions as normal displacements of the wetted surface."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import linear_sum_assignment

from hydroelastic.fem.surfaces import Body, rigid_shapes
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.solid_floats import RigidMotion, SolidFloat
from hydroelastic.physics.symmetry import Parity

# Whether a motion is odd about planes normal to x and to y through the float.
_ODD: dict[RigidMotion, tuple[int, int]] = {
    "surge": (1, 0),
    "sway": (0, 1),
    "heave": (0, 0),
    "roll": (0, 1),
    "pitch": (1, 0),
    "yaw": (1, 1),
}


def float_body(solid: SolidFloat, name: str, parity: ClassParity) -> Body:
    """Return a dimensionless float in its motions of one symmetry."""
    chosen = [
        place
        for place, motion in enumerate(solid.motions)
        if all(wanted in (None, own) for wanted, own in zip(parity, _ODD[motion], strict=True))
    ]
    motions = tuple(solid.motions[place] for place in chosen)
    parities: tuple[Parity, ...] = tuple("antisymmetric" if _ODD[motion][0] else "symmetric" for motion in motions)

    inertia = solid.inertia()[chosen]
    turn = _principal(solid.stiffness()[np.ix_(chosen, chosen)], inertia)

    return Body(
        surface=name,
        shapes=partial(rigid_shapes, solid.displacement, motions, turn),
        wavenumber=0.0,
        dofs=tuple(map(Dof, motions)),
        parities=parities,
        stiffness=np.einsum("im,ij,jm->m", turn, solid.stiffness()[np.ix_(chosen, chosen)], turn),
        bending_stiffness=np.zeros(len(motions)),
        mass=np.diag(np.einsum("im,i,im->m", turn, inertia, turn)),
        motions=turn,
    )


def _principal(stiffness: FloatArray, inertia: FloatArray) -> NDArray[np.float64]:
    """Motions that neither stiffness nor inertia couples, as columns in the given ones.

    Those are the motions of the float alone, without liquid, under its hydrostatic stiffness; each is in the place of
    the one with the largest part of its kinetic energy.
    """
    turn = np.eye(len(inertia))
    coupled = np.flatnonzero(np.abs(stiffness - np.diag(np.diag(stiffness))).any(axis=1))
    if len(coupled):
        _, vectors = eigh(stiffness[np.ix_(coupled, coupled)], np.diag(inertia[coupled]))
        energies = vectors**2 * inertia[coupled, None]
        _, order = linear_sum_assignment(energies, maximize=True)
        vectors = vectors[:, order]
        turn[np.ix_(coupled, coupled)] = vectors / np.diag(vectors)
    return turn
