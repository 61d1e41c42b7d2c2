"""Modes of a tank in three dimensions at places of the surface and of the volume, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.level_bed.patches import Patch
from hydroelastic.fem.level_bed.solution import LevelSolution

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
        levels: z of horizontal planes, m, from the surface down.
        potentials: ψ in each of them, m², shape (shapes, levels, points).
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    plate_of_points: NDArray[np.int32]
    plate_of_triangles: NDArray[np.int32]
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    elevations: NDArray[np.float64]
    levels: NDArray[np.float64]
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
    # ζ = 1 of the dimensionless mode at the generalized mass ρL³ is a displacement of 1/√(ρL³) m at 1 kg.
    unit = 1.0 / np.sqrt(solution.units.density * scale**3)
    names, numbers, elevations, potentials = [], [], [], []
    for number, one in enumerate(solution.modes):
        pair = one.problem.multiplicity == 2
        for second in (False, True)[: 1 + pair]:
            parts = [one.problem.sampled(one.mode, *patch.points.T, second=second) for patch in patches]
            elevation = np.concatenate([part.elevation for part in parts])
            sign = float(np.sign(elevation[np.argmax(np.abs(elevation))])) or 1.0
            names.append(f"{number + 1:03d}" + ("_sin" if second else "_cos" if pair else ""))
            numbers.append(number)
            elevations.append(sign * unit * elevation)
            potentials.append(
                [sign * unit * scale * np.concatenate([part.potential(z, depth) for part in parts]) for z in levels]
            )
    return SampledModes(
        points=points * scale,
        triangles=np.concatenate([patch.triangles + first for patch, first in zip(patches, offsets[:-1], strict=True)]),
        plate_of_points=_numbers(patches, [len(patch.points) for patch in patches]),
        plate_of_triangles=_numbers(patches, [len(patch.triangles) for patch in patches]),
        names=tuple(names),
        numbers=tuple(numbers),
        elevations=np.array(elevations),
        levels=levels * scale,
        potentials=np.array(potentials),
    )


def _numbers(patches: tuple[Patch, ...], sizes: list[int]) -> NDArray[np.int32]:
    return np.repeat([0 if patch.plate is None else patch.plate + 1 for patch in patches], sizes).astype(np.int32)
