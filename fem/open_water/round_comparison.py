"""Comparison of closed forms and older estimates with the field solution of one body of revolution."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from hydroelastic.fem.open_water.plate_comparison import plate_comparisons
from hydroelastic.fem.open_water.results import RadiationTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.thin_float_theory import Comparison, compared
from hydroelastic.modal.floats.round_bodies import depth_integrals, haskind_damping, standing_cylinder, strip_force
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import Tank

# Relative difference of a solid's volume from that of an upright cylinder, by rounding.
_ALIKE = 1e-9


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
