"""Further dry modes of a round plate, bent by the pressure and the forces that the modes of the field model leave.

The dry modes k beyond those of the model have amplitudes aₖ = fₖ/(Kₖ − λmₖ), with the force fₖ of the waves and of
springs and dampers in the motion by the modes of the model. What they add to the waves is of second order: its effect
on an outgoing wave is, by reciprocity, Σ aₖ times the pressure on mode k of the wave that returns. Derivatives of the
deflection then converge as fast as the pressure allows (mode acceleration, see `beam_loads`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.bodies.round_plate import RoundPlateModel, RoundShapes
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.pencil import weighed_loads
from hydroelastic.fem.open_water.wetted_surface import WettedSurface

if TYPE_CHECKING:
    from hydroelastic.fem.open_water.field_model import OpenModel
    from hydroelastic.fem.open_water.frequency import OpenResponse

# With so many further modes the moment is accurate to 1e-8 and the shear force to 4e-6 of the largest, of discs and
# rings with loads like s ln s at their edges.
_FURTHER = 36


@dataclass(frozen=True, kw_only=True)
class BentPlate:
    """Amplitudes of the dry modes of a plate in waves of a unit of c. Shapes: w waves, k dry modes.

    Attributes:
        amplitudes: of all modes, shape (w, k).
        scattered: of the plate bent by the pressure of the scattered waves alone, shape (w, k).
        omitted: effect of the further modes on the amplitude of the outgoing wave over the incident one, shape (w,).
    """

    amplitudes: np.ndarray
    scattered: np.ndarray
    omitted: np.ndarray


class PlateModes:
    """The dry modes of one round plate, with further ones.

    Args:
        model: the problem.
        index: of the plate among the bodies.

    Attributes:
        bends: whether the plate is not rigid.
        shapes: the dry modes.
        own: places of the modes of the model among the body unknowns.
    """

    def __init__(self, model: OpenModel, index: int) -> None:
        """Integrate over the plate (collective)."""
        pencil, basin = model.pencil, model.basin
        count, first = pencil.bodies[index].size, sum(body.size for body in pencil.bodies[:index])
        self._model, self.own = model, slice(first, first + count)
        plate = RoundPlateModel(tank=basin.tank, index=index)
        self.bends = plate.plate.bends
        self.shapes = RoundShapes(plate.plate, count + _FURTHER * bool(count), spare=0)
        self._body = plate.in_shapes(self.shapes)
        self._loads = weighed_loads(pencil.liquid, self._body)[:, pencil.free].astype(complex)
        self._surface = WettedSurface(pencil.liquid, self._body, model.shortest)
        bodies = (*pencil.bodies[:index], self._body, *pencil.bodies[index + 1 :])
        self._outside = outside_of(basin, bodies, model.attachments)
        self._modes = slice(first, first + self._body.size)
        # The unknowns of the model among these.
        self._known = np.delete(np.arange(len(self._outside.stiffness)), np.arange(first + count, self._modes.stop))

    def of(self, response: OpenResponse, motions: np.ndarray, drag: np.ndarray) -> BentPlate:
        """Return the amplitudes of all modes in each incident wave (collective).

        Args:
            response: to waves.
            motions: of all body unknowns, those of the response or with further damping, shape (incident, unknowns).
            drag: linear damping in place of each drag of `OutsideForces`, dimensionless, shape (incident, drags).
        """
        squared, surface, body, outside = response.squared.real, self._surface, self._body, self._outside
        waves = [response.incidence.planes[place] for place in response.incident]
        given = np.array([wave.field(surface.points, surface.layers)[0] for wave in waves])
        scattered = self._model.pencil.products(response.potentials(np.eye(len(motions)), motions), self._loads)
        pressures = surface.integrals(given, surface.shapes) + scattered
        omega = float(np.sqrt(squared))
        held = motions @ outside.impedance(omega)[self._known, self._modes]
        held -= 1j * omega * (drag * (motions @ outside.paths[:, self._known].T)) @ outside.paths[:, self._modes]
        count = self.own.stop - self.own.start
        amplitudes = (squared * pressures - held) / (body.stiffness - squared * np.diag(body.mass))
        amplitudes[:, :count] = motions[:, self.own]
        bends = body.bending_stiffness > 0.0
        statically = squared * scattered * bends / np.where(bends, body.stiffness, 1.0)
        powers = response.incidence.powers[response.incident]
        omitted = np.abs((amplitudes * pressures)[:, count:].sum(axis=1)) / powers
        return BentPlate(amplitudes=amplitudes, scattered=statically, omitted=omitted)
