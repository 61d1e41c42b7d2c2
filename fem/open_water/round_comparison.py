"""Comparison of closed forms and older estimates with the field solution of one body of revolution."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi

import numpy as np

from hydroelastic.fem.open_water.results import RadiationTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.thin_float_theory import Comparison
from hydroelastic.modal.floats.round_bodies import (
    DISC_HEAVE,
    DISC_PITCH,
    depth_integrals,
    haskind_damping,
    standing_cylinder,
)
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Relative difference of a solid's volume from that of an upright cylinder, by rounding.
_ALIKE = 1e-9


def round_comparisons(tank: Tank, solution: OpenWaterSolution) -> tuple[Comparison, ...]:
    """Compare the forces on a lone body of revolution in one liquid with closed forms and estimates.

    Args:
        tank: the sea in SI units.
        solution: the field solution.
    """
    if not tank.geometry.is_revolved or len(tank.bodies) > 1 or len(tank.layers) > 1:
        return ()
    return tuple(row for table in solution.radiation for row in _rows(tank, table))


def _rows(tank: Tank, table: RadiationTable) -> Iterator[Comparison]:
    body, layer = tank.bodies[0], tank.layers[0]
    inner, outer = body.waterplane
    finite = np.flatnonzero(np.isfinite(table.omega) & (table.omega > 0.0))
    if isinstance(body, RoundPlate) and layer.depth == inf and not inner:
        found = table.infinite_frequency_added_mass
        at_infinity = np.flatnonzero(np.isinf(table.omega))
        found = table.added_mass[at_infinity[0]] if found is None and len(at_infinity) else found
        for motion, factor, power in (("heave", DISC_HEAVE, 3), ("pitch", DISC_PITCH, 5)):
            if found is not None and motion in table.dofs:
                place = table.dofs.index(motion)
                theory = factor * layer.density * outer**power
                unit = "kg" if motion == "heave" else "kg m²"
                yield _compared(f"a of {motion} at infinite frequency, rigid disc, {unit}", theory, found[place, place])
    if not len(finite):
        return
    weight = layer.density * tank.gravity
    if "heave" in table.dofs:
        heave, slow = table.dofs.index("heave"), finite[np.argmin(table.omega[finite])]
        omega, k = float(table.omega[slow]), float(table.wavenumbers[slow, 0])
        force = table.stiffness[heave, heave]
        spread = depth_integrals(k, layer.depth, 0.0)[2]
        theory = haskind_damping(0, omega, force, spread, layer.density, tank.gravity)
        yield _compared(
            f"|X| of heave in long waves, at {omega:.4g} rad/s, N/m",
            force,
            float(np.abs(table.excitation_force[slow, 0, 0, heave])),
        )
        yield _compared(
            f"b of heave by Haskind from long waves, at {omega:.4g} rad/s, kg/s",
            theory,
            table.radiation_damping[slow, heave, heave],
        )
    if isinstance(body, RigidFloat) and "surge" in table.dofs and _is_upright(body, layer.density):
        yield from _standing(tank, table, finite, -body.hull.bounds[2], weight)


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
    """Whether a solid is an upright cylinder about the axis."""
    left, right = body.waterplane
    volume = pi * right**2 * -body.hull.bounds[2]
    return left < 0.0 and abs(body.hydrostatics.mass / (density * volume) - 1.0) < _ALIKE


def _compared(quantity: str, theory: float, field: float) -> Comparison:
    return Comparison(quantity=quantity, theory=theory, field=float(field), difference=float((theory - field) / field))
