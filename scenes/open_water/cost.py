"""What a decay analysis will cost, said before it is solved: its first mesh is made, and the rest was measured."""

from __future__ import annotations

from dataclasses import dataclass
from math import log10, sqrt

from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.models.open_analyses import Decay
from hydroelastic.scenes.models.tank import TankScene

WITHIN = 3.0
"""Factor within which seconds and memory are told. A second attempt, where the first falls short, may double them; a
busy or a slow machine takes longer."""

# Measured on one core, on floats in and between endless liquids, at tolerances from 1e-3 to 1e-6: 4 000 to 64 000
# unknowns, 3 to 65 s, 260 to 1 060 MiB.
_SECONDS, _OF_UNKNOWNS, _GROWTH = 1.1, 37_000, 1.2
_LIBRARIES, _PER_UNKNOWN = 200 * 2**20, 18 * 2**10
# Solutions on the ray, and what else is solved, as so many of these.
_LEAST, _PER_DIGIT, _BESIDE = 6.0, 2.5, 8


@dataclass(frozen=True, kw_only=True)
class DecayCost:
    """The cost of a decay analysis.

    Attributes:
        unknowns: of ψ.
        factorizations: how many.
        seconds: of processor time.
        memory: bytes.
    """

    unknowns: int
    factorizations: int
    seconds: float
    memory: float

    def words(self) -> str:
        """The cost in words."""
        unknowns = f"{round(self.unknowns, -3):,}".replace(",", " ")
        return (
            f"about {unknowns} unknowns, {self.factorizations} factorizations, {self.seconds:.2g} s of "
            f"processor time and {self.memory / 2**30:.2g} GiB of memory, within a factor of {WITHIN:g}"
        )


def decay_cost(scene: TankScene, asked: Decay) -> DecayCost:
    """Estimate the cost; gmsh makes the first mesh.

    Args:
        scene: with open ends.
        asked: the analysis.

    Raises:
        MeshError: if no mesh can be made.
    """
    # These need dolfinx, which takes a second to import.
    from hydroelastic.scenes.open_water.decay import ray_band
    from hydroelastic.scenes.open_water.model import first_mesh, first_resolution
    from hydroelastic.scenes.open_water.resonance import ANGLE

    at_rest = [placed_float(scene, index).hydrostatics for index, _ in scene.floats]
    # Far above the waves liquids add about the mass of the float, and only the logarithm of the frequency matters.
    expected = sorted(sqrt(own.heave_stiffness / (2.0 * own.mass)) for own in at_rest)
    band = ray_band(scene, asked, expected)
    resolution = first_resolution(scene, band)
    mesh = first_mesh(scene, band, resolution, angle=ANGLE)
    vertices, cells, degree = len(mesh.points), len(mesh.cells), resolution.degree
    # Euler: a triangulation without holes has one edge less than vertices and cells together.
    unknowns = vertices + (vertices + cells - 1) * (degree - 1) + cells * (degree - 1) * (degree - 2) // 2
    factorizations = round(_LEAST - _PER_DIGIT * log10(scene.accuracy.tolerance)) + _BESIDE
    return DecayCost(
        unknowns=unknowns,
        factorizations=factorizations,
        seconds=_SECONDS * factorizations * (unknowns / _OF_UNKNOWNS) ** _GROWTH,
        memory=_LIBRARIES + _PER_UNKNOWN * unknowns,
    )
