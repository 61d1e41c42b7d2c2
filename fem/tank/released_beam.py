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


def released_modes(tank: Tank, count: int) -> ReleasedModes | None:
    """Solve the limit in a number of the first dry modes of the beam of a dimensionless tank; ``None`` where that is
    not one uniform beam with free ends between free water, or the liquid is too shallow for the expansion."""
    added_mass = _added_mass(tank, count)
    if added_mass is None:
        return None
    body = body_model(tank, 0).moving(count, None)
    inverses, amplitudes = _solved(body.stiffness, body.mass + added_mass)
    energies = body.stiffness * amplitudes**2 * inverses[:, None]
    truncation = omitted(energies[:, elastic_places(body.dofs)])
    seen = np.count_nonzero(inverses > HIDDEN * inverses[0])
    return ReleasedModes(
        depth=tank.depth,
        bodies=(body,),
        eigenvalues=1.0 / inverses[:seen],
        elastic_amplitudes=amplitudes[:seen],
        truncation=truncation[:seen],
    )


def _added_mass(tank: Tank, count: int) -> np.ndarray | None:
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
    """1/λ descending, shape (modes,), and amplitudes, shape (modes, dry modes), from the stiffness and M + M_a."""
    held, free = np.flatnonzero(stiffness), np.flatnonzero(stiffness == 0.0)
    condensed = mass[np.ix_(held, held)]
    if len(free):
        with_free = mass[np.ix_(held, free)]
        condensed = condensed - with_free @ np.linalg.solve(mass[np.ix_(free, free)], with_free.T)
    roots = np.sqrt(stiffness[held])
    inverses, vectors = np.linalg.eigh(condensed / np.outer(roots, roots))
    inverses, vectors = inverses[::-1], vectors[:, ::-1]
    amplitudes = np.zeros((len(held), len(stiffness)))
    amplitudes[:, held] = (vectors / np.sqrt(np.maximum(inverses, np.finfo(float).tiny))).T / roots
    return inverses, amplitudes
