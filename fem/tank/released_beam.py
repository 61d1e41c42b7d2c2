"""The infinite-frequency limit of one uniform beam between free water, without a mesh.

With ψ = 0 on the water beside it, the liquid under a beam in a rectangle is known by Green's function of the tank: in
the dry modes of the beam its added mass M_a is that of `modal.beam.pressure_release`, which converges exponentially.
The modes follow from

    K a = λ (M + M_a) a        rigid motions without stiffness follow the others and are condensed
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.bodies.registry import body_model
from hydroelastic.fem.modes import HIDDEN
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.error_estimates import ROUNDING_OF_SPREAD, FrequencyErrors
from hydroelastic.fem.tank.mesh import is_plain
from hydroelastic.fem.truncation import elastic_places, omitted
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.tank_estimates import floating_beam
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.tank import Tank

# Relative rounding of a frequency where the liquid is no thinner than a tenth of the tank's length. Measured on the
# reference tanks: 2e-13.
_ROUNDING = 1e-12
# A longer expansion takes more time than a mesh.
_MOST_TERMS = 200


@dataclass(frozen=True, kw_only=True)
class ReleasedModes:
    """Modes of the limit, ascending, without their ψ.

    Attributes:
        depth: of the dimensionless tank.
        bodies: the beam.
        eigenvalues: dimensionless λ, shape (modes,).
        elastic_amplitudes: of the dry modes at unit generalized mass, rigid motions without stiffness left out, shape
            (modes, dry modes).
        truncation: relative error of each λ by the dry modes left out, see `fem.truncation`.
    """

    depth: float
    bodies: tuple[Body, ...]
    eigenvalues: np.ndarray
    elastic_amplitudes: np.ndarray
    truncation: np.ndarray

    def errors_of(self, index: int) -> FrequencyErrors:
        """Return the relative errors of ω of one mode."""
        own, none = slice(index, index + 1), np.zeros(1)
        values = self.eigenvalues[own]
        # An error of λ is twice that of ω. The liquid's expansion leaves none: its last eighth adds less than 2e-19.
        return FrequencyErrors(
            liquid=none,
            tips=none,
            truncation=0.5 * self.truncation[own],
            rounding=_ROUNDING * max(1.0, 0.1 / self.depth) + ROUNDING_OF_SPREAD * values / self.eigenvalues[0],
        )


def released_modes(tanks: Sequence[Tank], count: int) -> list[ReleasedModes | None]:
    """Solve the limit of tanks that share one liquid in the first dry modes of their beams.

    Args:
        tanks: dimensionless tanks, one or more, of one `liquid_key`.
        count: number of dry modes.

    Returns:
        All modes of each; ``None`` where the liquid is not that of one uniform beam with free ends between free water,
        or is too shallow for the expansion.
    """
    found: list[ReleasedModes | None] = [None] * len(tanks)
    added_mass = _added_mass(tanks[0], count)
    if added_mass is None:
        return found
    # Without hydrostatic restoring two motions have no stiffness, and are condensed.
    alike: dict[bytes, list[tuple[int, Body]]] = {}
    for place, tank in enumerate(tanks):
        body = body_model(tank, 0).moving(count, None)
        alike.setdefault((body.stiffness == 0.0).tobytes(), []).append((place, body))
    for group in alike.values():
        places, bodies = zip(*group, strict=True)
        stiffness = np.array([body.stiffness for body in bodies])
        inverses, amplitudes = _solved(stiffness, np.array([body.mass for body in bodies]) + added_mass)
        energies = stiffness[:, None, :] * amplitudes**2 * inverses[:, :, None]
        truncation = omitted(energies[:, :, elastic_places(bodies[0].dofs)])
        for number, place in enumerate(places):
            seen = np.count_nonzero(inverses[number] > HIDDEN * inverses[number, 0])
            found[place] = ReleasedModes(
                depth=tanks[place].depth,
                bodies=(bodies[number],),
                eigenvalues=1.0 / inverses[number, :seen],
                elastic_amplitudes=amplitudes[number, :seen],
                truncation=truncation[number, :seen],
            )
    return found


def _added_mass(tank: Tank, count: int) -> np.ndarray | None:
    """M_a of the dry modes."""
    alone = is_plain(tank) and len(tank.bodies) == 1 and tank.geometry.kind == "plane" and tank.top == "free"
    if not alone or type(tank.bodies[0]) is not Beam or not tank.beams[0].is_uniform or tank.beams[0].ends != "free":
        return None
    beam = floating_beam(tank)
    if beam.touches_wall:
        return None
    try:
        return beam.length * pressure_release_added_mass(beam, count, most=_MOST_TERMS)
    except NoEstimateError:
        return None


def _solved(stiffness: np.ndarray, mass: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """1/λ descending, shape (beams, modes), and amplitudes, shape (beams, modes, dry modes), from the stiffness (beams,
    dry modes) and M + M_a of beams with the same motions without stiffness."""
    held, free = np.flatnonzero(stiffness[0]), np.flatnonzero(stiffness[0] == 0.0)
    condensed = mass[:, held[:, None], held]
    if len(free):
        with_free = mass[:, held[:, None], free]
        condensed = condensed - with_free @ np.linalg.solve(mass[:, free[:, None], free], with_free.swapaxes(1, 2))
    roots = np.sqrt(stiffness[:, held])
    inverses, vectors = np.linalg.eigh(condensed / (roots[:, :, None] * roots[:, None, :]))
    inverses, vectors = inverses[:, ::-1], vectors[:, :, ::-1]
    amplitudes = np.zeros((len(stiffness), len(held), stiffness.shape[1]))
    scale = np.sqrt(np.maximum(inverses, np.finfo(float).tiny))
    amplitudes[:, :, held] = (vectors / scale[:, None, :]).swapaxes(1, 2) / roots[:, None, :]
    return inverses, amplitudes
