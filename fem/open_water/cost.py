"""Estimated cost of the motion after a release: from the first mesh, by measured times and memory per unknown."""

from __future__ import annotations

from dataclasses import dataclass
from math import log10, sqrt

from hydroelastic.fem.open_water.decay import ray_band
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.model_building import first_mesh, first_resolution
from hydroelastic.fem.open_water.requests import DecayRequest
from hydroelastic.fem.open_water.resonance import ANGLE
from hydroelastic.fem.tank.mesh import unknown_count
from hydroelastic.physics.tank import Tank

WITHIN = 3.0
"""Factor within which seconds and memory are estimated. A second attempt, where the first falls short, may double them;
a busy or a slow machine takes longer."""

# Measured on one core, on floats in and between infinitely deep liquids, at tolerances from 1e-3 to 1e-6: 4 000 to 64
# 000 unknowns, 3 to 65 s, 260 to 1 060 MiB.
_SECONDS, _OF_UNKNOWNS, _GROWTH = 1.1, 37_000, 1.2
_LIBRARIES, _PER_UNKNOWN = 200 * 2**20, 18 * 2**10
# Numbers of solutions on the ray, the least and per decimal digit, and of the other solutions.
_LEAST, _PER_DIGIT, _BESIDE = 6.0, 2.5, 8


@dataclass(frozen=True, kw_only=True)
class DecayCost:
    """The cost of the motion after a release."""

    unknowns: int
    factorizations: int
    seconds: float  # processor time, s
    memory: float  # largest memory, bytes


def decay_cost(water: Tank, tolerance: float, request: DecayRequest) -> DecayCost:
    """Estimate the cost from the first mesh, which gmsh makes."""
    at_rest = [body.hydrostatics for body in water.floats.values()]
    # At infinite frequency the added mass is about the mass of the float; only the logarithm of the frequency matters.
    expected = sorted(sqrt(own.heave_stiffness / (2.0 * own.mass)) for own in at_rest)
    band = ray_band(water, tolerance, request, expected)
    resolution = first_resolution(water, tolerance, band)
    mesh = first_mesh(water, tolerance, band, resolution, angle=ANGLE)
    unknowns = unknown_count(len(mesh.points), len(mesh.cells), resolution.degree)
    factorizations = round(_LEAST - _PER_DIGIT * log10(tolerance)) + _BESIDE
    return DecayCost(
        unknowns=unknowns,
        factorizations=factorizations,
        seconds=_SECONDS * factorizations * (unknowns / _OF_UNKNOWNS) ** _GROWTH,
        memory=_LIBRARIES + _PER_UNKNOWN * unknowns,
    )


def first_size(water: Tank, tolerance: float, band: Band) -> tuple[int, int, int]:
    """Return cells, degree and unknowns of ψ of the first mesh for a range of frequencies, which gmsh makes."""
    resolution = first_resolution(water, tolerance, band)
    mesh = first_mesh(water, tolerance, band, resolution)
    return len(mesh.cells), resolution.degree, unknown_count(len(mesh.points), len(mesh.cells), resolution.degree)
