"""The problem of a symmetry class of a box, as the common solution of level tanks has it, with its modes sampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.level_bed.solution import SampledSurface
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.plan.box_pencil import water_columns, water_masses
from hydroelastic.fem.plan.classes import ClassProblem
from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.physics.arrays import FloatArray

# Standing waves with less than this part of the largest amplitude are not sampled.
_UNSEEN = 1e-7


@dataclass(frozen=True, kw_only=True)
class BoxProblem(ClassProblem):
    """A symmetry class of a box; see `PlanProblem`.

    Attributes:
        plates: the plates in its shapes.
        size: sides of the box.
    """

    plates: tuple[RectangleBody, ...]
    size: tuple[float, float]

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """See `PlanProblem.sampled`; there is no second mode."""
        del second
        liquid = self.pencil.liquid
        parity = self.symmetry_class.parity
        # Of a box the lower half is kept: both are turned about.
        planes = [None if own is None else -0.5 * length for own, length in zip(parity, self.size, strict=True)]
        turned, sign = self.symmetry_class.folded(-np.array([x, y]), (planes[0], planes[1]))
        folded = [np.clip(-places, 0.0, length) for places, length in zip(turned, self.size, strict=True)]
        tables = [space.table(places) for space, places in zip(liquid.spaces, folded, strict=True)]
        height = np.zeros(liquid.size)
        if self.pencil.surfaces:
            columns = water_columns(water_masses(liquid, self.plates))
            height[columns] = mode.values[self.pencil.body_size :]
        elevation = sign * np.einsum("ip,ij,jp->p", tables[0], height.reshape(liquid.shape), tables[1], optimize=True)
        position = 0
        for plate in self.plates:
            (left, right), (low, high) = plate.extents
            inside = (x >= left) & (x <= right) & (y >= low) & (y <= high)
            amplitudes = mode.body_amplitudes[position : position + plate.body.size]
            position += plate.body.size
            elevation[inside] = amplitudes @ plate.deflection(np.array([x[inside], y[inside]]))
        squares = np.add.outer(liquid.spaces[0].waves[0], liquid.spaces[1].waves[0])
        along, across = (space.waves[1].T for space in liquid.spaces)
        moments = [space.mass @ space.waves[1] for space in liquid.spaces]
        parts = moments[0].T @ mode.potential.array_r.reshape(liquid.shape) @ moments[1]
        seen = np.argwhere(np.abs(parts) > _UNSEEN * np.abs(parts).max())
        first, other = along @ tables[0], across @ tables[1]
        return SampledSurface(
            elevation=elevation,
            wavenumbers=np.sqrt(np.maximum(squares[seen[:, 0], seen[:, 1]], 0.0)),
            potentials=(sign * first[seen[:, 0]] * other[seen[:, 1]] * parts[seen[:, 0], seen[:, 1]][:, None]).T,
        )
