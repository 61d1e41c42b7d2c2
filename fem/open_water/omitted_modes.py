"""Deflection of elastic bodies in waves in the dry modes that a solution leaves out."""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.special import zeta

from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.outside import attachment_paths

# Deflection of all omitted dry modes, per mode in use, over the last two amplitudes, where they fall like n⁻⁵: those of
# round plates, and of beams whose load jumps where a section begins.
_TAIL = 0.25
# Power of the wavenumber with which amplitudes of a uniform beam fall.
_ORDER = 6.0


def truncation(solution: OpenResponse) -> float:
    """Largest deflection in the omitted dry modes, relative to the largest motion in the same wave.

    About an axis, where waves of one order may hardly move a plate, relative to the elevation of the wave if that is
    larger.
    """
    model, tank = solution.model, solution.model.basin.tank
    sizes = np.abs(solution.motions).max(axis=1, initial=0.0)
    if tank.geometry.is_revolved:
        sizes = np.maximum(sizes, solution.incidence.elevations[solution.incident])
    omitted = [
        omitted_deflection(solution, index)
        for index, body in enumerate(model.pencil.bodies)
        if body.size and tank.bodies[index].is_elastic
    ]
    return max((float((one / np.maximum(sizes, np.finfo(float).tiny)).max()) for one in omitted), default=0.0)


def omitted_deflection(solution: OpenResponse, index: int) -> np.ndarray:
    """Largest deflection of an elastic body in the omitted dry modes in each wave, shape (incident,).

    Shapes of a uniform beam with free ends, whose fourth derivative is κ⁴W, take parts of a smooth load that fall
    like κ⁻²: their amplitudes fall like κ⁻⁶, κₙ l = (n − ½)π, in even and in odd ones alike. |W| = 2 at the ends.

    About an axis times the number of orders that move it, ka and one more, whose deflections add up.
    """
    model, tank = solution.model, solution.model.basin.tank
    first, count = sum(body.size for body in model.pencil.bodies[:index]), model.pencil.bodies[index].size
    last = np.abs(solution.motions[:, first + max(count - 2, 0) : first + count])
    if index not in tank.beams or not tank.beams[index].is_uniform:
        reach = tank.bodies[index].waterplane[1] * float(tank.geometry.is_revolved)
        orders = 1.0 + solution.incidence.planes[0].wave.wavenumber * reach
        tail = orders * _TAIL * count * last.max(axis=1)
    else:
        numbers = np.arange(count - 2, count) - 0.5
        tail = 2.0 * last @ ((0.5 * numbers) ** _ORDER * zeta(_ORDER, 1.0 + 0.5 * numbers))
    if index in tank.beams:
        omega = float(np.sqrt(solution.squared.real))
        tail = tail + [_tail_of_attachments(motions, model, index, omega) for motions in solution.motions]
    return np.asarray(tail)


def _tail_of_attachments(motions: np.ndarray, model: OpenModel, index: int, omega: float) -> float:
    """Deflection of a beam in the omitted dry modes by the forces F and moments C of springs and dampers at points.

    Σ_{n>N} Wₙ (F Wₙ + C Wₙ′)/(EI κₙ⁴ l) with |Wₙ| ≤ √2 and κₙ = nπ/l is less than 2 (F l³/(3π⁴N³) + C l²/(2π³N²))/EI.
    """
    attachments, (tank, bodies) = model.attachments, (model.basin.tank, model.pencil.bodies)
    beam, count, found = tank.beams[index], bodies[index].size, 0.0
    for one, path in zip(attachments, attachment_paths(model.basin, bodies, attachments), strict=True):
        if index in (one.body, one.other):
            scaled = one.scaled(model.basin.units)
            force, _, couple = np.abs((scaled.stiffness - 1j * omega * scaled.damping) @ path @ motions)
            tail = force * beam.length**3 / (3.0 * pi**4 * count**3) + couple * beam.length**2 / (
                2.0 * pi**3 * count**2
            )
            found += 2.0 * float(tail) / beam.flexural_rigidity
    return found
