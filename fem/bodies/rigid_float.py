"""A rigid float as a body of the field model: heave, sway and roll as normal displacements of its wetted contour."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.bodies.model import BodyModel
from hydroelastic.fem.closed.discretization import ends_of_motions
from hydroelastic.fem.surfaces import Body, rigid_shapes
from hydroelastic.physics.dofs import Motion, body_name
from hydroelastic.physics.floats import RigidFloat, dof_of_motion, principal_motions
from hydroelastic.physics.symmetry import Parity, motion_parity


class FloatModel(BodyModel):
    """A rigid float in its principal motions."""

    def moving(self, count: int, parity: Parity | None) -> Body:
        """See `BodyModel.moving`; a float has all of its motions whatever the count."""
        return in_principal_motions(self.tank.floats[self.index], self.index, parity)

    def ends_of_motions(self) -> tuple[float, ...]:
        """See `BodyModel.ends_of_motions`."""
        return ends_of_motions(self.tank, self.index)


def in_principal_motions(body: RigidFloat, index: int, parity: Parity | None) -> Body:
    """A float in its principal motions; dimensionless.

    They are heave, sway and roll where neither gravity, as in a section that is not its own mirror image, nor springs
    couple these. Those that are coupled are replaced by the motions in which the float alone, without liquid, would
    oscillate; each has the name and unit of the one with the largest part of its kinetic energy.
    """
    motions = tuple(motion for motion in body.motions if parity in (None, motion_parity(motion)))
    part = 1.0 if parity is None else 0.5
    turn, stiffness, inertia = principal_motions(body, motions)
    return Body(
        surface=body_name(index + 1),
        shapes=partial(_thin_shapes, body, motions, turn)
        if body.hull.is_thin
        else partial(rigid_shapes, body.displacement, motions, turn),
        wavenumber=0.0,
        dofs=tuple(map(dof_of_motion, motions)),
        parities=tuple(map(motion_parity, motions)),
        motions=turn,
        stiffness=part * stiffness,
        bending_stiffness=np.zeros(len(motions)),
        mass=np.diag(part * inertia),
        singular_points=_singular_points(body),
    )


def _singular_points(body: RigidFloat) -> NDArray[np.float64] | None:
    """Points where the slope of a thin float's profile is unbounded: the ends of a thin ellipse, shape (points, 2)."""
    hull = body.hull
    if not hull.is_thin or hull.profile is None or hull.profile.shape != "ellipse":
        return None
    return np.array([[hull.waterplane[0], y] for y in hull.slit])


def _thin_shapes(
    body: RigidFloat,
    motions: tuple[Motion, ...],
    turn: NDArray[np.float64],
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The flux through the contour x = x₀ ± ω(y), applied on x = x₀: n ds = (∓1, ω') dy out of the liquid."""
    profile = body.hull.profile
    assert profile is not None
    y = points[1] - body.hull.reference_level
    # The liquid on the right has its normal to the left, and the contour to the right.
    on_contour = np.array([points[0] - normals[0] * profile.half_width_at(y), points[1]])
    flux = np.array([normals[0], profile.slope_at(y)])
    return rigid_shapes(body.displacement, motions, turn, on_contour, flux)
