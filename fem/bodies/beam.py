"""A beam as a body of the field model: its dry modes as normal displacements of the line on which it floats."""

from __future__ import annotations

from functools import lru_cache, partial
from math import ceil, pi
from typing import NamedTuple

import numpy as np

from hydroelastic.fem.bodies.model import BodyModel
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.beam.beam_shapes import BeamShapes, beam_shapes, first_bending
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.symmetry import Parity

# Added mass per ρ l of dry mode 1 and of heave, and between them, on deep open water with ψ = 0 beside the beam.
_DEEP_ELASTIC = 0.12787
_DEEP_HEAVE = 0.39270
_DEEP_COUPLING = 0.114
# Dry modes beyond the shortest wave, in units of its half waves and of tolerance^(-1/7).
_TAIL = 0.45
# Half waves of the first bending shape of a section.
_FIRST_BENDING = 1.5
# A section stiffer than the softest one by this factor over the tolerance is rigid within the tolerance.
_RIGID = 100.0
# Sections whose flexural rigidities differ by less than this factor have common dry modes.
_ALIKE = 10.0


class BeamModel(BodyModel):
    """A beam in its first dry modes."""

    @property
    def beam(self) -> Beam:
        """The beam."""
        return self.tank.beams[self.index]

    def moving(self, count: int, parity: Parity | None) -> Body:
        """See `BodyModel.moving`."""
        tank, beam = self.tank, self.beam
        piece, jump = tank.piece_of(self.index), tank.level_of(self.index).jump
        part = 1.0 if parity is None else 0.5
        shapes = beam_shapes(beam, count)
        # Two asymmetric beams that are mirror images have mirrored shapes: all count as even.
        own = _of_parity(shapes.dofs, shapes.parities, parity)
        bending = part * shapes.bending[own.numbers]
        return Body(
            surface=body_name(self.index + 1),
            shapes=partial(_shapes_at, shapes, piece.start, piece.length, own.numbers),
            wavenumber=shapes.wavenumber,
            dofs=own.dofs,
            parities=own.parities,
            motions=own.identity,
            stiffness=bending + part * float(beam.hydrostatic) * jump * piece.length,
            bending_stiffness=bending,
            mass=part * shapes.mass[own.numbers[:, None], own.numbers],
        )

    def dry_mode_count(self, wavenumber: float, tolerance: float) -> int:
        """Return the number of dry modes up to the shortest wave, and of a tail whose error falls like N⁻⁷.

        Dry modes have wavenumbers κ ~ EI^{-1/4} in the sections, and the shortest wave is in the softest one. The
        bending of stiffer ones matters less, like 1/EI, but is not represented below their first bending shape, of 3/2
        half waves.
        """
        sections = self.beam.sections
        softest = min(part.flexural_rigidity for part in sections)
        phase = sum((softest / part.flexural_rigidity) ** 0.25 * part.length for part in sections)
        needed = 0.0
        for part in sections:
            ratio = part.flexural_rigidity / softest
            length = sum(
                other.length
                for other in sections
                if 1.0 / _ALIKE <= other.flexural_rigidity / part.flexural_rigidity <= _ALIKE
            )
            half_waves = wavenumber * ratio**-0.25 * length / pi
            tail = _TAIL * (half_waves + 2.0) * (tolerance * ratio) ** (-1.0 / 7.0)
            hidden = _FIRST_BENDING if _ALIKE < ratio < _RIGID / tolerance else 0.0
            needed = max(needed, (half_waves + tail + hidden) * phase * ratio**0.25 / length)
        return ceil(needed) + 4 + len(self.beam.hinges)

    @property
    def has_tone(self) -> bool:
        """See `BodyModel.has_tone`; asked for each of many beams, it needs no estimate."""
        return True

    def expected_tones(self) -> tuple[float, ...]:
        """Estimate λ of dry mode 1 coupled with heave, on deep open liquids with ψ = 0 beside the beam."""
        beam, level = self.beam, self.tank.level_of(self.index)
        liquid = beam.length * self.tank.density_at(level)
        elastic = beam.mass_per_length + _DEEP_ELASTIC * liquid
        heave = beam.mass_per_length + _DEEP_HEAVE * liquid
        inertia = elastic - (_DEEP_COUPLING * liquid) ** 2 / heave
        return ((first_bending(beam) + float(beam.hydrostatic) * level.jump) / inertia,)


class _Shapes(NamedTuple):
    """Some shapes of a beam: their numbers, degrees of freedom, parities and the identity of their number."""

    numbers: np.ndarray
    dofs: tuple[Dof, ...]
    parities: tuple[Parity, ...]
    identity: np.ndarray


@lru_cache(maxsize=64)
def _of_parity(dofs: tuple[Dof, ...], signs: tuple[int, ...], parity: Parity | None) -> _Shapes:
    parities: list[Parity] = ["symmetric" if sign > 0 else "antisymmetric" for sign in signs]
    numbers = np.array([number for number, own in enumerate(parities) if parity in (None, own)], dtype=int)
    identity = np.eye(len(numbers))
    for kept in (numbers, identity):
        kept.flags.writeable = False
    return _Shapes(
        numbers, tuple(dofs[number] for number in numbers), tuple(parities[number] for number in numbers), identity
    )


def _shapes_at(
    shapes: BeamShapes,
    start: float,
    length: float,
    numbers: np.ndarray,
    points: np.ndarray,
    normals: np.ndarray,
) -> np.ndarray:
    # Quadrature points at the tips may miss them by rounding.
    upwards: np.ndarray = shapes.deflections(np.clip(points[0] - start, 0.0, length))[numbers] * normals[1]
    return upwards
