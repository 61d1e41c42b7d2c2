"""Comparison of closed forms and estimates with the field solution of one round plate in the sea."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

import numpy as np

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.results import RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.thin_float_theory import Comparison, compared
from hydroelastic.modal.floats.round_bodies import DISC_HEAVE, DISC_PITCH, LID_HEAVE, LID_PITCH, following_heave
from hydroelastic.modal.plate.estimates import plate_estimates
from hydroelastic.physics.level_tank import Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Radius, in those of the plate, of a basin whose walls are out of its reach: their part of a rigid disc's is its cube.
_WIDE = 20.0


def plate_comparisons(tank: Tank, solution: OpenWaterSolution) -> Iterator[Comparison]:
    """Yield closed forms and estimates beside the solution of a sea with one round plate and one liquid."""
    plate = plate_of(tank.bodies[0])
    for radiation in solution.radiation:
        yield from _added_mass(tank, plate, radiation)
    if not plate.hydrostatic or tank.attachments:
        return
    for response in solution.response:
        yield _following(plate, response)
    for resonance in solution.resonance:
        yield from _resonances(tank, plate, resonance)


def _added_mass(tank: Tank, plate: RoundPlate, table: RadiationTable) -> Iterator[Comparison]:
    """Of a disc in deep water beside ψ = 0, at infinite frequency, and beside a lid, at zero frequency."""
    if tank.layers[0].depth < inf or plate.inner_radius:
        return
    limits: list[tuple[str, np.ndarray, tuple[float, float]]] = []
    at_infinity = np.flatnonzero(np.isinf(table.omega))
    far = table.infinite_frequency_added_mass
    if far is not None or len(at_infinity):
        far = table.added_mass[at_infinity[0]] if far is None else far
        limits.append(("infinite", far, (DISC_HEAVE, DISC_PITCH)))
    limits += [("zero", table.added_mass[row], (LID_HEAVE, LID_PITCH)) for row in np.flatnonzero(table.omega == 0.0)]
    for limit, found, factors in limits:
        for motion, factor, power, unit in zip(("heave", "pitch"), factors, (3, 5), ("kg", "kg m²"), strict=True):
            if motion in table.dofs:
                place = table.dofs.index(motion)
                theory = factor * tank.layers[0].density * plate.radius**power
                yield compared(f"a of {motion} at {limit} frequency, rigid disc, {unit}", theory, found[place, place])


def _following(plate: RoundPlate, table: ResponseTable) -> Comparison:
    row = int(np.argmin(table.omega))
    theory = abs(following_heave(float(table.wavenumbers[row, 0]), plate.inner_radius, plate.radius))
    field = np.abs(table.amplitudes[row, 0, table.dofs.index("heave")])
    return compared(f"|heave| of a plate that follows the waves, at {table.omega[row]:.4g} rad/s, m/m", theory, field)


def _resonances(tank: Tank, plate: RoundPlate, table: ResonanceTable) -> Iterator[Comparison]:
    """Tones of an elastic plate, heave and pitch of a rigid disc, by estimates of tanks in a basin without reach."""
    if plate.tension:
        return
    layer = tank.layers[0]
    outlined = Plate(
        outline=Disc(radius=plate.radius, inner_radius=plate.inner_radius),
        flexural_rigidity=plate.flexural_rigidity,
        mass_per_area=plate.mass_per_area,
        poisson_ratio=plate.poisson_ratio,
    )
    wide = LevelTank(
        plan=Cylinder(radius=_WIDE * plate.radius),
        depth=layer.depth,
        density=layer.density,
        gravity=tank.gravity,
        plates=(outlined,),
    )
    for one in plate_estimates(wide):
        found = [
            omega.real
            for omega, label in zip(table.omega, table.labels, strict=True)
            if (label.is_first_elastic and f"of order {label.split()[1][0]}" in one.note) or label == one.motion
        ]
        if found:
            what = "the first elastic tone" if one.motion == "elastic" else one.motion
            yield compared(f"ω of {what}, {one.name}, rad/s", one.omega, min(found))
