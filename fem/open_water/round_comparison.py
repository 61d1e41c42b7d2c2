"""Comparison of closed forms and older estimates with the field solution of one body of revolution."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi

import numpy as np

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.results import RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.thin_float_theory import Comparison, compared
from hydroelastic.modal.floats.round_bodies import (
    DISC_HEAVE,
    DISC_PITCH,
    LID_HEAVE,
    LID_PITCH,
    depth_integrals,
    following_heave,
    haskind_damping,
    standing_cylinder,
    strip_force,
)
from hydroelastic.modal.plate.estimates import plate_estimates
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.level_tank import Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Relative difference of a solid's volume from that of an upright cylinder, by rounding.
_ALIKE = 1e-9

# Radius, in those of the plate, of a basin whose walls are out of its reach: their part of a rigid disc's is its cube.
_WIDE = 20.0


def round_comparisons(tank: Tank, solution: OpenWaterSolution) -> tuple[Comparison, ...]:
    """Compare the forces on a lone body of revolution in one liquid, and motions of a plate, with closed forms and
    estimates."""
    if not tank.geometry.is_revolved or len(tank.bodies) > 1 or len(tank.layers) > 1:
        return ()
    rows = [row for table in solution.radiation for row in _rows(tank, table)]
    if not isinstance(tank.bodies[0], RigidFloat):
        rows += plate_comparisons(tank, solution)
    return tuple(rows)


def _rows(tank: Tank, table: RadiationTable) -> Iterator[Comparison]:
    body, layer = tank.bodies[0], tank.layers[0]
    finite = np.flatnonzero(np.isfinite(table.omega) & (table.omega > 0.0))
    if not len(finite):
        return
    weight, slow = layer.density * tank.gravity, int(finite[np.argmin(table.omega[finite])])
    if "heave" in table.dofs:
        heave = table.dofs.index("heave")
        omega, k = float(table.omega[slow]), float(table.wavenumbers[slow, 0])
        force = table.stiffness[heave, heave]
        spread = depth_integrals(k, layer.depth, 0.0)[2]
        theory = haskind_damping(0, omega, force, spread, layer.density, tank.gravity)
        yield compared(
            f"|X| of heave in long waves, at {omega:.4g} rad/s, N/m",
            force,
            np.abs(table.excitation_force[slow, 0, 0, heave]),
        )
        yield compared(
            f"b of heave by Haskind from long waves, at {omega:.4g} rad/s, kg/s",
            theory,
            table.radiation_damping[slow, heave, heave],
        )
    if isinstance(body, RigidFloat) and "surge" in table.dofs and body.waterplane[0] < 0.0:
        surge = table.dofs.index("surge")
        yield compared(
            f"a of surge by strips, at {table.omega[slow]:.4g} rad/s, kg",
            body.hydrostatics.displaced_mass,
            table.added_mass[slow, surge, surge],
        )
        if _is_upright(body, layer.density):
            yield from _standing(tank, table, finite, -body.hull.bounds[2], weight)
        else:
            yield from _strips(tank, body, table, slow, weight)


def _strips(tank: Tank, body: RigidFloat, table: RadiationTable, slow: int, weight: float) -> Iterator[Comparison]:
    layer, surge = tank.layers[0], table.dofs.index("surge")
    k, omega = float(table.wavenumbers[slow, 0]), float(table.omega[slow])
    force = strip_force(body.hull.below, k, layer.depth, weight)
    spread = depth_integrals(k, layer.depth, 0.0)[2]
    theory = haskind_damping(1, omega, force, spread, layer.density, tank.gravity)
    yield compared(
        f"|X| of surge by strips, at {omega:.4g} rad/s, N/m",
        force,
        np.abs(table.excitation_force[slow, 0, 0, surge]),
    )
    yield compared(
        f"b of surge by Haskind from that, at {omega:.4g} rad/s, kg/s",
        theory,
        table.radiation_damping[slow, surge, surge],
    )


def _standing(
    tank: Tank, table: RadiationTable, finite: np.ndarray, draught: float, weight: float
) -> Iterator[Comparison]:
    """Surge of an upright cylinder by the pressures on one that stands on the bed, over its draught."""
    layer, radius, surge = tank.layers[0], tank.bodies[0].waterplane[1], table.dofs.index("surge")
    forces, dampings = [], []
    for place in finite:
        k, omega = float(table.wavenumbers[place, 0]), float(table.omega[place])
        force = abs(standing_cylinder(k, layer.depth, radius, draught, weight)[0])
        spread = depth_integrals(k, layer.depth, draught)[2]
        forces.append(force)
        dampings.append(haskind_damping(1, omega, force, spread, layer.density, tank.gravity))
    for name, theory, field in (
        (
            "|X| of surge by MacCamy and Fuchs, at {:.4g} rad/s, N/m",
            forces,
            np.abs(table.excitation_force[finite, 0, 0, surge]),
        ),
        (
            "b of surge by Haskind from that, at {:.4g} rad/s, kg/s",
            dampings,
            table.radiation_damping[finite, surge, surge],
        ),
    ):
        differences = (np.array(theory) - field) / field.max()
        worst = int(np.argmax(np.abs(differences)))
        yield Comparison(
            quantity=name.format(table.omega[finite][worst]),
            theory=float(theory[worst]),
            field=float(field[worst]),
            difference=float(differences[worst]),
        )


def _is_upright(body: RigidFloat, density: float) -> bool:
    """Whether a solid that the axis passes through is an upright cylinder."""
    volume = pi * body.waterplane[1] ** 2 * -body.hull.bounds[2]
    return abs(body.hydrostatics.displaced_mass / (density * volume) - 1.0) < _ALIKE


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
