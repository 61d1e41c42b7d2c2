"""Hydrodynamics of whole rigid bodies with six motions each, as the files of other programs hold them.

x along the waves, z upwards from the still level, x = 0 where the crest of the incident wave is at t = 0, time factor
e^{−iωt}; motions surge, sway, heave, roll, pitch, yaw, rotations about the centre of gravity, right-handed. A section
of some width has surge (its sway), heave and pitch (its roll, which is anticlockwise, with the opposite sign). A solid
of revolution, whose pitch lifts its side of x > 0 too, has the same in the plane y = 0, and what it has there in
surge and pitch it has in the plane x = 0 in sway and roll. What is not modelled is zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

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
    """

    name: str
    centre_of_gravity: tuple[float, float, float]
    centre_of_buoyancy: tuple[float, float, float]
    volume: float
    waterplane_area: float


@dataclass(frozen=True, kw_only=True)
class MotionsInWaves:
    """Motions of free bodies per unit elevation. Shapes: n frequencies, N bodies.

    Attributes:
        omega: (n,) rad/s.
        direction: in which the waves travel, degrees.
        amplitudes: (n, 6N) m/m, rad/m.
    """

    omega: Floats
    direction: float
    amplitudes: Complexes


@dataclass(frozen=True, kw_only=True)
class WholeBodies:
    """Hydrodynamics of N bodies, SI units. Shapes: n frequencies, d directions, t times.

    Attributes:
        density: kg/m³.
        gravity: m/s².
        depth: m; may be infinite.
        bodies: the bodies.
        modelled: (6N,) whether a motion is modelled.
        omega: (n,) rad/s, ascending, positive and finite.
        added_mass: (n, 6N, 6N) force by motion.
        radiation_damping: (n, 6N, 6N).
        limits: added mass at ω = 0 and at ω = ∞, each (6N, 6N) or ``None``.
        directions: (d,) in which waves travel, degrees.
        froude_krylov_force: (n, d, 6N) per unit elevation.
        diffraction_force: (n, d, 6N).
        stiffness: (6N, 6N) of hydrostatics and weight.
        inertia: (6N, 6N) of the bodies.
        motions: of free bodies in waves.
        impulse_times: (t,) s; ``None`` without impulse responses.
        impulse_response: (t, 6N, 6N) K; ``None`` without.
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
    inertia: Floats
    motions: tuple[MotionsInWaves, ...]
    impulse_times: Floats | None
    impulse_response: Floats | None

    @property
    def excitation_force(self) -> Complexes:
        """(n, d, 6N) per unit elevation."""
        return self.froude_krylov_force + self.diffraction_force


def bodies_of_tables(
    tank: Tank,
    radiation: Sequence[RadiationTable],
    response: Sequence[ResponseTable],
    impulse_response: Sequence[ImpulseResponseTable],
    *,
    width: float = 1.0,
) -> WholeBodies:
    """Return whole bodies, each a section of some width or a solid of revolution.

    Args:
        tank: open water with one liquid and floats only.
        radiation: analyses of radiation, at least one with a frequency that is positive and finite; of several with the
            same frequency the first is taken.
        response: analyses of the response; those whose motions differ from those of radiation are left out.
        impulse_response: analyses of impulse responses; the first one is taken.
        width: of sections, m; 1 of solids.
    """
    count = 6 * len(tank.bodies)
    dofs = radiation[0].dofs
    along, across = _Plane(dofs, _ALONG), _Plane(dofs, _ACROSS if tank.geometry.is_revolved else {})

    def matrix(values: np.ndarray) -> Floats:
        whole = np.zeros((*values.shape[:-2], count, count))
        for plane in (across, along):
            whole[..., plane.places[:, None], plane.places] = (
                width * values[..., plane.own[:, None], plane.own] * (np.outer(plane.signs, plane.signs))
            )
        return whole

    def vector(values: np.ndarray, scale: float) -> Complexes:
        whole = np.zeros((*values.shape[:-1], count), dtype=complex)
        whole[..., along.places] = scale * values * along.signs
        return whole

    rows = {float(omega): (table, row) for table in reversed(radiation) for row, omega in enumerate(table.omega)}
    omegas = sorted(omega for omega in rows if 0.0 < omega < np.inf)

    def stacked(name: str) -> np.ndarray:
        return np.array([getattr(rows[omega][0], name)[rows[omega][1]] for omega in omegas])

    def limit(omega: float) -> Floats | None:
        table, row = rows.get(omega, (None, 0))
        return None if table is None else matrix(table.added_mass[row])

    first = impulse_response[0] if impulse_response else None
    far = limit(np.inf)
    if far is None and first is not None:
        far = matrix(first.infinite_frequency_added_mass)
    modelled = np.zeros(count, dtype=bool)
    modelled[[*along.places, *across.places]] = True
    return WholeBodies(
        density=tank.layers[0].density,
        gravity=tank.gravity,
        depth=tank.layers[0].depth,
        bodies=tuple(_at_rest(tank, index, width) for index in range(len(tank.bodies))),
        modelled=modelled,
        omega=np.array(omegas),
        added_mass=matrix(stacked("added_mass")),
        radiation_damping=matrix(stacked("radiation_damping")),
        limits=(limit(0.0), far),
        directions=np.degrees(DIRECTIONS),
        # There is one wave in one liquid.
        froude_krylov_force=vector(stacked("froude_krylov_force")[:, 0], width),
        diffraction_force=vector(stacked("diffraction_force")[:, 0], width),
        stiffness=matrix(radiation[0].stiffness),
        inertia=matrix(radiation[0].inertia),
        motions=tuple(
            MotionsInWaves(
                omega=table.omega,
                direction=degrees(DIRECTIONS[0 if table.waves_from == "left" else 1]),
                amplitudes=vector(table.amplitudes[:, 0], 1.0),
            )
            for table in response
            if table.dofs == dofs
        ),
        impulse_times=None if first is None else first.times,
        impulse_response=None if first is None else matrix(first.impulse_response),
    )


class _Plane:
    """The motions in a vertical plane: their indices `own` among all, `places` among six of each body, and `signs`."""

    def __init__(self, dofs: tuple[Dof, ...], motions: dict[str, tuple[int, float]]) -> None:
        self.own = np.array([place for place, dof in enumerate(dofs) if dof.motion in motions], dtype=int)
        chosen = [dofs[place] for place in self.own]
        self.places = np.array([6 * ((dof.body or 1) - 1) + motions[dof.motion][0] for dof in chosen], dtype=int)
        self.signs = np.array([motions[dof.motion][1] for dof in chosen])


def _at_rest(tank: Tank, index: int, width: float) -> WholeBody:
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
