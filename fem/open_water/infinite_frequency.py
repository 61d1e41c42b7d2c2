"""The infinite-frequency limit of open water, see `fem/tank/infinite_frequency.py`: no waves are radiated."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.added_mass import body_responses
from hydroelastic.fem.open_water.attempts import best_in_basin
from hydroelastic.fem.open_water.basin import open_basin, sized_absorbing_layer
from hydroelastic.fem.open_water.field_model import ANGLE, GROWTH, NO_WATER
from hydroelastic.fem.open_water.model_building import open_mesh
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import added_mass_errors
from hydroelastic.fem.tank.field_model import build_field_model, distributed_mesh, whole_bodies
from hydroelastic.fem.tank.resolution import Resolution, infinite_frequency_resolution, workable_tolerance
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.scales import Scales

# Elastic dry modes of each beam for approximate frequencies.
_SHAPES = 14
# Stiffness below this part of the largest is rounding.
_NEUTRAL = 1e-11
# Wavenumber that stands for the size of the basin, as there are no waves.
_NO_WAVE = 1.0


@dataclass(frozen=True, kw_only=True)
class BodiesAtInfiniteFrequency:
    """The bodies with their added mass at infinite frequency, dimensionless."""

    units: Scales  # units of length and frequency
    stiffness: np.ndarray  # K, shape (body unknowns, body unknowns)
    mass: np.ndarray  # M_b, shape (body unknowns, body unknowns)
    added_mass: np.ndarray  # a(∞), shape (body unknowns, body unknowns)
    of_floats: np.ndarray  # whether each unknown belongs to a float, shape (body unknowns,)
    motions: tuple[tuple[int, Dof], ...]  # index of the body and degree of freedom of each unknown

    def frequencies(self, *, floats: bool = False) -> list[float]:
        """Natural frequencies with this added mass, rad/s, ascending, of the motions with restoring force."""
        chosen = np.flatnonzero(self.of_floats) if floats else np.arange(len(self.stiffness))
        stiffness, whole = self.stiffness[np.ix_(chosen, chosen)], (self.mass + self.added_mass)[np.ix_(chosen, chosen)]
        if np.abs(stiffness - np.diag(np.diag(stiffness))).any():
            # Springs couple the motions: unknowns in which the stiffness is diagonal replace them.
            stiffness, vectors = np.linalg.eigh(scaled_stiffness(stiffness, whole))
            stiffness[np.abs(stiffness) < _NEUTRAL * np.abs(stiffness).max()] = 0.0
            roots = np.sqrt(np.diag(whole))
            stiffness, whole = np.diag(stiffness), vectors.T @ (whole / np.outer(roots, roots)) @ vectors
        restoring = np.diag(stiffness)
        restored, loose = np.flatnonzero(restoring > 0.0), np.flatnonzero(restoring <= 0.0)
        if not len(restored):
            return []
        # Unknowns without stiffness are eliminated. As the largest 1/λ, low frequencies beside high ones keep their
        # digits.
        coupling = whole[np.ix_(loose, restored)]
        moving = whole[np.ix_(restored, restored)] - coupling.T @ np.linalg.solve(whole[np.ix_(loose, loose)], coupling)
        roots = np.sqrt(restoring[restored])
        inverse = np.linalg.eigvalsh(moving / roots / roots[:, None])[::-1]
        return [self.units.frequency / sqrt(value) for value in inverse if value > 0.0]


def scaled_stiffness(stiffness: np.ndarray, inertia: np.ndarray | None = None) -> np.ndarray:
    """Return a stiffness between unknowns of one scale: of unit inertia, or else of unit stiffness."""
    sizes = np.abs(np.diag(stiffness if inertia is None else inertia))
    roots = np.sqrt(np.where(sizes > 0.0, sizes, 1.0))
    scaled: np.ndarray = stiffness / np.outer(roots, roots)
    return scaled


def bodies_at_infinite_frequency(problem: OpenWaterProblem) -> BodiesAtInfiniteFrequency:
    """Return the bodies with as many dry modes as approximate natural frequencies need (collective)."""
    basin = open_basin(problem.tank, 0.0)
    shapes = tuple(len(body.rigid_motions) + _SHAPES if body.is_elastic else 0 for body in basin.tank.bodies)
    added, _ = infinite_frequency_added_mass(problem.rough(), shapes)
    bodies = whole_bodies(basin.tank, shapes)
    return BodiesAtInfiniteFrequency(
        units=basin.units,
        stiffness=np.diag(np.concatenate([body.stiffness for body in bodies]))
        + outside_of(basin, bodies, problem.tank.attachments).stiffness,
        mass=block_diag(*(body.mass for body in bodies)),
        added_mass=added,
        motions=tuple((index, dof) for index, body in enumerate(bodies) for dof in body.dofs),
        of_floats=np.concatenate([np.full(body.size, index in basin.tank.rigid) for index, body in enumerate(bodies)]),
    )


def infinite_frequency_added_mass(problem: OpenWaterProblem, shapes: tuple[int, ...]) -> tuple[np.ndarray, float]:
    """Return the added mass at infinite frequency to the tolerance of the problem (collective)."""
    basin = open_basin(problem.tank, 0.0)
    tank = basin.tank
    tolerance = workable_tolerance(problem.tolerance, tank.depth)
    first = infinite_frequency_resolution(tank, tolerance, ())

    def solve(resolution: Resolution) -> Attempt[np.ndarray]:
        absorbing_layer = sized_absorbing_layer(
            basin, (_NO_WAVE, _NO_WAVE), first=0.5, growth=GROWTH, angle=ANGLE, tolerance=tolerance
        )
        mesh = distributed_mesh(
            problem.comm, lambda: open_mesh(basin, resolution, absorbing_layer, infinite_frequency=True)
        )
        pencil = build_field_model(mesh, tank, degree=resolution.degree, shapes=shapes, infinite_frequency=True)
        matrix, potentials = body_responses(pencil)
        inertia = np.concatenate([np.diag(body.mass) for body in pencil.bodies])
        scale = np.maximum(np.diag(matrix), NO_WATER * inertia)
        causes = added_mass_errors(pencil.liquid, potentials, scale, tank, resolution, half=False)
        return Attempt(result=matrix, causes=causes, resolution=resolution)

    best = best_in_basin(tank, tolerance, solve, replace(first, shapes=shapes), infinite_frequency=True)
    return best.result, best.error
