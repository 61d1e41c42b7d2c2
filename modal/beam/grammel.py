"""The classical quotients of Rayleigh and of Grammel for one pencil and one trial space."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.dry_modes import RIGID_SHAPES
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.gravity_added_mass import MOST_NODES, wetted_shapes
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.surface_operator import surface_operator
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.symmetric_pencil import pencil_modes
from hydroelastic.physics.arrays import FloatArray

_SHAPES = 24
_COVER_NODES = 160
_NODES_PER_DEPTH = 6.0
_MOST_CONTRAST = 1e9


@dataclass(frozen=True, kw_only=True)
class QuotientPair:
    """Both quotients for the same trial space; exact ≤ Grammel ≤ Rayleigh, index by index."""

    grammel: FloatArray  # estimates of λ = ω² from the inertia load, ascending, shape (trials,)
    rayleigh: FloatArray  # estimates of λ = ω² from the trial itself, ascending, shape (trials,)


@dataclass(frozen=True, kw_only=True)
class BeamQuotients:
    """The pair for the floating beam without gravity waves."""

    grammel: float  # estimate of λ = ω² of the elastic tone, rad²/s²
    rayleigh: float  # the same from Rayleigh's quotient, rad²/s²
    exact: float  # λ of the same space with many dry modes, rad²/s²
    index: int  # number of the tone in its space, from 1, zero modes not counted
    space: str  # the space in which the ordering holds


def quotients(stiffness: FloatArray, mass: FloatArray, trials: FloatArray) -> QuotientPair:
    """Return the Rayleigh and Grammel estimates of K f = λ M f on a trial space.

    For one trial f

        λ₁ ≤ (f, Mf)/(Mf, K⁻¹Mf) [Grammel] ≤ (f, Kf)/(f, Mf) [Rayleigh]

    by Cauchy–Schwarz; K⁻¹Mf is the static deflection under the inertia load of f, so force conditions are met. For
    several trials both become small eigenproblems, and by the min–max principle the ordering holds index by index.

    Args:
        stiffness: K, symmetric positive definite, shape (n, n).
        mass: M, symmetric positive definite, shape (n, n).
        trials: columns spanning the trial space, shape (n,) or (n, trials).

    Returns:
        The pair, ascending.

    Source: theory of the aquarium, docs, § 2 ("The classical Grammel quotient").
    """
    f = trials.reshape(len(stiffness), -1)
    load = mass @ f
    factor = np.linalg.cholesky(stiffness)
    deflection = np.linalg.solve(factor, load)
    grammel, _ = pencil_modes(f.T @ load, deflection.T @ deflection)
    rayleigh, _ = pencil_modes(f.T @ stiffness @ f, f.T @ load)
    return QuotientPair(grammel=grammel, rayleigh=rayleigh)


def beam_quotients(beam: FloatingBeam, shapes: int = _SHAPES) -> BeamQuotients:
    """Return both quotients for the elastic tone, trial functions heave, pitch and dry mode 1.

    The space is the beam with ψ = 0 on the water around it, where sloshing is absent (for a beam that covers the tank,
    the beam with its volume conserved). Without hydrostatics the rigid motions make K singular; they are condensed
    through M, which is recoil, and dry mode 1 alone remains as trial. With hydrostatics all three are trials and the
    tone is the one of the highest index.

    Args:
        shapes: dry shapes that stand for the space, rigid ones included.

    Returns:
        The pair, the exact value of the space, and which tone it is.

    Source: theory of the aquarium, docs, § 2.
    """
    rigid, mass, space = _space(beam, shapes)
    stiffness = beam.dry_stiffnesses(shapes)[RIGID_SHAPES - rigid :]
    if not beam.hydrostatic:
        coupling = mass[:rigid, rigid:]
        mass = mass[rigid:, rigid:] - coupling.T @ np.linalg.solve(mass[:rigid, :rigid], coupling)
        stiffness = stiffness[rigid:]
        rigid = 0
    elif beam.first_dry_stiffness > _MOST_CONTRAST * beam.hydrostatic_stiffness:
        raise NoEstimateError("bending and hydrostatic stiffness are too far apart for the inertia load")
    # Scaled by the stiffness, so that a rigid beam does not cost digits.
    scale = 1 / np.sqrt(stiffness)
    scaled_mass = mass * np.outer(scale, scale)
    pair = quotients(np.eye(len(scale)), scaled_mass, np.eye(len(scale))[:, : rigid + 1])
    exact = 1 / np.linalg.eigvalsh(scaled_mass)[::-1]
    return BeamQuotients(
        grammel=float(pair.grammel[rigid]),
        rayleigh=float(pair.rayleigh[rigid]),
        exact=float(exact[rigid]),
        index=rigid + 1,
        space=space,
    )


def _space(beam: FloatingBeam, shapes: int) -> tuple[int, FloatArray, str]:
    """Return the number of rigid motions, the mass matrix and the name of the space."""
    added: FloatArray
    if beam.covers_tank:
        scaled = beam.dimensionless()
        nodes = max(_COVER_NODES, math.ceil(_NODES_PER_DEPTH / scaled.depth))
        if nodes > MOST_NODES:
            raise NoEstimateError(f"{nodes} nodes would be needed for the depth; at most {MOST_NODES} are used")
        indices = tuple(range(1, shapes))
        added = wetted_shapes(surface_operator(scaled, [0, nodes, 0]), indices).beam * beam.density * beam.length
        space = "beam over the whole tank, volume conserved"
        rigid = 1
    else:
        added = pressure_release_added_mass(beam, shapes)
        space = "beam with ψ = 0 on the water around it"
        rigid = 2
    return rigid, added + beam.mass_per_length * np.eye(len(added)), space
