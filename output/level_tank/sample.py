"""Modes of a tank in three dimensions at places of the surface and of the volume, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.level_bed.solution import LevelSolution, PlanProblem
from hydroelastic.fem.plan.patches import Patch
from hydroelastic.output.reading import Reading
from hydroelastic.physics.dofs import body_name

# Horizontal layers of the volume.
_LEVELS = 12


@dataclass(frozen=True, kw_only=True)
class SampledModes:
    """Mode shapes of a solved tank; of a volume over several processes, the part of the volume of this one.

    Attributes:
        points: x and y on the still surface, m, shape (points, 2).
        triangles: numbers of their corners, shape (triangles, 3).
        plate_of_points: number of the plate at each point, from 1; 0 is water.
        plate_of_triangles: the same of each triangle.
        names: of the shapes: 001, or 002_cos and 002_sin of a pair.
        numbers: number of the mode of each shape, from 0.
        elevations: upward displacement, m, at unit generalized mass, shape (shapes, points).
        volume_points: places in the liquid, m, shape (volume points, 3).
        volume_cells: kind of the cells between them, as meshio calls it, and numbers of their nodes.
        potentials: ψ at these places, m², shape (shapes, volume points).
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    plate_of_points: NDArray[np.int32]
    plate_of_triangles: NDArray[np.int32]
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    elevations: NDArray[np.float64]
    volume_points: NDArray[np.float64]
    volume_cells: tuple[str, NDArray[np.int64]]
    potentials: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SampledTank:
    """A solved tank with its mode shapes, which are written and drawn.

    Attributes:
        solved: the solution with its scene.
        sample: the shapes.
        summary: what is written of it.
    """

    solved: Any
    sample: SampledModes
    summary: Reading

    @property
    def tank(self) -> LevelSolution:
        """The field solution."""
        found: LevelSolution = self.solved.tank
        return found

    def __getattr__(self, name: str) -> Any:
        return getattr(self.solved, name)


def sample_modes(solution: LevelSolution, patches: tuple[Patch, ...]) -> SampledModes:
    """Return all modes at the points of the patches; the sign is such that the largest displacement is positive."""
    scale = solution.units.length
    offsets = np.cumsum([0, *(len(patch.points) for patch in patches)])
    points = np.concatenate([patch.points for patch in patches])
    depth = solution.tank.depth
    # Denser towards the surface.
    levels = -depth * np.linspace(0.0, 1.0, _LEVELS + 1) ** 2
    unit = _unit(solution)
    names, numbers, elevations, potentials = [], [], [], []
    for number, one in enumerate(solution.modes):
        problem = one.problem
        assert isinstance(problem, PlanProblem)
        pair = problem.multiplicity == 2
        for second in (False, True)[: 1 + pair]:
            parts = [problem.sampled(one.mode, *patch.points.T, second=second) for patch in patches]
            elevation = np.concatenate([part.elevation for part in parts])
            sign = float(np.sign(elevation[np.argmax(np.abs(elevation))])) or 1.0
            names.append(f"{number + 1:03d}" + ("_sin" if second else "_cos" if pair else ""))
            numbers.append(number)
            elevations.append(sign * unit * elevation)
            potentials.append(
                [sign * unit * scale * np.concatenate([part.potential(z, depth) for part in parts]) for z in levels]
            )
    triangles = np.concatenate([patch.triangles + first for patch, first in zip(patches, offsets[:-1], strict=True)])
    prisms = [
        np.hstack([triangles + (level + 1) * len(points), triangles + level * len(points)]) for level in range(_LEVELS)
    ]
    return SampledModes(
        points=points * scale,
        triangles=triangles,
        plate_of_points=_numbers(patches, [len(patch.points) for patch in patches]),
        plate_of_triangles=_numbers(patches, [len(patch.triangles) for patch in patches]),
        names=tuple(names),
        numbers=tuple(numbers),
        elevations=np.array(elevations),
        volume_points=scale * np.column_stack([np.tile(points, (len(levels), 1)), np.repeat(levels, len(points))]),
        volume_cells=("wedge", np.vstack(prisms)),
        potentials=np.array(potentials).reshape(len(names), -1),
    )


def sample_volume(solution: LevelSolution) -> SampledModes:
    """Return all modes at points of the mesh of a volume (collective).

    The volume is that of each process. The surface is on rank 0 alone, for pictures, and thinned where it is large.
    """
    # Solutions of other models do without dolfinx.
    from mpi4py import MPI

    from hydroelastic.fem.volume.samples import surface_sample, volume_sample

    names = tuple(body_name(index + 1) for index in range(len(solution.tank.plates)))
    surface = surface_sample(solution.modes, names)
    points, cells, potentials = volume_sample(solution.modes)
    scale, unit = solution.units.length, _unit(solution)
    count = len(potentials)
    elevations = np.empty((count, 0)) if surface is None else surface.elevations
    signs = None
    if surface is not None:
        highest = elevations[np.arange(count), np.abs(elevations).argmax(axis=1)]
        signs = np.where(highest < 0.0, -unit, unit)[:, None]
    signs = MPI.COMM_WORLD.bcast(signs)
    return SampledModes(
        points=np.empty((0, 2)) if surface is None else surface.points * scale,
        triangles=np.empty((0, 3), np.int64) if surface is None else surface.triangles,
        plate_of_points=np.empty(0, np.int32) if surface is None else surface.plate_of_points,
        plate_of_triangles=np.empty(0, np.int32) if surface is None else surface.plate_of_triangles,
        names=tuple(f"{number:03d}" for number in range(1, count + 1)),
        numbers=tuple(range(count)),
        elevations=signs * elevations,
        volume_points=points * scale,
        volume_cells=("tetra10", cells),
        potentials=signs * scale * potentials,
    )


def _unit(solution: LevelSolution) -> float:
    """The displacement ζ = 1 of a dimensionless mode, at the generalized mass ρL³, in m at 1 kg."""
    return float(1.0 / np.sqrt(solution.units.density * solution.units.length**3))


def _numbers(patches: tuple[Patch, ...], sizes: list[int]) -> NDArray[np.int32]:
    return np.repeat([0 if patch.plate is None else patch.plate + 1 for patch in patches], sizes).astype(np.int32)
