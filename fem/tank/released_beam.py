"""The infinite-frequency limit of one uniform beam between free water, without a mesh.

With ψ = 0 on the water beside it, the liquid under a beam in a rectangle is known by Green's function of the tank: in
the dry modes of the beam its added mass M_a is that of `modal.beam.pressure_release`, which converges exponentially.
The modes follow from

    K a = λ (M + M_a) a        rigid motions without stiffness follow the others and are condensed
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.bodies.registry import body_model
from hydroelastic.fem.modes import HIDDEN
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.error_estimates import ROUNDING_OF_SPREAD, FrequencyErrors
from hydroelastic.fem.tank.mesh import is_plain
from hydroelastic.fem.truncation import truncation_errors
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
        bodies: the beam.
        eigenvalues: dimensionless λ, shape (modes,).
        elastic_amplitudes: of the dry modes at unit generalized mass, rigid motions without stiffness left out, shape
            (modes, dry modes).
        errors: relative errors of ω of all modes.
    """

    bodies: tuple[Body, ...]
    eigenvalues: np.ndarray
    elastic_amplitudes: np.ndarray
    errors: FrequencyErrors


def released_modes(tank: Tank, count: int) -> ReleasedModes | None:
    """Solve the limit in the first dry modes of the beam.

    Args:
        tank: the dimensionless tank.
        count: number of dry modes.

    Returns:
        All modes; ``None`` where the liquid is not that of one uniform beam with free ends between free water, or is
        too shallow for the expansion.
    """
    alone = is_plain(tank) and len(tank.bodies) == 1 and tank.geometry.kind == "plane" and tank.top == "free"
    if not alone or type(tank.bodies[0]) is not Beam or not tank.beams[0].is_uniform or tank.beams[0].ends != "free":
        return None
    beam = floating_beam(tank)
    if beam.touches_wall:
        return None
    try:
        added_mass = pressure_release_added_mass(beam, count, most=_MOST_TERMS)
    except NoEstimateError:
        return None
    body = body_model(tank, 0).moving(count, None)
    mass = body.mass + beam.length * added_mass
    held, free = np.flatnonzero(body.stiffness), np.flatnonzero(body.stiffness == 0.0)
    follow = -np.linalg.solve(mass[free][:, free], mass[free][:, held])
    roots = np.sqrt(body.stiffness[held])
    condensed = (mass[held][:, held] + mass[held][:, free] @ follow) / np.outer(roots, roots)
    inverses, vectors = np.linalg.eigh(condensed)
    seen = np.flatnonzero(inverses > HIDDEN * inverses[-1])[::-1]
    values = 1.0 / inverses[seen]
    amplitudes = np.zeros((len(seen), count))
    amplitudes[:, held] = (vectors[:, seen] * np.sqrt(values)).T / roots
    # An error of λ is twice that of ω. The liquid's expansion leaves none: its last eighth adds less than 2e-19.
    errors = FrequencyErrors(
        liquid=np.zeros(len(seen)),
        tips=np.zeros(len(seen)),
        truncation=0.5 * truncation_errors((body,), amplitudes, values),
        rounding=_ROUNDING * max(1.0, 0.1 / tank.depth) + ROUNDING_OF_SPREAD * values / values[0],
    )
    return ReleasedModes(bodies=(body,), eigenvalues=values, elastic_amplitudes=amplitudes, errors=errors)
