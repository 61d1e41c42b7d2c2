"""Bodies as unknowns of the pencil: shapes, stiffness and mass of beams, rigid floats and thin floats.

A body moves as v = Σ aᵢ vᵢ(x), with vᵢ a displacement of its wetted surface, and brings

    stiffness kᵢ of each shape (strain energy and hydrostatics), mass mᵢⱼ, loads ∫vᵢ·n q on the liquids.

Beams move in their dry modes, orthogonal in the strain energy and in ∫wᵢwⱼ. Rigid floats move in their principal
motions: heave, sway and roll where nothing couples these, else those in which the float alone would oscillate. A thin
float x = x₀ ± ω(y) moves the liquids beside the line x = x₀ by v·(±1, ω')

Each kind is one function in `BODIES`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import compress
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.floats import RigidFloat, dof_of_motion, principal_motions
from hydroelastic.physics.symmetry import Parity, left_bodies, motion_parity, twin_of
from hydroelastic.physics.tank import Tank

Array = NDArray[np.float64]
Shapes = Callable[[Array, Array], Array]
"""Points (n, dim) on the wetted surface, and the side sign of each (−1 left, 1 right of a slit, 0 elsewhere) →
displacements (shapes, dim, n)."""


@dataclass(frozen=True, kw_only=True)
class Body:
    """A body of a tank in its unknowns, dimensionless."""

    index: int  # among the bodies of the tank
    dofs: tuple[Dof, ...]  # degree of freedom of each shape
    parities: tuple[Parity, ...]  # symmetry of each shape about the middle of the body
    shapes: Shapes  # displacements of the wetted surface
    stiffness: Array  # of each shape, hydrostatics included, shape (shapes,)
    bending: Array  # the part of it that is strain energy, shape (shapes,)
    mass: Array  # shape (shapes, shapes)
    motions: Array  # the shapes as columns in the degrees of freedom; the identity but of principal motions
    is_slit: bool = False  # whether its two sides lie on one line

    @property
    def name(self) -> str:
        return body_name(self.index + 1)

    @property
    def size(self) -> int:
        return len(self.dofs)

    def of_first(self, count: int) -> tuple[Body, Array]:
        """The same with only the first dry modes of its beam, and which shapes these are, shape (shapes,)."""
        kept = np.array([not dof.is_elastic or int(dof.split()[1]) <= count for dof in self.dofs], dtype=bool)
        own: dict[str, Any] = {
            "stiffness": self.stiffness[kept],
            "bending": self.bending[kept],
            "mass": self.mass[kept][:, kept],
        }
        own |= {"dofs": tuple(compress(self.dofs, kept)), "parities": tuple(compress(self.parities, kept))}
        return replace(self, motions=self.motions[kept][:, kept], **own), kept


def beam(tank: Tank, index: int, count: int, parity: Parity | None) -> Body:
    """A beam in its first dry modes, rigid ones included; in half a tank those of one symmetry."""
    own = tank.beams[index]
    piece, jump = tank.piece_of(index), tank.level_of(index).jump
    part = 1.0 if parity is None else 0.5
    shapes = beam_shapes(own, count)
    parities: list[Parity] = ["symmetric" if sign > 0 else "antisymmetric" for sign in shapes.parities]
    kept = np.array([number for number, sign in enumerate(parities) if parity in (None, sign)], dtype=int)

    def displaced(points: Array, _sides: Array) -> Array:
        found = np.zeros((len(kept), points.shape[1], len(points)))
        # Nodes at the tips may miss them by rounding.
        found[:, 1] = shapes.deflections(np.clip(points[:, 0] - piece.start, 0.0, piece.length))[kept]
        return found

    bending = part * shapes.bending[kept]
    return Body(
        index=index,
        dofs=tuple(shapes.dofs[number] for number in kept),
        parities=tuple(parities[number] for number in kept),
        shapes=displaced,
        stiffness=bending + part * float(own.hydrostatic) * jump * piece.length,
        bending=bending,
        mass=part * shapes.mass[np.ix_(kept, kept)],
        motions=np.eye(len(kept)),
    )


def rigid_float(tank: Tank, index: int, _count: int, parity: Parity | None) -> Body:
    """A rigid float on its exact contour, or a thin one on its middle line."""
    own = tank.floats[index]
    motions = tuple(motion for motion in own.motions if parity in (None, motion_parity(motion)))
    part = 1.0 if parity is None else 0.5
    turn, stiffness, inertia = principal_motions(own, motions)
    profile = own.hull.profile

    def displaced(points: Array, sides: Array) -> Array:
        if not own.hull.is_thin:
            units = np.array([own.displacement(motion, points.T) for motion in motions])
            return np.asarray(np.tensordot(turn.T, units.reshape(len(motions), *points.T.shape), axes=1))
        assert profile is not None
        y = points[:, 1] - own.hull.reference_level
        contour = np.array([points[:, 0] + sides * profile.half_width_at(y), points[:, 1]])
        units = np.array([own.displacement(motion, contour) for motion in motions]).reshape(-1, 2, len(points))
        # The contour x = x₀ ± ω has the flux ±vₓ − ω'v_y to the right and left, applied as a displacement along x.
        flux = units[:, 0] - sides * profile.slope_at(y) * units[:, 1]
        return np.asarray(np.tensordot(turn.T, np.stack([flux, np.zeros_like(flux)], axis=1), axes=1))

    return Body(
        index=index,
        dofs=tuple(map(dof_of_motion, motions)),
        parities=tuple(map(motion_parity, motions)),
        shapes=displaced,
        stiffness=part * stiffness,
        bending=np.zeros(len(motions)),
        mass=np.diag(part * inertia),
        motions=turn,
        is_slit=own.hull.is_thin,
    )


BODIES: dict[type, Callable[[Tank, int, int, Parity | None], Body]] = {Beam: beam, RigidFloat: rigid_float}


def body_of(tank: Tank, index: int, count: int, parity: Parity | None = None) -> Body:
    make = next(make for kind, make in BODIES.items() if isinstance(tank.bodies[index], kind))
    return make(tank, index, count, parity)


def moving_bodies(tank: Tank, counts: tuple[int, ...], parity: Parity | None) -> tuple[Body, ...]:
    """The bodies of a tank, or of the left half of a symmetric one in their shapes of one symmetry."""
    if parity is None:
        return tuple(body_of(tank, index, count) for index, count in enumerate(counts))
    bodies = (
        body_of(tank, index, counts[index], parity if twin_of(tank, index) == index else None)
        for index in left_bodies(tank)
    )
    return tuple(body for body in bodies if body.size)


def extension(tank: Tank, bodies: tuple[Body, ...], parity: Parity | None) -> Array:
    """Matrix from the body unknowns of a part to those of the whole tank, at unit generalized mass of each."""
    if parity is None:
        return np.eye(sum(body.size for body in bodies))
    offsets = np.cumsum([0, *(body.size for body in bodies)])
    columns = []
    for index in left_bodies(tank):
        twin = twin_of(tank, index)
        for number, own in enumerate(bodies[index].parities):
            if twin == index and own != parity:
                continue
            column = np.zeros(offsets[-1])
            column[offsets[index] + number] = np.sqrt(0.5)
            if twin != index:
                # In the mirror image odd shapes change their sign.
                column[offsets[twin] + number] = np.sqrt(0.5) if own == parity else -np.sqrt(0.5)
            columns.append(column)
    return np.array(columns).reshape(len(columns), offsets[-1]).T


# Dry modes beyond the shortest wave, in units of its half waves and of tolerance^(-1/7).
_TAIL = 0.45
# Half waves of the first bending shape of a section.
_FIRST_BENDING = 1.5
# A section stiffer than the softest one by this factor over the tolerance is rigid within the tolerance.
_RIGID = 100.0
# Sections whose flexural rigidities differ by less than this factor have common dry modes.
_ALIKE = 10.0


def dry_mode_count(own: Beam, wavenumber: float, tolerance: float) -> int:
    """Number of dry modes up to the shortest wave, and of a tail whose error falls like N⁻⁷.

    Dry modes have wavenumbers κ ~ EI^{-1/4} in the sections, and the shortest wave is in the softest one. The bending
    of stiffer ones matters less, like 1/EI, but is not represented below their first bending shape, of 3/2 half waves.
    """
    softest = min(part.flexural_rigidity for part in own.sections)
    phase = sum((softest / part.flexural_rigidity) ** 0.25 * part.length for part in own.sections)
    needed = 0.0
    for part in own.sections:
        ratio = part.flexural_rigidity / softest
        alike = (
            other
            for other in own.sections
            if 1.0 / _ALIKE <= other.flexural_rigidity / part.flexural_rigidity <= _ALIKE
        )
        length = sum(other.length for other in alike)
        half_waves = wavenumber * ratio**-0.25 * length / pi
        tail = _TAIL * (half_waves + 2.0) * (tolerance * ratio) ** (-1.0 / 7.0)
        hidden = _FIRST_BENDING if _ALIKE < ratio < _RIGID / tolerance else 0.0
        needed = max(needed, (half_waves + tail + hidden) * phase * ratio**0.25 / length)
    return int(np.ceil(needed)) + 4 + len(own.hinges)
