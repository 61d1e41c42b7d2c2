"""Conversion of the dimensionless unknowns of bodies to motions, masses and forces in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.open_water.basin import OpenBasin
from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.attachments import OutsideForces
from hydroelastic.physics.dofs import Dof, dof_names
from hydroelastic.physics.scales import Scales


@dataclass(frozen=True, kw_only=True)
class MotionScale:
    """Units of the motions of all bodies, per metre of width; those of whole solids have one metre more."""

    units: Scales  # units of the dimensionless problem
    dofs: tuple[Dof, ...]  # degrees of freedom, m motions
    # motions of each body unknown as columns, shape (m, m): the principal motions of a float are combinations of heave
    # and roll where gravity couples these
    turn: np.ndarray
    lengths: np.ndarray  # unit of each motion, shape (m,): the unit of length in m, or 1 for roll in rad

    def masses(self, matrix: np.ndarray, *, errors: bool = False) -> np.ndarray:
        """Convert a matrix of (added) masses, shape (m, m), to kg/m, to kg for roll with heave, to kg m for roll; or
        their errors."""
        return self.units.density * self.units.volume * self.units.length**2 * self._in_motions(matrix, errors=errors)

    def unknown_masses(self, masses: np.ndarray) -> np.ndarray:
        """Convert masses in SI units, shape (m, m), to those of the dimensionless body unknowns."""
        forth = self.turn * self.lengths[:, None]
        unknowns: np.ndarray = (
            forth.T @ masses @ forth / (self.units.density * self.units.volume * self.units.length**2)
        )
        return unknowns

    def stiffnesses(self, matrix: np.ndarray) -> np.ndarray:
        """Convert a matrix of stiffnesses, shape (m, m), to N/m², to N/m for roll with heave, to N for roll."""
        return (
            self.units.density * self.units.gravity * self.units.volume * self.units.length * self._in_motions(matrix)
        )

    def outside(self, forces: OutsideForces) -> OutsideForces:
        """Convert forces from outside on the dimensionless body unknowns to those on the motions in SI units."""
        units = self.units
        drag = units.density * units.gravity * units.volume * units.length / units.frequency**2
        return OutsideForces(
            stiffness=self.stiffnesses(forces.stiffness),
            damping=self.stiffnesses(forces.damping) / units.frequency,
            drag=drag * forces.drag,
            paths=forces.paths @ np.linalg.inv(self.turn * self.lengths[:, None]),
        )

    def forces(self, forces: np.ndarray, *, errors: bool = False) -> np.ndarray:
        """Convert forces per dimensionless elevation, shape (…, body unknowns), to N/m², of moments to N/m, per
        metre; or their errors."""
        unit = self.units.density * self.units.gravity * self.units.volume
        scaled: np.ndarray = unit * (forces @ self._back(errors=errors))
        return scaled

    def amplitudes(self, unknowns: np.ndarray, *, errors: bool = False) -> np.ndarray:
        """Convert motions, or their errors, per dimensionless elevation, shape (…, body unknowns), to m/m, of rotations
        to rad/m."""
        turn = np.abs(self.turn) if errors else self.turn
        scaled: np.ndarray = unknowns @ turn.T * self.lengths / self.units.length
        return scaled

    def _in_motions(self, matrix: np.ndarray, *, errors: bool = False) -> np.ndarray:
        back = self._back(errors=errors)
        moved: np.ndarray = back.T @ matrix @ back
        return moved

    def _back(self, *, errors: bool = False) -> np.ndarray:
        """Body unknowns by a unit of each motion as columns; errors add up."""
        back = np.linalg.inv(self.turn * self.lengths[:, None])
        return np.abs(back) if errors else back


def motion_scale(basin: OpenBasin, bodies: tuple[Body, ...]) -> MotionScale:
    """Return the units of the motions of the bodies of a basin."""
    dofs = dof_names(body.dofs for body in bodies)
    return MotionScale(
        units=basin.units,
        dofs=dofs,
        turn=block_diag(*(body.motions for body in bodies)),
        lengths=np.array([1.0 if dof.is_rotation else basin.units.length for dof in dofs]),
    )
