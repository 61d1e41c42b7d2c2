"""Hydrodynamics of whole bodies with six motions each and the modes of beams, as the files of other programs hold them.

x along the waves, z upwards from the still level, x = 0 where the crest of the incident wave is at t = 0, time factor
e^{−iωt}; motions surge, sway, heave, roll, pitch, yaw, rotations about the centre of gravity, right-handed. A section
of some width has surge (its sway), heave and pitch (its roll, which is anticlockwise, with the opposite sign). A solid
of revolution, whose pitch lifts its side of x > 0 too, has the same in the plane y = 0, and what it has there in
surge and pitch it has in the plane x = 0 in sway and roll. What is not modelled is zero.

A beam has heave and pitch, and after the six motions one more for each hinge and each elastic mode, with deflections W
upwards, ∫W² dx = l. Its heave and pitch are those about its centre of gravity: with pitch a √3 (2x/l − 1) of its own,
whose slope is 2√3 a/l, the angle θ upwards to the right and the heave ζ of a centre at x = l/2 + d are

    a = θ l/(2√3),    heave of the middle ζ − θ d.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import degrees, sqrt

import numpy as np

from hydroelastic.fem.open_water.results import DIRECTIONS, Complexes, Floats, RadiationTable, ResponseTable
from hydroelastic.fem.time_domain.results import ImpulseResponseTable
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.tank import Tank

MOTIONS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")

# Place among the six motions, and sign, of each motion in the plane y = 0, and of those of solids in the plane x = 0.
_ALONG = {"sway": (0, 1.0), "surge": (0, 1.0), "heave": (2, 1.0), "roll": (4, -1.0), "pitch": (4, -1.0)}
_ACROSS = {"surge": (1, 1.0), "pitch": (3, 1.0)}


@dataclass(frozen=True, kw_only=True)
class WholeBody:
    """A rigid body at rest, SI units.

    Attributes:
        name: of the body.
        centre_of_gravity: (x, y, z), m.
        centre_of_buoyancy: (x, y, z), m.
        volume: displaced volume, m³.
        waterplane_area: m².
        modes: names of what moves beyond the six motions.
    """

    name: str
    centre_of_gravity: tuple[float, float, float]
    centre_of_buoyancy: tuple[float, float, float]
    volume: float
    waterplane_area: float
    modes: tuple[str, ...] = ()

    @property
    def motions(self) -> tuple[str, ...]:
        """All motions."""
        return (*MOTIONS, *self.modes)


@dataclass(frozen=True, kw_only=True)
class MotionsInWaves:
    """Motions of free bodies per unit elevation. Shapes: n frequencies, m motions.

    Attributes:
        omega: (n,) rad/s.
        direction: in which the waves travel, degrees.
        amplitudes: (n, m) m/m, rad/m.
    """

    omega: Floats
    direction: float
    amplitudes: Complexes


@dataclass(frozen=True, kw_only=True)
class WholeBodies:
    """Hydrodynamics of some bodies, SI units. Shapes: n frequencies, m motions of all, d directions, t times.

    Attributes:
        density: kg/m³.
        gravity: m/s².
        depth: m; may be infinite.
        bodies: the bodies.
        modelled: (m,) whether a motion is modelled.
        omega: (n,) rad/s, ascending, positive and finite.
        added_mass: (n, m, m) force by motion.
        radiation_damping: (n, m, m).
        limits: added mass at ω = 0, whose entries may be infinite, and at ω = ∞, each (m, m) or ``None``.
        directions: (d,) in which waves travel, degrees.
        froude_krylov_force: (n, d, m) per unit elevation.
        diffraction_force: (n, d, m).
        stiffness: (m, m) of hydrostatics and weight.
        bending_stiffness: (m, m) of elastic bodies.
        inertia: (m, m) of the bodies.
        motions: of free bodies in waves.
        impulse_times: (t,) s; ``None`` without impulse responses.
        impulse_response: (t, m, m) K; ``None`` without.
    """

    density: float
    gravity: float
    depth: float
    bodies: tuple[WholeBody, ...]
    modelled: np.ndarray
    omega: Floats
    added_mass: Floats
    radiation_damping: Floats
    limits: tuple[Floats | None, Floats | None]
    directions: Floats
    froude_krylov_force: Complexes
    diffraction_force: Complexes
    stiffness: Floats
    bending_stiffness: Floats
    inertia: Floats
    motions: tuple[MotionsInWaves, ...]
    impulse_times: Floats | None
    impulse_response: Floats | None

    @property
    def spans(self) -> tuple[slice, ...]:
        """Places of the motions of each body."""
        return _spans(self.bodies)

    @property
    def names(self) -> tuple[tuple[int, str], ...]:
        """Number of the body from 0, and name, of each motion."""
        return tuple((index, motion) for index, body in enumerate(self.bodies) for motion in body.motions)

    @property
    def excitation_force(self) -> Complexes:
        """(n, d, m) per unit elevation."""
        return self.froude_krylov_force + self.diffraction_force


def bodies_of_tables(
    tank: Tank,
    radiation: Sequence[RadiationTable],
    response: Sequence[ResponseTable],
    impulse_response: Sequence[ImpulseResponseTable],
    *,
    width: float = 1.0,
) -> WholeBodies:
    """Return whole bodies, each a section of some width or a solid of revolution."""
    dofs = radiation[0].dofs
    bodies = tuple(_at_rest(tank, index, width, radiation[0]) for index in range(len(tank.bodies)))
    along = _along(tank, bodies, dofs)
    planes = [along, _signs(bodies, dofs, _ACROSS)] if tank.geometry.is_revolved else [along]
    modelled = np.any(planes, axis=(0, 1))

    def matrix(values: np.ndarray) -> Floats:
        # Each motion is in one plane.
        whole: np.ndarray = width * sum(plane.T @ values @ plane for plane in planes)
        return whole

    def vector(values: np.ndarray) -> Complexes:
        return np.asarray(width * values @ along)

    rows = {float(omega): (table, row) for table in reversed(radiation) for row, omega in enumerate(table.omega)}
    omegas = sorted(omega for omega in rows if 0.0 < omega < np.inf)

    def stacked(name: str) -> np.ndarray:
        return np.array([getattr(rows[omega][0], name)[rows[omega][1]] for omega in omegas])

    def limit(omega: float) -> Floats | None:
        table, row = rows.get(omega, (None, 0))
        if table is None:
            return None
        # Infinite entries times zero would be no numbers.
        masses, grows = table.added_mass[row], np.isinf(table.added_mass[row])
        reached = sum(np.abs(plane).T @ grows @ np.abs(plane) for plane in planes) > 0.0
        return np.where(reached, np.inf, matrix(np.where(grows, 0.0, masses)))

    first = impulse_response[0] if impulse_response else None
    far = limit(np.inf)
    if far is None and first is not None:
        far = matrix(first.infinite_frequency_added_mass)
    # Hydrostatics are ρg∫W² of any deflection W; what is more is bending.
    elastic = [dof.is_elastic for dof in dofs]
    weight = tank.layers[0].density * tank.gravity
    areas = [(end - start) for start, end in (tank.bodies[(dof.body or 1) - 1].waterplane for dof in dofs)]
    bending = np.diag((np.diag(radiation[0].stiffness) - weight * np.array(areas)) * elastic)
    return WholeBodies(
        density=tank.layers[0].density,
        gravity=tank.gravity,
        depth=tank.layers[0].depth,
        bodies=bodies,
        modelled=modelled,
        omega=np.array(omegas),
        added_mass=matrix(stacked("added_mass")),
        radiation_damping=matrix(stacked("radiation_damping")),
        limits=(limit(0.0), far),
        directions=np.degrees(DIRECTIONS),
        # There is one wave in one liquid.
        froude_krylov_force=vector(stacked("froude_krylov_force")[:, 0]),
        diffraction_force=vector(stacked("diffraction_force")[:, 0]),
        stiffness=matrix(radiation[0].stiffness - bending),
        bending_stiffness=matrix(bending),
        inertia=matrix(radiation[0].inertia),
        motions=tuple(
            MotionsInWaves(
                omega=table.omega,
                direction=degrees(DIRECTIONS[0 if table.waves_from == "left" else 1]),
                amplitudes=table.amplitudes[:, 0, [table.dofs.index(dof) for dof in dofs]] @ np.linalg.pinv(along).T,
            )
            for table in response
            if set(dofs) <= set(table.dofs)
        ),
        impulse_times=None if first is None else first.times,
        impulse_response=None if first is None else matrix(first.impulse_response),
    )


def _along(tank: Tank, bodies: tuple[WholeBody, ...], dofs: tuple[Dof, ...]) -> np.ndarray:
    """Motions of the tables by a unit of each motion of the files, in the plane y = 0, shape (dofs, m)."""
    plane = _signs(bodies, dofs, _ALONG)
    pitch = MOTIONS.index("Pitch")
    for row, dof in enumerate(dofs):
        index = (dof.body or 1) - 1
        body, at = bodies[index], _spans(bodies)[index].start
        if dof.motion.capitalised in body.modes:
            plane[row, at + body.motions.index(dof.motion.capitalised)] = 1.0
        elif index in tank.beams:
            # A pitch to the right is a negative slope.
            left, right = tank.beams[index].waterplane
            off = body.centre_of_gravity[0] + tank.phase_at - 0.5 * (left + right)
            plane[row, at + pitch] = off if dof.motion == "heave" else (left - right) / (2.0 * sqrt(3.0))
    return plane


def _signs(bodies: tuple[WholeBody, ...], dofs: tuple[Dof, ...], motions: dict[str, tuple[int, float]]) -> np.ndarray:
    """The same of rigid motions, by place and sign, shape (dofs, m)."""
    spans = _spans(bodies)
    plane = np.zeros((len(dofs), spans[-1].stop))
    for row, dof in enumerate(dofs):
        if dof.motion in motions:
            place, sign = motions[dof.motion]
            plane[row, spans[(dof.body or 1) - 1].start + place] = sign
    return plane


def _spans(bodies: tuple[WholeBody, ...]) -> tuple[slice, ...]:
    ends = np.cumsum([0, *(len(body.motions) for body in bodies)]).tolist()
    return tuple(slice(first, last) for first, last in pairwise(ends))


def _at_rest(tank: Tank, index: int, width: float, radiation: RadiationTable) -> WholeBody:
    if index in tank.beams:
        return _beam_at_rest(tank, index, width, radiation)
    rest = tank.floats[index].hydrostatics

    def point(at: tuple[float, float]) -> tuple[float, float, float]:
        return at[0] - tank.phase_at, 0.0, at[1] - rest.level

    return WholeBody(
        name=f"body_{index + 1}",
        centre_of_gravity=point(rest.centre_of_mass),
        centre_of_buoyancy=point(rest.centroids[0]),
        volume=width * rest.areas[0],
        waterplane_area=width * rest.heave_stiffness / (tank.layers[0].density * tank.gravity),
    )


def _beam_at_rest(tank: Tank, index: int, width: float, radiation: RadiationTable) -> WholeBody:
    """A beam has no draught; it displaces its mass."""
    own = {str(dof.motion): row for row, dof in enumerate(radiation.dofs) if (dof.body or 1) - 1 == index}
    left, right = tank.beams[index].waterplane
    mass, moment = (float(radiation.inertia[own["heave"], own[name]]) for name in ("heave", "pitch"))
    # ∫ m √3 (2x/l − 1) dx over ∫ m dx.
    centre = 0.5 * (left + right) + moment / mass * (right - left) / (2.0 * sqrt(3.0)) - tank.phase_at
    return WholeBody(
        name=f"body_{index + 1}",
        centre_of_gravity=(centre, 0.0, 0.0),
        centre_of_buoyancy=(centre, 0.0, 0.0),
        volume=width * mass / tank.layers[0].density,
        waterplane_area=width * (right - left),
        modes=tuple(Dof(motion).capitalised for motion in own if motion not in ("heave", "pitch")),
    )
