"""Modes of a tank in three dimensions at places of the surface and of the volume, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.level_bed.patches import Patch
from hydroelastic.fem.level_bed.solution import LevelSolution, PlanProblem
from hydroelastic.physics.dofs import body_name

# Horizontal layers of the volume.
_LEVELS = 12


@dataclass(frozen=True, kw_only=True)
class SampledModes:
    """Mode shapes of a solved tank.

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
        summary: content of ``summary.json``.
    """

    solved: Any
    sample: SampledModes
    summary: dict[str, Any]

    @property
    def tank(self) -> LevelSolution:
        """The field solution."""
        found: LevelSolution = self.solved.tank
        return found

    def __getattr__(self, name: str) -> Any:
        """The rest of what quantities are taken from."""
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


def sample_volume(solution: LevelSolution) -> SampledModes | None:
    """Return all modes at points of the mesh of a volume; ``None`` on other ranks than 0 (collective)."""
    # Solutions of other models do without dolfinx.
    from hydroelastic.fem.volume.samples import surface_sample, volume_sample

    names = tuple(body_name(index + 1) for index in range(len(solution.tank.plates)))
    surface = surface_sample(solution.modes, names)
    volume = volume_sample(solution.modes)
    if surface is None or volume is None:
        return None
    scale, unit = solution.units.length, _unit(solution)
    elevations = surface.elevations
    highest = elevations[np.arange(len(elevations)), np.abs(elevations).argmax(axis=1)]
    signs = np.where(highest < 0.0, -unit, unit)[:, None]
    points, cells, potentials = volume
    return SampledModes(
        points=surface.points * scale,
        triangles=surface.triangles,
        plate_of_points=surface.plate_of_points,
        plate_of_triangles=surface.plate_of_triangles,
        names=tuple(f"{number:03d}" for number in range(1, len(elevations) + 1)),
        numbers=tuple(range(len(elevations))),
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
