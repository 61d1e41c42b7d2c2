"""From the dimensionless unknowns of bodies to motions, masses and forces in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.open_water.basin import OpenBasin
from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.dofs import Dof, dof_names
from hydroelastic.physics.scales import Scales


@dataclass(frozen=True, kw_only=True)
class MotionScale:
    """Units of the motions of all bodies.

    Attributes:
        units: of the dimensionless problem.
        dofs: names of the motions.
        turn: body unknowns in these motions, as columns: the principal motions of a float are combinations of
            heave and roll where gravity couples these.
        lengths: unit of each motion: that of length, or 1 for roll in rad.
    """

    units: Scales
    dofs: tuple[Dof, ...]
    turn: np.ndarray
    lengths: np.ndarray

    def masses(self, matrix: np.ndarray) -> np.ndarray:
        """A matrix of (added) masses: kg/m, kg for roll with heave, kg m for roll."""
        return self.units.density * self.units.length**4 * self._in_motions(matrix)

    def unknown_masses(self, masses: np.ndarray) -> np.ndarray:
        """The other way: masses in SI units for the dimensionless body unknowns."""
        forth = self.turn * self.lengths[:, None]
        unknowns: np.ndarray = forth.T @ masses @ forth / (self.units.density * self.units.length**4)
        return unknowns

    def stiffnesses(self, matrix: np.ndarray) -> np.ndarray:
        """A matrix of stiffnesses: N/m², N/m for roll with heave, N for roll."""
        return self.units.density * self.units.gravity * self.units.length**3 * self._in_motions(matrix)

    def forces(self, forces: np.ndarray) -> np.ndarray:
        """Forces (…, body unknowns) by a wave whose elevation is a unit of length, for one of a metre: N/m², N/m."""
        unit = self.units.density * self.units.gravity * self.units.length**2
        scaled: np.ndarray = unit * (forces @ np.linalg.inv(self.turn)) / self.lengths
        return scaled

    def amplitudes(self, unknowns: np.ndarray) -> np.ndarray:
        """Motions (…, body unknowns) by an elevation of a unit of length, for one of a metre: m/m, rad/m."""
        scaled: np.ndarray = unknowns @ self.turn.T * self.lengths / self.units.length
        return scaled

    def _in_motions(self, matrix: np.ndarray) -> np.ndarray:
        back = np.linalg.inv(self.turn * self.lengths[:, None])
        moved: np.ndarray = back.T @ matrix @ back
        return moved


def motion_scale(basin: OpenBasin, bodies: tuple[Body, ...]) -> MotionScale:
    """Units of the bodies of a basin.

    Args:
        basin: the basin.
        bodies: all of its bodies, in their order.
    """
    dofs = dof_names(body.dofs for body in bodies)
    return MotionScale(
        units=basin.units,
        dofs=dofs,
        turn=block_diag(*(body.motions for body in bodies)),
        lengths=np.array([1.0 if dof.is_rotation else basin.units.length for dof in dofs]),
    )
