"""Deflection of beams and round plates in waves in the dry modes that a solution leaves out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from types import MappingProxyType

import numpy as np
from scipy.special import zeta

from hydroelastic.fem.open_water.bent_plates import omitted_effect
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.outside import attachment_paths
from hydroelastic.physics.beams import Beam

# Deflection of all omitted dry modes, per mode in use, over the last two amplitudes, where they fall like n⁻⁵: those of
# beams whose load jumps where a section begins.
_TAIL = 0.25
# The same of Kₙaₙ², which falls like n⁻⁶.
_ENERGY_TAIL = 0.2
# Power of the wavenumber with which amplitudes of a uniform beam fall.
_ORDER = 6.0


def truncation(solution: OpenResponse) -> float:
    """Largest deflection in the omitted dry modes, relative to the largest motion in the same wave.

    Of round plates, whose deflection has further dry modes, the effect of these on the waves: see `bent_plates`.
    """
    model, motions = solution.model, solution.motions
    sizes = np.maximum(np.abs(motions).max(axis=1, initial=0.0), np.finfo(float).tiny)
    omitted = [omitted_deflection(solution, index) / sizes for index in model.basin.tank.beams]
    omitted += [omitted_effect(modes, solution) for modes in model.plate_modes.values()]
    return max((float(one.max()) for one in omitted), default=0.0)


def omitted_deflection(solution: OpenResponse, index: int) -> np.ndarray:
    """Largest deflection of a beam in the omitted dry modes in each wave, shape (incident,).

    Shapes of a uniform beam with free ends, whose fourth derivative is κ⁴W, take parts of a smooth load that fall
    like κ⁻²: their amplitudes fall like κ⁻⁶, κₙ l = (n − ½)π, in even and in odd ones alike. |W| = 2 at the ends.
    """
    tank, count = solution.model.basin.tank, solution.model.pencil.bodies[index].size
    last = _last_amplitudes(solution, index)
    if not tank.beams[index].is_uniform:
        tail = _TAIL * count * last.max(axis=1)
    else:
        numbers = np.arange(count - 2, count) - 0.5
        tail = 2.0 * last @ ((0.5 * numbers) ** _ORDER * zeta(_ORDER, 1.0 + 0.5 * numbers))
    return np.asarray(tail + _tails_of_attachments(solution, index))


def omitted_energy(solution: OpenResponse, index: int) -> np.ndarray:
    """√Σ Kₙ|aₙ|² of the omitted dry modes of a beam in each wave, shape (incident,).

    With Kₙ ~ κₙ⁴ the terms of `omitted_deflection` fall like n⁻⁸, those of loads that jump like n⁻⁶.
    """
    tank, body = solution.model.basin.tank, solution.model.pencil.bodies[index]
    energies = body.stiffness[-2:] * _last_amplitudes(solution, index) ** 2
    if not tank.beams[index].is_uniform:
        tail = _ENERGY_TAIL * body.size * energies.max(axis=1)
    else:
        numbers, power = np.arange(body.size - 2, body.size) - 0.5, 2.0 * _ORDER - 4.0
        tail = energies @ ((0.5 * numbers) ** power * zeta(power, 1.0 + 0.5 * numbers))
    for _number, held, path, compliance in _attached(solution, index):
        force = solution.motions @ path.T @ held
        tail = tail + np.einsum("wi,ij,wj->w", force.conj(), compliance, force).real
    return np.asarray(np.sqrt(tail))


def weakened_attachments(
    solution: OpenResponse, dual: np.ndarray, direct: Mapping[int, np.ndarray] = MappingProxyType({})
) -> np.ndarray:
    """Change of functionals m·a of the motions, or of loads beside them, by the omitted dry modes of beams under
    springs and dampers at points, shape (functionals, incident).

    An attachment pulls with f = (K − iωB) u. In the omitted modes its point gives way by G f, which makes it weaker by
    (K − iωB) G f.
    """
    change = np.zeros((len(dual), len(solution.motions)))
    for index in solution.model.basin.tank.beams:
        for number, held, path, compliance in _attached(solution, index):
            taken = dual @ path.T + direct.get(number, 0.0)
            change += np.abs(taken @ held @ compliance @ held @ path @ solution.motions.T)
    return change


def _attached(solution: OpenResponse, index: int) -> Iterator[tuple[int, np.ndarray, np.ndarray, np.ndarray]]:
    """Yield the number of each attachment of a beam, K − iωB, its path and its G."""
    model, omega = solution.model, float(np.sqrt(solution.squared.real))
    basin, bodies, attachments = model.basin, model.pencil.bodies, model.attachments
    beam, start = basin.tank.beams[index], basin.tank.piece_of(index).start
    for number, path in enumerate(attachment_paths(basin, bodies, attachments)):
        one = attachments[number]
        if index in (one.body, one.other):
            scaled, place = one.scaled(basin.units), (one.point[0] - basin.origin) / basin.units.length - start
            held = scaled.stiffness - 1j * omega * scaled.damping
            yield number, held, path, _omitted_compliance(beam, bodies[index].size, place)


def _omitted_compliance(beam: Beam, count: int, place: float) -> np.ndarray:
    """G = Σ_{n>N} (Wₙ, 0, Wₙ′)ᵀ(Wₙ, 0, Wₙ′)/(EI κₙ⁴ l) at a point of a beam, κₙ = nπ/l.

    |Wₙ| ≤ √2, and slopes are independent of it, but for the last l/N before an end, where |Wₙ| = 2 and Wₙ′ = ±κₙ Wₙ.
    """
    end = (place > beam.length * (1.0 - 1.0 / count)) - (place < beam.length / count)
    both = end * beam.length**2 / (2.0 * pi**3 * count**2)
    compliance = np.zeros((3, 3))
    compliance[[0, 0, 2, 2], [0, 2, 0, 2]] = (
        beam.length**3 / (3.0 * pi**4 * count**3),
        both,
        both,
        beam.length / (pi**2 * count),
    )
    return (4.0 if end else 2.0) / beam.flexural_rigidity * compliance


def _last_amplitudes(solution: OpenResponse, index: int) -> np.ndarray:
    """|a| of the last two dry modes of a beam in use, shape (incident, 2)."""
    bodies = solution.model.pencil.bodies
    stop = sum(body.size for body in bodies[: index + 1])
    last: np.ndarray = np.abs(solution.motions[:, stop - min(bodies[index].size, 2) : stop])
    return last


def _tails_of_attachments(solution: OpenResponse, index: int) -> np.ndarray:
    """Deflection in the omitted dry modes by springs and dampers in each wave, shape (incident,)."""
    omega = float(np.sqrt(solution.squared.real))
    return np.array([_tail_of_attachments(motions, solution.model, index, omega) for motions in solution.motions])


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
