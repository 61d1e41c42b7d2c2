"""Numeric output files of WAMIT: ``.1`` added mass and damping, ``.3`` excitation, ``.4`` motions, ``.hst`` stiffness,
and of elastic bodies ``.mmx``, their mass and bending stiffness, and ``.cfg``, the numbers of their modes.

    .1      PER I J  A/(ρLᵏ)  B/(ρωLᵏ)           PER = −1 at ω = 0 and 0 at ω = ∞, both without B
    .3      PER BETA I  |X| arg X Re X Im X      X/(ρgLᵐ) per unit elevation, degrees
    .4      PER BETA I  |ξ| arg ξ Re ξ Im ξ      ξ/Lⁿ per unit elevation
    .hst    I J  C/(ρgLᵏ)
    .mmx    I J  M B K                           in SI units, below two lines of text
    .cfg    NEWMDS(n) = modes of body n beyond the six rigid motions

with L = 1 m. WAMIT's time factor is e^{iωt}: complex numbers are the conjugates of those of e^{−iωt}, and phases are
relative to a wave whose crest is at x = 0 at t = 0. A body has six motions, in its frame at its centre of gravity
(XBODY), and its NEWMDS modes; those of the next body are counted on from there. Sources: WAMIT user manual, § 4 and 9;
J. Jonkman's reader in OpenFAST for the limits of PER; WEC-Sim, readWAMIT.m, for ``.mmx`` and ``.cfg``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.output.hydrodynamic_files.whole_bodies import WholeBodies

_ZERO, _INFINITE = -1.0, 0.0


def write_wamit(bodies: WholeBodies, folder: Path, name: str) -> None:
    """Write ``<name>.1``, ``<name>.3``, ``<name>.hst`` and, where motions in waves are known, ``<name>.4``."""
    files = {
        "1": _radiation(bodies),
        "3": (
            line
            for omega, forces in zip(bodies.omega, bodies.excitation_force, strict=True)
            for direction, force in zip(bodies.directions, forces, strict=True)
            for line in _complex_lines(bodies, omega, direction, force / (bodies.density * bodies.gravity))
        ),
        "4": (
            line
            for motions in bodies.motions
            for omega, amplitudes in zip(motions.omega, motions.amplitudes, strict=True)
            for line in _complex_lines(bodies, omega, motions.direction, amplitudes)
        ),
        "hst": (
            f"{i + 1:6d}{j + 1:6d}{_number(value / (bodies.density * bodies.gravity))}"
            for (i, j), value in np.ndenumerate(bodies.stiffness)
            if any(own.start <= i < own.stop and own.start <= j < own.stop for own in bodies.spans)
        ),
    }
    if any(body.modes for body in bodies.bodies):
        files["cfg"] = (f"NEWMDS({number})={len(body.modes)}" for number, body in enumerate(bodies.bodies, 1))
        files["mmx"] = _external(bodies)
    for kind, lines in files.items():
        text = "".join(f"{line}\n" for line in lines)
        if text:
            (folder / f"{name}.{kind}").write_text(text, encoding="ascii")


def _radiation(bodies: WholeBodies) -> Iterator[str]:
    for period, limit in zip((_ZERO, _INFINITE), bodies.limits, strict=True):
        if limit is None:
            continue
        for i, j in _entries(bodies):
            # Added mass of what displaces a volume may be infinite for very long waves: such entries are left out.
            if np.isfinite(limit[i, j]):
                yield f"{_number(period)}{i + 1:6d}{j + 1:6d}{_number(limit[i, j] / bodies.density)}"
    for omega, mass, damping in zip(bodies.omega, bodies.added_mass, bodies.radiation_damping, strict=True):
        for i, j in _entries(bodies):
            values = _number(mass[i, j] / bodies.density) + _number(damping[i, j] / (bodies.density * omega))
            yield f"{_number(2.0 * np.pi / omega)}{i + 1:6d}{j + 1:6d}{values}"


def _external(bodies: WholeBodies) -> Iterator[str]:
    yield "External force matrices:"
    yield "     I     J         M(I,J)            B(I,J)            K(I,J)"
    for (i, j), mass in np.ndenumerate(bodies.inertia):
        yield f"{i + 1:6d}{j + 1:6d}{_number(mass)}{_number(0.0)}{_number(bodies.bending_stiffness[i, j])}"


def _entries(bodies: WholeBodies) -> Iterator[tuple[int, int]]:
    places = np.flatnonzero(bodies.modelled)
    return ((int(i), int(j)) for i in places for j in places)


def _complex_lines(bodies: WholeBodies, omega: float, direction: float, values: np.ndarray) -> Iterator[str]:
    for place in np.flatnonzero(bodies.modelled):
        value = np.conj(values[place])
        parts = (abs(value), np.degrees(np.angle(value)), value.real, value.imag)
        yield f"{_number(2.0 * np.pi / omega)}{_number(direction)}{place + 1:6d}{''.join(map(_number, parts))}"


def _number(value: float) -> str:
    # No negative zero.
    return f"{value + 0.0:18.9E}"
