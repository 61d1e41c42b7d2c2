"""Fields of open water as plain arrays in SI units on one process, to be drawn and written."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from hydroelastic.fem.cells import cell_corners, owned_cells
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.fields import OpenField
from hydroelastic.fem.sampling import LiquidSample, SurfaceTrace, sample_liquid
from hydroelastic.fem.shape_curves import (
    Beyond,
    FloatSection,
    SectionField,
    SurfaceCurve,
    body_shapes,
    sample_level,
    wave_curves,
    wave_levels,
)
from hydroelastic.meshes.geometry import BOTTOM, LID
from hydroelastic.physics.tank import StillLevel, Tank

_Moving = TypeVar("_Moving", SurfaceCurve, FloatSection)


@dataclass(frozen=True, kw_only=True)
class SampledField:
    """A motion e^{−iωt}, in SI units."""

    name: str  # of its files
    points: np.ndarray  # m in the coordinates of the scene, shape (points, 2)
    triangles: np.ndarray  # shape (triangles, 3)
    liquid: np.ndarray  # of each triangle: 1 is the lowest, shape (triangles,)
    potential: np.ndarray  # displacement potential ψ, m², complex, shape (points,)
    displacement: np.ndarray  # ∇ψ, m, complex, shape (points, 2)
    pressure: np.ndarray  # ρω²ψ, Pa, complex, shape (points,)
    picture: SectionField  # what is drawn
    omega: complex  # ω, rad/s; with a negative imaginary part of a decaying motion


def sample_field(field: OpenField) -> SampledField | None:
    """Sample a field where coordinates are real."""
    model, tank = field.model, field.model.basin.tank
    pencil, liquid = model.pencil, model.pencil.liquid
    functions = as_functions(liquid, [pencil.vector(part) for part in (field.potential.real, field.potential.imag)])
    sample = sample_liquid(liquid, functions, _in_basin(model))
    traces = [(level, sample_level(tank, level, liquid, functions)) for level in wave_levels(tank)]
    if sample is None:
        return None
    potential, displacement = _with_incident(field, sample)
    levels = [(level, _elevations(field, tank, level, trace)) for level, trace in traces if trace is not None]
    length, metres = model.basin.units.length, field.metres
    potential, displacement = metres * length * potential, metres * displacement
    omega = complex(np.sqrt(field.squared)) * model.basin.units.frequency
    densities = np.array([model.basin.layers.density_below, model.basin.layers.density_above])
    return SampledField(
        name=field.name,
        points=length * sample.points + [model.basin.origin, 0.0],
        triangles=sample.triangles,
        liquid=sample.liquid,
        potential=potential,
        displacement=displacement,
        pressure=densities[_layers(sample)] * omega**2 * potential,
        picture=_picture(field, sample, levels, potential, displacement),
        omega=omega,
    )


def _in_basin(model: OpenModel) -> np.ndarray:
    mesh = model.pencil.liquid.tank.mesh
    cells = owned_cells(mesh)
    middles = cell_corners(mesh, cells).mean(axis=1)
    tank = model.basin.tank
    low, high = [0.0, tank.layers[0].floor], [1.0, tank.layers[-1].ceiling]
    inside = np.all((middles > low) & (middles < high), axis=1)
    return np.asarray(cells[inside])


def _layers(sample: LiquidSample) -> np.ndarray:
    """The layer of each point, 0 for the lowest."""
    layers = np.zeros(len(sample.points), dtype=np.int64)
    layers[sample.triangles] = sample.liquid[:, None] - 1
    return layers


def _with_incident(field: OpenField, sample: LiquidSample) -> tuple[np.ndarray, np.ndarray]:
    """ψ and ∇ψ, complex, of the whole field."""
    potential = sample.potential[0] + 1j * sample.potential[1]
    displacement = sample.displacement[0] + 1j * sample.displacement[1]
    if field.incident is not None:
        plane, amplitude = field.incident
        value, gradient = plane.field(sample.points, _layers(sample))
        potential, displacement = potential + amplitude * value, displacement + amplitude * gradient
    return potential, displacement


def _elevations(field: OpenField, tank: Tank, level: StillLevel, trace: SurfaceTrace) -> SurfaceTrace:
    """Real and imaginary part of the elevation of a still level, in units of the basin."""
    pressure = trace.potential[0] + 1j * trace.potential[1]
    if field.incident is not None:
        plane, amplitude = field.incident
        points = np.stack([trace.x, np.full_like(trace.x, level.height)], axis=-1)
        for sign, layer in ((1.0, level.below), (-1.0, level.above)):
            if layer is not None:
                value, _ = plane.field(points, np.full(trace.x.shape, layer))
                pressure = pressure + sign * amplitude * tank.layers[layer].density / level.jump * value
    elevation = field.squared * pressure
    return SurfaceTrace(x=trace.x, potential=np.array([elevation.real, elevation.imag]))


def _picture(
    field: OpenField,
    sample: LiquidSample,
    levels: list[tuple[StillLevel, SurfaceTrace]],
    potential: np.ndarray,
    displacement: np.ndarray,
) -> SectionField:
    basin, tank, bodies = field.model.basin, field.model.basin.tank, field.model.pencil.bodies
    length = basin.units.length
    surfaces: list[tuple[SurfaceCurve, ...]] = []
    floats: list[tuple[FloatSection, ...]] = []
    for part, amplitudes in enumerate((field.bodies.real, field.bodies.imag)):
        shapes = body_shapes(tank, bodies, amplitudes)
        waves = (wave for level, trace in levels for wave in wave_curves(level, trace, part, 1.0))
        surfaces.append((*shapes.beams, *waves))
        floats.append(shapes.floats)

    def joined(pairs: list[tuple[_Moving, ...]]) -> tuple[_Moving, ...]:
        return tuple(
            replace(real, displacement=real.displacement + 1j * imaginary.displacement).scaled(
                length, field.metres, basin.origin
            )
            for real, imaginary in zip(*pairs, strict=True)
        )

    two, beyond, top = len(tank.layers) > 1, _beyond(basin.sides), tank.levels[-1]
    lid = [piece for piece in top.pieces if top.kind == "rigid" and piece.body is None and "top" not in beyond]
    return SectionField(
        points=length * sample.points + [basin.origin, 0.0],
        triangles=sample.triangles,
        liquid=sample.liquid,
        potential=potential,
        displacement=displacement,
        surfaces=joined(surfaces),
        floats=joined(floats),
        title=field.title,
        length=length,
        depth=length * tank.layers[0].depth,
        upper_depth=length * tank.layers[1].depth if two else 0.0,
        densities=(basin.layers.density_below, basin.layers.density_above) if two else (),
        lid=tuple((basin.origin + length * piece.start, basin.origin + length * piece.end) for piece in lid),
        goes_on=beyond,
        start=basin.origin,
        amplitude=field.amplitude,
    )


def _beyond(sides: tuple[str, ...]) -> frozenset[Beyond]:
    found: set[Beyond] = {"sides"}
    if BOTTOM in sides:
        found.add("bottom")
    if LID in sides:
        found.add("top")
    return frozenset(found)
