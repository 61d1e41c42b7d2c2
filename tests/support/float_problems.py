"""Floats whose motions gravity couples: as plain problems with full matrices, and some that turn over."""

from __future__ import annotations

import numpy as np
from layered_tanks import PlainProblem, layered, rigid

from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shape_loads import shape_loads
from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.motions import MOTIONS
from hydroelastic.physics.symmetry import motion_parity
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene

ALL = "heave sway roll"

# Floats that would turn over, symmetric and not; with two liquids as with one.
UNSTABLE: dict[str, TankScene] = {
    "upright": layered(
        rigid("rectangle", 0.5, ALL, half_width=0.04, half_height=0.1, unstable="solve"),
        densities=(1000.0,),
        depths=(0.4,),
        top="free",
    ),
    "upright between two liquids": layered(
        rigid("rectangle", 0.4, ALL, half_width=0.04, half_height=0.1, unstable="solve")
    ),
    "top-heavy": layered(
        rigid(
            "polygon",
            0.4,
            ALL,
            vertices=((-0.05, -0.1), (0.03, -0.1), (0.06, 0.15), (-0.05, 0.12)),
            centre_of_mass=0.03,
            mass=11.0,
            unstable="solve",
        ),
        densities=(1000.0,),
        depths=(0.4,),
        top="free",
    ),
    "two of them": layered(
        rigid("rectangle", 0.25, ALL, half_width=0.03, half_height=0.1, unstable="solve"),
        rigid("wedge", 0.7, "heave roll", half_width=0.04, half_height=0.12, unstable="solve"),
        depths=(0.3, 0.25),
    ),
}


def raw_problem(scene: TankScene, pencil: CoupledPencil) -> PlainProblem:
    """The plain problem of a float in heave, sway and roll themselves, with their full stiffness."""
    floating = physical_tank(scene).scaled().floats[0]
    count = len(MOTIONS)
    raw = Body(
        surface=pencil.bodies[0].surface,
        shapes=lambda points, normals: np.array(
            [(floating.displacement(motion, points) * normals).sum(axis=0) for motion in MOTIONS]
        ),
        wavenumber=0.0,
        dofs=tuple(map(Dof, MOTIONS)),
        parities=tuple(map(motion_parity, MOTIONS)),
        motions=np.eye(count),
        stiffness=np.zeros(count),
        bending_stiffness=np.zeros(count),
        mass=np.zeros((count, count)),
    )
    plain = PlainProblem(pencil)
    coupling = plain.coupling.tolil()
    coupling[:, :count] = shape_loads(pencil.liquid, raw).T
    plain.coupling = coupling.tocsr()
    plain.stiffness[:count, :count] = floating.stiffness
    plain.mass[:count, :count] = np.diag(floating.inertia)
    layer_of = pencil.liquid.owned_layer_of
    plain.volumes = np.array([plain.coupling[layer_of == layer].sum(axis=0) for layer in np.unique(layer_of)])
    plain.volumes = plain.volumes.reshape(len(plain.volumes), -1)
    return plain
