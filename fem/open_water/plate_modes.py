"""Further dry modes of a round plate, bent by the pressure and the forces that the modes of the field model leave.

The dry modes k beyond those of the model have amplitudes aₖ = fₖ/(Kₖ − λmₖ), with the force fₖ of the waves and of
springs and dampers in the motion by the modes of the model. What they add to the waves is of second order: its effect
on an outgoing wave is, by reciprocity, Σ aₖ times the pressure on mode k of the wave that returns. Derivatives of the
deflection then converge as fast as the pressure allows (mode acceleration, see `beam_loads`).
"""

from __future__ import annotations

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


class PlateModes:
    """The dry modes of one round plate, with further ones.

    Args:
        model: the problem.
        index: of the plate among the bodies.

    Attributes:
        bends: whether the plate is not rigid.
        shapes: the dry modes.
        count: number of modes of the model, the first ones of these.
        own: their places among the body unknowns.
        loads: ∫ρφₖ q of each mode on the potential, own entries of free unknowns, shape (modes, free unknowns).
    """

    def __init__(self, model: OpenModel, index: int) -> None:
        """Integrate over the plate (collective)."""
        pencil, basin = model.pencil, model.basin
        first = sum(body.size for body in pencil.bodies[:index])
        self.count = count = pencil.bodies[index].size
        self._model, self.own = model, slice(first, first + count)
        plate = RoundPlateModel(tank=basin.tank, index=index)
        self.bends = plate.plate.bends
        self.shapes = RoundShapes(plate.plate, count + _FURTHER * bool(count), spare=0)
        self._body = plate.in_shapes(self.shapes)
        self.loads = weighed_loads(pencil.liquid, self._body)[:, pencil.free].astype(complex)
        self._surface = WettedSurface(pencil.liquid, self._body, model.shortest)
        bodies = (*pencil.bodies[:index], self._body, *pencil.bodies[index + 1 :])
        self._outside = outside_of(basin, bodies, model.attachments)
        self._modes = slice(first, first + self._body.size)
        # The unknowns of the model among these.
        self._known = np.delete(np.arange(len(self._outside.stiffness)), np.arange(first + count, self._modes.stop))

    def of(self, response: OpenResponse, motions: np.ndarray, drag: np.ndarray) -> np.ndarray:
        """Return the amplitudes of all modes in each wave of a unit of c, shape (incident, modes) (collective).

        Args:
            response: to waves.
            motions: of all body unknowns, those of the response or with further damping, shape (incident, unknowns).
            drag: linear damping in place of each drag of `OutsideForces`, dimensionless, shape (incident, drags).
        """
        squared, outside = response.squared.real, self._outside
        omega = float(np.sqrt(squared))
        held = motions @ self.held(squared)
        held -= 1j * omega * (drag * (motions @ outside.paths[:, self._known].T)) @ outside.paths[:, self._modes]
        amplitudes = (squared * self._pressures(response, motions) - held) / self.restoring(squared)
        amplitudes[:, : self.count] = motions[:, self.own]
        return np.asarray(amplitudes)

    def omitted(self, response: OpenResponse) -> np.ndarray:
        """Return the effect of the further modes on the amplitude of the outgoing wave over the incident one, shape
        (incident,) (collective)."""
        motions, count = response.motions, self.count
        further = (self.undamped(response) * self._pressures(response, motions))[:, count:].sum(axis=1)
        return np.asarray(np.abs(further) / response.incidence.powers[response.incident])

    def held(self, squared: float) -> np.ndarray:
        """Return forces of springs and dampers on all modes by a unit of each body unknown, shape (unknowns, modes)."""
        impedance = self._outside.impedance(float(np.sqrt(squared)))
        return np.asarray(impedance[self._known, self._modes])

    def undamped(self, response: OpenResponse) -> np.ndarray:
        """Return the amplitudes of all modes without drag, see `of`."""
        motions = response.motions
        return self.of(response, motions, np.zeros((len(motions), len(self._outside.drag))))

    def _pressures(self, response: OpenResponse, motions: np.ndarray) -> np.ndarray:
        """∫ρΨ on all modes of all waves, shape (incident, modes)."""
        surface, waves = self._surface, [response.incidence.planes[place] for place in response.incident]
        given = np.array([wave.field(surface.points, surface.layers)[0] for wave in waves])
        scattered = self._model.pencil.products(response.potentials(np.eye(len(motions)), motions), self.loads)
        return surface.integrals(given, surface.shapes) + scattered

    def restoring(self, squared: float) -> np.ndarray:
        """Return Kₖ − λmₖ of the modes in air and still water, shape (modes,)."""
        return self._body.stiffness - squared * np.diag(self._body.mass)
