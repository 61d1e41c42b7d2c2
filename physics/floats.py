"""A rigid float at rest: its hull, inertia and hydrostatic stiffness, in metres or in units of its tank."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import linear_sum_assignment

from hydroelastic.physics.attachments import Matrix
from hydroelastic.physics.bodies import Body
from hydroelastic.physics.dofs import PLACES, Dof, Level, Motion, Turn
from hydroelastic.physics.hulls import Hull
from hydroelastic.physics.hydrostatics import Hydrostatics
from hydroelastic.physics.scales import Scales


@dataclass(frozen=True, kw_only=True)
class RigidFloat(Body):
    """A float at rest, in the frame of the tank."""

    hull: Hull = field()  # its contour in the liquids
    hydrostatics: Hydrostatics  # where it floats, its inertia and stiffness
    level: Level  # at which it floats
    motions: tuple[Motion, ...]  # its free motions, in the order of `PLACES`
    # stiffness of springs to the ground for heave, sway and roll about the centre of mass, in closed tanks: N/m², N/m
    # and N, symmetric; empty without any
    springs: Matrix | tuple[()] = ()

    @property
    def waterplane(self) -> tuple[float, float]:
        """x of its two contact points with the still level, m; the same for a thin float."""
        return self.hull.waterplane

    @property
    def rigid_motions(self) -> tuple[Dof, ...]:
        """Its free motions."""
        return tuple(map(dof_of_motion, self.motions))

    @property
    def _by_place(self) -> dict[int, Dof]:
        return {PLACES[motion]: dof for motion, dof in zip(self.motions, self.rigid_motions, strict=True)}

    @property
    def orders(self) -> tuple[int, ...]:
        """See `Body.orders`: heave does not depend on the azimuth, surge and pitch are of order 1."""
        return tuple(dict.fromkeys(map(azimuthal_order, self.motions)))

    def of_order(self, order: int) -> RigidFloat:
        """See `Body.of_order`."""
        return replace(self, motions=tuple(motion for motion in self.motions if azimuthal_order(motion) == order))

    def zero_stiffness_motions(self) -> Iterator[tuple[Dof, bool]]:
        """A float without springs sways without energy, and rolls without energy if its roll stiffness is zero.

        With free heave, the heave in this roll makes the heave force, and the displaced volume, zero.
        """
        motions = self._by_place
        if 1 in motions and not self.stiffness[1].any():
            yield motions[1], False
        if 2 in motions and self.roll_stiffness == 0.0:
            yield motions[2], 0 not in motions and self.hydrostatics.coupling_stiffness != 0.0

    @property
    def displaces_volume(self) -> bool:
        """Whether one of its motions displaces a net volume."""
        return "heave" in self.motions or ("roll" in self.motions and self.hydrostatics.coupling_stiffness != 0.0)

    def moved(self, shift: float) -> RigidFloat:
        """Return the same float further to the right, m."""
        return replace(self, hull=self.hull.moved(shift), hydrostatics=self.hydrostatics.moved((shift, 0.0)))

    def scaled(self, units: Scales, start: float, end: float) -> RigidFloat:
        """Return the float in other units, between given contact points in these units."""
        # On the axis of a solid the contour goes on to its other half.
        on_axis = start == 0.0 and abs(self.hull.middle) <= self.hull.rounding
        hull = self.hull.scaled(units.length, -end if on_axis else start, end)
        arms, force = np.array([units.length, units.length, 1.0]), units.density * units.gravity * units.volume
        factors = np.outer(arms, arms) / (force * units.length)
        springs = tuple(
            (float(heave), float(sway), float(roll))
            for heave, sway, roll in np.reshape(self.springs, (-1, 3)) * factors[: len(self.springs)]
        )
        return replace(self, hull=hull, hydrostatics=self.hydrostatics.scaled(units), springs=springs)

    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body up to rounding, wherever both float."""
        hull, rest = self.hull, self.hydrostatics
        return (
            isinstance(other, RigidFloat)
            and hull.is_symmetric
            and abs(rest.centre_of_mass[0] - hull.middle) <= hull.rounding
            # Springs that couple heave to sway or roll change their sign in the mirror.
            and self.springs == other.springs
            and not any(self.springs and self.springs[0][1:])
            and (self.motions, self.level) == (other.motions, other.level)
            and hull.is_copy_of(other.hull)
            and abs(rest.radius_of_gyration - other.hydrostatics.radius_of_gyration) <= hull.rounding
            and abs(rest.centre_of_mass[1] - other.hydrostatics.centre_of_mass[1]) <= hull.rounding
        )

    @property
    def inertia(self) -> NDArray[np.float64]:
        """Mass for heave and sway, moment of inertia for roll, shape (3,)."""
        return self.hydrostatics.inertia

    @property
    def stiffness(self) -> NDArray[np.float64]:
        """Stiffness of heave, sway and roll by gravity and by springs, shape (3, 3)."""
        return self.hydrostatics.stiffness + (np.array(self.springs) if self.springs else 0.0)

    @property
    def roll_stiffness(self) -> float:
        """Stiffness of roll, N; with free heave that of a roll without heave force, and so of sway with springs."""
        rest = self.hydrostatics
        if not self.springs:
            return rest.free_roll_stiffness if "heave" in self.motions else rest.roll_stiffness
        stiffness = self.stiffness
        others = [place for place in (0, 1) if place in self._by_place and stiffness[place].any()]
        held = stiffness[np.ix_(others, others)]
        return float(stiffness[2, 2] - stiffness[2, others] @ np.linalg.pinv(held) @ stiffness[others, 2])

    @property
    def is_rotation(self) -> NDArray[np.float64]:
        """1 of a motion that is an angle, 0 of one that is a length, shape (motions,)."""
        return np.array([float(motion.is_rotation) for motion in self.rigid_motions])

    def displacement(self, motion: Motion, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement by a unit of a motion: upwards, to the right, anticlockwise about the centre of mass.

        Of a solid these are the displacements in its plane θ = 0.

        Args:
            points: shape (2, n).

        Returns:
            Shape (2, n).
        """
        zero, one = np.zeros(points.shape[1]), np.ones(points.shape[1])
        place = PLACES[motion]
        if place < 2:
            return np.array([zero, one] if place == 0 else [one, zero])
        x, y = self.hydrostatics.centre_of_mass
        return np.array([y - points[1], points[0] - x])


def dof_of_motion(motion: Motion) -> Dof:
    """Return the degree of freedom of a motion."""
    return Turn(motion) if motion == "pitch" else Dof(motion)


def azimuthal_order(motion: Motion) -> int:
    """Return n of the factor cos nθ of the normal displacement by a motion of a solid of revolution."""
    return 0 if motion == "heave" else 1


# Coupling and stiffness below this part of the largest are rounding.
_NEGLIGIBLE = 1e-12


def principal_motions(
    body: RigidFloat, motions: tuple[Motion, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return n motions without coupling by stiffness or inertia as columns, their stiffness and inertia; dimensionless.

    Each has the name and unit of the motion with the largest part of its kinetic energy.
    """
    places = [PLACES[motion] for motion in motions]
    stiffness, inertia = body.stiffness[np.ix_(places, places)], body.inertia[places]
    turn = np.eye(len(motions))
    # Roll is scaled by the displacement of the float's rim, to be comparable with heave.
    units = np.array([1.0 / body.hull.smallest_extent if place == 2 else 1.0 for place in places])
    alike = np.abs(stiffness * units * units[:, None])
    apart = alike - np.diag(np.diag(alike)) > _NEGLIGIBLE * alike.max(initial=0.0)
    if apart.any():
        coupled = np.flatnonzero(apart.any(axis=0))
        own = np.ix_(coupled, coupled)
        _, vectors = eigh(stiffness[own], np.diag(inertia[coupled]))
        # Of vectors orthogonal in the inertia, each is named after the motion that dominates it.
        _, order = linear_sum_assignment(-(vectors**2) * inertia[coupled, None])
        vectors = vectors[:, order]
        turn[own] = vectors / np.diag(vectors)
    restoring = np.einsum("im,ij,jm->m", turn, stiffness, turn)
    restoring[np.abs(restoring) * units**2 < _NEGLIGIBLE * alike.max(initial=0.0)] = 0.0
    return turn, restoring, np.einsum("im,i,im->m", turn, inertia, turn)
