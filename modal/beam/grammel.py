"""The classical quotients of Rayleigh and of Grammel for one pencil and one trial space."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.cosine_moments import cosine_moments
from hydroelastic.modal.beam.dry_modes import RIGID_SHAPES
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.gravity_added_mass import MOST_NODES, wetted_shapes
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.surface_operator import surface_operator
from hydroelastic.modal.beam.tone_pencil import TonePencil, Tones, pencil_modes, solve_tones
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.physics.arrays import FloatArray

_SHAPES = 24
_COVER_NODES = 160
_NODES_PER_DEPTH = 6.0
_MOST_CONTRAST = 1e9

_DECOUPLED = 1e-20
_RANK = 1e-14


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


def one_term_root(beam: FloatingBeam, number: int) -> float:
    """Return the frequency of the one-term estimate ψ = A cos k_n x: the root of

        F_n(λ) = T_nn − (λ/g) S_nn − λ ρ R_nn(λ)

    below its first pole. F_n decreases strictly between the poles, which are the dry frequencies that couple with the
    cosine, so there is exactly one root there; poles that decouple (by symmetry) are skipped. The dynamic compliance
    R_nn = Σ c_j²/(l (K_j − m λ)) is summed over dry shapes: nothing overflows and no resonance is removable.

    Args:
        number: n of the cosine, at least 1.

    Returns:
        Angular frequency, rad/s.

    Source: the one-term formula of the paper, corrected; theory of the aquarium, docs, § 1.2.
    """
    if number < 1:
        raise ValueError(f"number is {number}; cosines are numbered from 1")
    scaled = beam.dimensionless()
    poles, weights, rigid = _compliance(scaled, number)
    k = number * np.pi / scaled.tank_length
    constant = k * math.tanh(k * scaled.depth) * scaled.tank_length / 2 + rigid
    surface = float(_surface_overlap(scaled, np.array([k]))[0, 0])

    # F_n(λ) = 0 is diag(constant, poles) x = λ M x; 1/λ is the largest eigenvalue of the scaled M, to rounding.
    couplings = np.sqrt(weights / poles)
    mass = np.eye(1 + len(poles))
    mass[0, 0] = surface + float(couplings @ couplings)
    mass[0, 1:] = mass[1:, 0] = couplings
    scale = 1.0 / np.sqrt(np.append(constant, poles))
    return beam.frequency_unit / math.sqrt(float(np.linalg.eigvalsh(scale[:, None] * mass * scale)[-1]))


def _compliance(scaled: FloatingBeam, number: int) -> tuple[FloatArray, FloatArray, float]:
    """Return coupled poles λ_j, their weights c_j²/m, and the constant of motions without stiffness."""
    k = np.array([number * np.pi / scaled.tank_length])
    count = 40 + math.ceil(2 * number / scaled.tank_length)
    moments = np.array([cosine_moments(scaled, index, k)[0] for index in range(count)])
    weights = moments**2 / scaled.mass_per_length
    poles = scaled.dry_stiffnesses(count) / scaled.mass_per_length
    free = poles == 0
    coupled = ~free & (moments**2 > _DECOUPLED)
    return poles[coupled], weights[coupled], float(weights[free].sum())


def best_term(beam: FloatingBeam) -> int:
    """Return the cosine that projects most on dry mode 1: the largest c_n²/T_nn, T_nn = k_n tanh(k_n H) L/2."""
    scaled = beam.dimensionless()
    most = 8 + math.ceil(4 * scaled.tank_length)
    k = np.arange(1, most + 1) * np.pi / scaled.tank_length
    return int(np.argmax(cosine_moments(scaled, 2, k) ** 2 / (k * np.tanh(k * scaled.depth)))) + 1


def term_tones(beam: FloatingBeam, terms: int, *, volume_term: bool = True) -> Tones:
    """Return the tones of the N-term potential ψ = Σ A_i cos k_i x as a linear pencil.

    With η = Σ a_i cos k_i x on the water, the beam in dry shapes and T⁺ the inverse of T on i ≥ 1,

        λ {[S T⁺ S, S T⁺ Cᵀ; C T⁺ S, C T⁺ Cᵀ + (m/ρ) G]} (a; q) = {diag(g S, K_q/ρ)} (a; q),   S₀·a + C₀·q = 0,

    reduced to the range of the overlap S. With the volume term i = 0 it is a Ritz method: every tone decreases to the
    exact one, with an error O(N⁻²). Without it (the paper's set) the limit is wrong.

    Args:
        terms: N, the last cosine, at least 1.
        volume_term: whether i = 0 is kept.

    Returns:
        The tones, λ in rad²/s².

    Source: the N-term form of the paper's method; theory of the aquarium, docs, § 1.2.
    """
    if terms < 1:
        raise ValueError(f"terms is {terms}; at least one cosine is needed")
    scaled = beam.dimensionless()
    first = 0 if volume_term else 1
    k = np.arange(first, terms + 1) * np.pi / scaled.tank_length
    shapes = 28 + math.ceil(1.2 * terms / scaled.tank_length)
    moments = np.array([cosine_moments(scaled, index, k) for index in range(shapes)])
    surface = _range_factor(_surface_overlap(scaled, k))
    rows = np.vstack([surface.T, moments])
    waves = k > 0
    own = k[waves] * np.tanh(k[waves] * scaled.depth) * scaled.tank_length / 2
    mass = (rows[:, waves] / own) @ rows[:, waves].T
    mass[-shapes:, -shapes:] += scaled.mass_per_length * np.eye(shapes)
    tones = solve_tones(
        TonePencil(
            stiffness=np.concatenate([np.ones(surface.shape[1]), scaled.dry_stiffnesses(shapes)]),
            mass=mass,
            volume=rows[:, 0] if volume_term else None,
            elastic=surface.shape[1] + 2,
        )
    )
    return Tones(
        squared_frequencies=beam.frequency_unit**2 * tones.squared_frequencies,
        participation=tones.participation,
        elastic_index=tones.elastic_index,
    )


def _surface_overlap(beam: FloatingBeam, k: FloatArray) -> FloatArray:
    """Return S_ij = ∫ cos k_i x cos k_j x dx over the free surface."""

    def integral(wavenumber: FloatArray, low: float, high: float) -> FloatArray:
        # ∫ cos kx dx = (high − low) cos(k mid) sinc, which has no cancellation at k = 0.
        half = (high - low) / 2
        value: FloatArray = 2 * half * np.cos(wavenumber * (low + high) / 2) * np.sinc(wavenumber * half / np.pi)
        return value

    total, difference = k[:, None] + k[None, :], k[:, None] - k[None, :]
    pieces = [(0.0, beam.left_gap), (beam.tank_length - beam.right_gap, beam.tank_length)]
    overlap = np.zeros_like(total)
    for low, high in pieces:
        overlap += (integral(difference, low, high) + integral(total, low, high)) / 2
    return overlap


def _range_factor(overlap: FloatArray) -> FloatArray:
    """Return U √σ with U √σ √σ Uᵀ = S on the numerical range of S, shape (cosines, rank)."""
    values, vectors = np.linalg.eigh(overlap)
    kept = values > _RANK * len(overlap)
    factor: FloatArray = vectors[:, kept] * np.sqrt(values[kept])
    return factor
