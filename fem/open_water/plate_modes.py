"""The dry modes of a round plate, with further ones than those of the field model."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.bodies.round_plate import RoundPlateModel, RoundShapes
from hydroelastic.fem.open_water.basin import OpenBasin
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.pencil import OpenPencil, weighed_loads
from hydroelastic.fem.open_water.wetted_surface import WettedSurface
from hydroelastic.physics.attachments import Attachment

# With so many further modes the moment is accurate to 1e-8 and the shear force to 4e-6 of the largest, of discs and
# rings with loads like s ln s at their edges.
_FURTHER = 36


class PlateModes:
    """The dry modes of one round plate, with further ones.

    Args:
        pencil: the problem of one azimuthal order.
        attachments: in SI units.
        wavenumber: largest wavenumber of incident waves, in units of the basin.
        index: of the plate among the bodies.

    Attributes:
        bends: whether the plate is not rigid.
        shapes: the dry modes.
        count: number of modes of the model, the first ones of these.
        own: their places among the body unknowns.
        surface: for integrals of given waves over the modes.
        given: these of incident waves by λ, shape (waves, modes): a frequency is evaluated for loads, their errors and
            those of waves.
        loads: ∫ρφₖ q of each mode on the potential, own entries of free unknowns, shape (modes, free unknowns).
    """

    def __init__(
        self,
        basin: OpenBasin,
        pencil: OpenPencil,
        attachments: tuple[Attachment, ...],
        wavenumber: float,
        index: int,
    ) -> None:
        """Integrate over the plate (collective)."""
        first = sum(body.size for body in pencil.bodies[:index])
        self.count = count = pencil.bodies[index].size
        self.own = slice(first, first + count)
        plate = RoundPlateModel(tank=basin.tank, index=index)
        self.bends = plate.plate.bends
        self.shapes = RoundShapes(plate.plate, count + _FURTHER * bool(count), spare=0)
        self._body = plate.in_shapes(self.shapes)
        self.loads = weighed_loads(pencil.liquid, self._body)[:, pencil.free].astype(complex)
        self.surface = WettedSurface(pencil.liquid, self._body, wavenumber)
        bodies = (*pencil.bodies[:index], self._body, *pencil.bodies[index + 1 :])
        self._outside = outside_of(basin, bodies, attachments)
        self._modes = slice(first, first + self._body.size)
        # The unknowns of the model among these.
        self._known = np.delete(np.arange(len(self._outside.stiffness)), np.arange(first + count, self._modes.stop))
        self.given: dict[float, np.ndarray] = {}

    def amplitudes(self, squared: float, pressures: np.ndarray, motions: np.ndarray, drag: np.ndarray) -> np.ndarray:
        """Return the amplitudes of all modes in waves at λ, shape (waves, modes)."""
        paths = self._outside.paths
        held = motions @ self.held(squared)
        held -= 1j * np.sqrt(squared) * (drag * (motions @ paths[:, self._known].T)) @ paths[:, self._modes]
        amplitudes = (squared * pressures - held) / self.restoring(squared)
        amplitudes[:, : self.count] = motions[:, self.own]
        return np.asarray(amplitudes)

    def held(self, squared: float) -> np.ndarray:
        """Return forces of springs and dampers on all modes by a unit of each body unknown, shape (unknowns, modes)."""
        impedance = self._outside.impedance(float(np.sqrt(squared)))
        return np.asarray(impedance[self._known, self._modes])

    def restoring(self, squared: float) -> np.ndarray:
        """Return Kₖ − λmₖ of the modes in air and still water, shape (modes,)."""
        return self._body.stiffness - squared * np.diag(self._body.mass)
