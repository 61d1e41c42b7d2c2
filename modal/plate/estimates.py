"""Estimates by older theories of the first elastic tone of a plate, and of heave and pitch of a rigid one.

An added mass per area m_a, the mean over the plate with the square of its shape as weight, gives

    ω² = (D κ⁴ + sρg)/(m + m_a),    κ⁴ of the first dry mode, D κ⁴ = 0 of rigid motions
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi, sqrt, tanh
from typing import Literal, TypeAlias

import numpy as np
from scipy.special import jnp_zeros, jv

from hydroelastic.modal.plate.line_modes import FEW_MODES, PlateLine, dry_modes, lowest_dry
from hydroelastic.modal.plate.rectangle import rectangle_modes
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Polygon, Rectangle, Strip

EstimatedMotion: TypeAlias = Literal["elastic", "heave", "pitch"]

# Standing waves of the tank in Rayleigh's quotient: their sum is then exact to about 1e-5.
_WAVES = 400
# Pieces of a plate, and Gauss points in each, that resolve these waves.
_PIECES, _POINTS = 50, 16
_RIGID_DISC: tuple[tuple[str, EstimatedMotion, float, str], ...] = (
    ("rigid_heave", "heave", 4.0 / (3.0 * pi), "4/3 ρa³, {limit}"),
    ("rigid_pitch", "pitch", 32.0 / (45.0 * pi), "8/45 ρa⁵, {limit}"),
    ("strip_heave", "heave", 2.0 / 3.0, "2π/3 ρa³: each slice as if it were endless, {limit}"),
    ("strip_pitch", "pitch", 8.0 / 15.0, "2π/15 ρa⁵: each slice as if it were endless, {limit}"),
)
_RIGID_STRIP: tuple[tuple[str, EstimatedMotion, float, str], ...] = (
    ("rigid_heave", "heave", pi / 4.0, "π/2 ρ(l/2)² per metre of width, {limit}"),
    ("rigid_pitch", "pitch", 3.0 * pi / 32.0, "π/16 ρ(l/2)⁴ per metre of width, {limit}"),
)
_LIMIT = "the limit of infinite frequency in deep water without walls: neglects waves, walls and the bed"


@dataclass(frozen=True, kw_only=True)
class PlateEstimate:
    """An estimate of one motion of a plate."""

    name: str  # of the estimate
    plate: int  # index of the plate
    motion: EstimatedMotion  # the first elastic tone, or a rigid motion
    omega: float  # ω, rad/s
    added_mass_per_area: float  # m_a, kg/m²
    note: str  # what it neglects


def plate_estimates(tank: LevelTank) -> tuple[PlateEstimate, ...]:
    """Return the estimates of all plates with free edges, but polygons."""
    found: list[PlateEstimate] = []
    for index, plate in enumerate(tank.plates):
        if plate.edge == "free" and not isinstance(plate.outline, Polygon):
            found += _elastic(tank, index, plate) if plate.is_elastic else _rigid(tank, index, plate)
    return tuple(found)


def _rigid(tank: LevelTank, index: int, plate: Plate) -> Iterator[PlateEstimate]:
    """Heave and pitch of a rigid disc or strip, which need hydrostatic restoring."""
    outline = plate.outline
    if isinstance(outline, Strip):
        table, half = _RIGID_STRIP, 0.5 * outline.length
    elif isinstance(outline, Disc) and not outline.inner_radius:
        table, half = _RIGID_DISC, outline.radius
    else:
        return
    if not plate.hydrostatic:
        return
    for name, motion, factor, note in table:
        yield _estimate(tank, index, 0.0, name, factor * half, note.format(limit=_LIMIT), motion)


def _elastic(tank: LevelTank, index: int, plate: Plate) -> Iterator[PlateEstimate]:
    outline = plate.outline
    if isinstance(outline, Rectangle):
        values = rectangle_modes(outline.size, plate.poisson_ratio, FEW_MODES).stiffness
        eigenvalue, of_order = float(values[values > 0.0].min()), ""
    else:
        assert isinstance(outline, Strip | Disc)
        line = _line(plate, outline)
        order, eigenvalue = lowest_dry(line)
        of_order = f", of order {order}"
        length = _rayleigh(tank, outline, line(order), order)
        if length is not None:
            note = (
                f"Rayleigh's quotient of the first dry mode{of_order}, in the tank: neglects waves on the water, which "
                "stays level as under a lid, and other shapes; above the lowest mode of its order"
            )
            yield _estimate(tank, index, eigenvalue, "rayleigh_lid", length, note)
    wavenumber = eigenvalue**0.25
    note = f"the first dry mode alone{of_order}; "
    for name, length, more in (
        (
            "wave_in_depth",
            1.0 / (wavenumber * tanh(wavenumber * tank.depth)),
            "added mass ρ/(κ tanh κH) of an endless wave with the wavenumber κ of the dry mode: neglects edges",
        ),
        ("wave_deep", 1.0 / wavenumber, "the same in deep water, ρ/κ: neglects edges and the bed"),
    ):
        yield _estimate(tank, index, eigenvalue, name, length, note + more)


def _estimate(
    tank: LevelTank,
    index: int,
    eigenvalue: float,
    name: str,
    length: float,
    note: str,
    motion: EstimatedMotion = "elastic",
) -> PlateEstimate:
    plate = tank.plates[index]
    bending = plate.flexural_rigidity * eigenvalue if eigenvalue else 0.0
    stiffness = bending + float(plate.hydrostatic) * tank.density * tank.gravity
    return PlateEstimate(
        name=name,
        plate=index,
        motion=motion,
        omega=sqrt(stiffness / (plate.mass_per_area + tank.density * length)),
        added_mass_per_area=tank.density * length,
        note=note,
    )


def _line(plate: Plate, outline: Strip | Disc) -> Callable[[int], PlateLine]:
    """The plate on the line of an order, in the coordinates of the tank."""
    if isinstance(outline, Disc):
        start, end, across = outline.inner_radius, outline.radius, 1.0
    else:
        start, end, across = outline.start, outline.end, 0.0 if plate.slats else pi / outline.width
    return lambda order: PlateLine(
        start=start,
        end=end,
        round=isinstance(outline, Disc),
        transverse=order * across,
        poisson_ratio=plate.poisson_ratio,
        edges=("free", "free"),
    )


def _rayleigh(tank: LevelTank, outline: Strip | Disc, line: PlateLine, order: int) -> float | None:
    """m_a/ρ of the first dry mode: Σ (∫Wφ)²/(k tanh kH) over ∫W², φ the tank's standing waves; m.

    ``None`` where these are no cosines and no Bessel functions of the first kind.
    """
    local, weights = np.polynomial.legendre.leggauss(_POINTS)
    ends = np.linspace(line.start, line.end, _PIECES + 1)
    half = 0.5 * (ends[1] - ends[0])
    places = (ends[:-1, None] + half * (1.0 + local)).ravel()
    measure = np.tile(half * weights, _PIECES) * (places if line.round else 1.0)
    if isinstance(tank.plan, Box) and isinstance(outline, Strip):
        along = np.arange(0 if order else 1, _WAVES) * pi / tank.plan.length
        k = np.hypot(along, order * pi / tank.plan.width)
        norms = tank.plan.length * np.where(along > 0.0, 0.5, 1.0)
        waves = np.cos(along[:, None] * places)
    elif (
        isinstance(tank.plan, Cylinder)
        and not tank.plan.inner_radius
        and isinstance(outline, Disc)
        and outline.position == (0.0, 0.0)
    ):
        roots = jnp_zeros(order, _WAVES)
        k = roots / tank.plan.radius
        norms = 0.5 * tank.plan.radius**2 * (1.0 - (order / roots) ** 2) * jv(order, roots) ** 2
        waves = jv(order, k[:, None] * places)
    else:
        return None
    modes = dry_modes(line, FEW_MODES)
    shape: FloatArray = modes.values(places)[:, modes.rigid]
    parts = (waves @ (measure * shape)) ** 2 / norms
    return float(np.sum(parts / (k * np.tanh(k * tank.depth))) / np.sum(measure * shape**2))
