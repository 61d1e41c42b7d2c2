"""Estimates of plates about the axis of a tank of revolution, whose bed may be shaped."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from hydroelastic.modal.plate.estimates import PlateEstimate, plate_estimates
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.plate import Disc, Plate
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Circles below a plate at which the depth is taken.
_CIRCLES = 1000


def round_plate_estimates(physical: Tank, level: LevelTank) -> Iterator[PlateEstimate]:
    """Yield the estimates of plates without tension on one liquid, each as if the bed were level at the mean depth
    below it.

    Those of rigid plates are for a plate that is the only body.

    Args:
        physical: the tank of revolution in SI units.
        level: an upright tank of its radius with its plates in the same order.
    """
    places = [index for index in physical.elastic if physical.level_of(index) is physical.levels[-1]]
    for place, plate in zip(places, level.plates, strict=True):
        body = physical.bodies[place]
        assert isinstance(body, RoundPlate)
        if body.tension or len(physical.layers) > 1:
            continue
        depth = _mean_depth(physical, plate)
        flat = "" if physical.bed is None else f"; the bed as if level at {depth:.4g} m, its mean depth below the plate"
        for one in plate_estimates(replace(level, depth=depth, plates=(plate,))):
            if one.motion == "elastic" or len(physical.bodies) == 1:
                yield replace(one, plate=place, note=one.note + flat)


def _mean_depth(physical: Tank, plate: Plate) -> float:
    depth, outline = physical.layers[0].depth, plate.outline
    assert isinstance(outline, Disc)
    if physical.bed is None:
        return depth
    width = outline.radius - outline.inner_radius
    radii = outline.inner_radius + width * (np.arange(_CIRCLES) + 0.5) / _CIRCLES
    if isinstance(physical.bed, tuple):
        depths = -np.interp(radii, *np.transpose(physical.bed))
    else:
        sphere = 0.5 * (physical.length**2 + depth**2) / depth
        depths = np.sqrt(sphere**2 - radii**2) - sphere + depth
    return float(np.average(depths, weights=radii))
