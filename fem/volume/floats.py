"""Solid floats as bodies of a volume: rigid motions as normal displacements of the wetted surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.plan.rectangle_body import ClassParity
from hydroelastic.fem.surfaces import Body
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
    """Return a dimensionless float in its motions of one symmetry.

    Args:
        solid: the float, in the middle of the axes with a symmetry.
        name: of its wetted surface.
        parity: even (0) or odd (1) about the mirror planes.
    """
    chosen = [
        place
        for place, motion in enumerate(solid.motions)
        if all(wanted in (None, own) for wanted, own in zip(parity, _ODD[motion], strict=True))
    ]
    motions = tuple(solid.motions[place] for place in chosen)
    parities: tuple[Parity, ...] = tuple("antisymmetric" if _ODD[motion][0] else "symmetric" for motion in motions)

    def shape(points: NDArray[np.float64], normals: NDArray[np.float64], number: int) -> NDArray[np.float64]:
        outwards: NDArray[np.float64] = (solid.displacement(motions[number], points) * normals).sum(axis=0)
        return outwards

    return Body(
        surface=name,
        shapes=shape,
        wavenumber=0.0,
        dofs=tuple(map(Dof, motions)),
        parities=parities,
        stiffness=np.asarray(solid.stiffness()[chosen], dtype=np.float64),
        bending_stiffness=np.zeros(len(motions)),
        mass=np.diag(solid.inertia()[chosen]),
        motions=np.eye(len(motions)),
    )
