"""The elevation of the water around solids of revolution, in plan view.

At a distance r and an angle θ from the direction in which the waves travel, per unit elevation of these,

    η = e^{ikx} + Σₙ εₙ iⁿ λψₙ(r)/η̂ cos nθ,

with the scattered ψₙ of each order, solved for once more in a basin as wide as the picture, and the elevation η̂ of the
wave Jₙ Z of which it is scattered.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD, Circular
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.results import ResponseTable
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.surface_line import along_the_surface
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import Tank

# Distance from the bodies to the edge of a picture, in radians of the wave, and at most in radii of the bodies: beside
# long waves they would not be seen.
_RADIANS, _RADII = 13.0, 12.0
# Points along each arc of a body's outline.
_ALONG_ARC = 25


@dataclass(frozen=True, kw_only=True)
class MovingSolid:
    """A rigid body about the axis that moves in the waves."""

    # r and z of its section from its contour, r ≥ 0, closed by the axis unless it is a ring, m, shape (points, 2)
    outline: np.ndarray
    surge: complex = 0.0  # complex, m per metre of elevation
    heave: complex = 0.0  # likewise
    pitch: complex = 0.0  # rad per metre of elevation, about `centre`
    centre: float = 0.0  # height of the centre of mass, m


@dataclass(frozen=True, kw_only=True)
class PlanWaves:
    """The elevation around solids of revolution, and of round plates, in waves towards +x, per unit of theirs."""

    name: str  # name of its files
    title: str  # one line of text
    omega: float  # ω, rad/s
    radii: np.ndarray  # r, m, ascending, shape (points,); between free surfaces there are bodies
    wavenumber: float  # k, 1/m
    phase_at: float  # x at which the crest of the incident wave is at t = 0, m
    orders: np.ndarray  # the scattered and radiated waves of each azimuthal order, complex, shape (orders, points)
    waterplanes: tuple[tuple[float, float], ...]  # inner and outer radius of each rigid body in the water, m
    # radii of each elastic plate, m, shape (points,), and Wₙ there, complex, shape (orders, points)
    plates: tuple[tuple[np.ndarray, np.ndarray], ...] = ()
    solids: tuple[MovingSolid, ...] = ()  # the rigid bodies

    def elevation(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the complex elevation of water and plates at places, NaN in rigid bodies and beyond the largest
        radius; shape of x."""
        r, angle = np.hypot(x, y), np.arctan2(y, x)
        total = np.exp(1j * self.wavenumber * (x - self.phase_at)) + _around(self.radii, self.orders, r, angle)
        for radii, orders in self.plates:
            total = np.where((radii[0] <= r) & (r <= radii[-1]), _around(radii, orders, r, angle), total)
        dry = r > self.radii[-1]
        for inner, outer in self.waterplanes:
            dry |= (inner < r) & (r < outer)
        return np.where(dry, np.nan, total)


def _around(radii: np.ndarray, orders: np.ndarray, r: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Σ fₙ(r) cos nθ of functions at radii, shape (orders, points)."""
    parts = (np.interp(r, radii, part) * np.cos(order * angle) for order, part in enumerate(orders))
    return np.asarray(sum(parts, np.zeros(r.shape, dtype=complex)))


def plan_waves(problem: OpenWaterProblem, table: ResponseTable, number: int) -> Iterator[PlanWaves]:
    """Yield the elevation at the frequencies asked for, or else where the motion of a body is largest, on rank 0
    (collective)."""
    if table.partial_waves is None or len(table.waves) > 1 or table.waves_from != "left":
        return
    omegas = table.fields_at or (_of_largest_motion(table),)
    for place, omega in enumerate(omegas, 1):
        band = Band(lowest=omega, highest=omega)
        radii, orders = _scattered(problem, band, table.partial_waves.shape[-1], table.wave_amplitude)
        if problem.comm.rank:
            continue
        row = int(np.abs(table.omega - omega).argmin())
        bodies = [body.waterplane for body in problem.tank.bodies if not body.flexural_sections]
        why = "" if table.fields_at else ", where a motion is largest"
        yield PlanWaves(
            name=f"response_{number}" + (f"_{place:03d}" if len(omegas) > 1 else ""),
            title=f"Waves from the left around the bodies at ω = {omega:.5g} rad/s{why}",
            omega=omega,
            radii=radii,
            wavenumber=band.wavenumbers(problem.tank)[1],
            phase_at=problem.tank.phase_at,
            orders=orders,
            waterplanes=tuple((max(left, 0.0), right) for left, right in bodies),
            plates=tuple(
                (plate.radii, plate.derivatives[0, row, 0])
                for plate in table.round_plates
                if problem.tank.bodies[plate.body].flexural_sections
            ),
            solids=tuple(_moving(problem.tank, table, row)),
        )


def _of_largest_motion(table: ResponseTable) -> float:
    shown = [dof for dof in table.dofs if dof.is_elastic] or [dof for dof in table.dofs if not dof.is_rotation]
    sizes = np.where([dof in shown for dof in table.dofs], np.abs(table.amplitudes[:, 0]), 0.0).max(axis=1)
    return float(table.omega[np.argmax(sizes)])


def _scattered(problem: OpenWaterProblem, band: Band, orders: int, amplitude: float) -> tuple[np.ndarray, np.ndarray]:
    """Radii, m, to two wavelengths beyond the bodies, and εₙ iⁿ λψₙ/η̂ of the orders there, in waves of an amplitude, m,
    on which the damping by drag depends (collective)."""
    wavenumber = band.wavenumbers(problem.tank)[1]
    reach = max(right for _, right in (body.waterplane for body in problem.tank.bodies))
    drawn = min(_RADIANS, _RADII * reach * wavenumber)
    reach += drawn / wavenumber
    rough = problem.rough()
    rough = replace(rough, tank=replace(rough.tank, start=-reach, length=2.0 * reach))
    parts = []
    for order in range(orders):
        own = rough.of_order(order)
        resolution = first_resolution(own.tank, own.tolerance, band, drawn=drawn)
        model = open_model(own, band, resolution, drawn=drawn)
        solver = OpenSolver(model)
        solver.elevation = amplitude
        found = solver.response(band.lowest, [0])
        wave = found.incidence.planes[0]
        assert isinstance(wave, Circular)
        psi = found.squared * found.scattered[0] / wave.elevation
        vectors = [model.pencil.vector(part) for part in (psi.real, psi.imag)]
        r, (real, imaginary) = along_the_surface(model.pencil.liquid, vectors, model.basin.bounds[1][0])
        scattered = real + 1j * imaginary
        parts.append((r * model.basin.units.length, wave.part(RIGHTWARD, model.basin) * scattered))
    radii = parts[0][0]
    return radii, np.array([np.interp(radii, r, values) for r, values in parts])


def _moving(tank: Tank, table: ResponseTable, row: int) -> Iterator[MovingSolid]:
    for index, body in enumerate(tank.bodies):
        if not isinstance(body, RigidFloat):
            continue
        points = np.vstack([arc.point(np.linspace(0.0, 1.0, _ALONG_ARC)) for arc in body.hull.contour.arcs])
        own = {
            str(dof.motion): complex(amplitude)
            for dof, amplitude in zip(table.dofs, table.amplitudes[row, 0], strict=True)
            if (dof.body or 1) - 1 == index
        }
        yield MovingSolid(outline=_right_half(points), centre=body.hydrostatics.centre_of_mass[1], **own)


def _right_half(points: np.ndarray) -> np.ndarray:
    """The part of a closed section at r ≥ 0, from the axis around to it; all of a ring's."""
    right = points[:, 0] > 0.0
    if right.all():
        return np.vstack([points, points[:1]])
    # Counterclockwise it enters the right half at the bottom.
    first = int(np.flatnonzero(right & ~np.roll(right, 1))[0])
    turned, count = np.roll(points, -first, axis=0), int(right.sum())
    half = turned[:count]
    return np.vstack([[[0.0, half[0, 1]]], half, [[0.0, half[-1, 1]]]])
