"""Added mass and tones of dry shapes on water with gravity waves around the beam."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.dry_modes import free_free_shape
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.surface_operator import SurfaceOperator, nodes_needed, surface_operator
from hydroelastic.modal.beam.tone_pencil import TonePencil, Tones, solve_tones
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.physics.arrays import FloatArray

MOST_NODES = 1500
"""Above this size of the dense matrices the waves (or the depth) are refused as too fine to resolve."""


@dataclass(frozen=True, kw_only=True)
class WettedShapes:
    """Dry shapes on the discretised water, dimensionless (l = ρ = g = 1)."""

    water: FloatArray  # free-surface block of M, with √weights on both sides, shape (n, n)
    coupling: FloatArray  # −free-surface against shape block, shape (n, shapes)
    beam: FloatArray  # ⟨W_i, N W_j⟩, shape (shapes, shapes)
    root_weights: FloatArray  # √weights of the free-surface nodes, shape (n,)
    volume: FloatArray  # ∫ W ds of the shapes, shape (shapes,)


def wetted_shapes(operator: SurfaceOperator, indices: tuple[int, ...]) -> WettedShapes:
    """Project the surface operator of a dimensionless beam on dry shapes.

    Args:
        operator: N on a `FloatingBeam.dimensionless` problem.
        indices: shapes of `free_free_shape`.
    """
    under = operator.on_beam
    loads = np.zeros((len(operator.weights), len(indices)))
    for column, index in enumerate(indices):
        loads[under, column] = free_free_shape(index, operator.beam_coordinate) * operator.weights[under]
    root = np.sqrt(operator.weights[~under])
    response = operator.kernel @ loads
    return WettedShapes(
        water=operator.kernel[np.ix_(~under, ~under)] * np.outer(root, root),
        coupling=root[:, None] * response[~under],
        beam=loads.T @ response,
        root_weights=root,
        volume=np.array([1.0 if index == 0 else 0.0 for index in indices]),
    )


def gravity_added_mass(
    beam: FloatingBeam, squared_frequency: float, indices: tuple[int, ...] = (0, 1, 2)
) -> FloatArray:
    """Return the added mass of dry shapes at a given frequency, gravity waves included.

    With η = λψ/g on the free surface F: (N_FF − g/λ) y + C = −N_FB W, ∫y = −∫W, and

        m_ij = ρ ⟨W_i, N_BB W_j + N_BF y_j + C_j⟩ / l.

    It has poles at the sloshing frequencies of the tank with the beam held still.

    Args:
        squared_frequency: λ = ω², rad²/s², positive.
        indices: shapes of `free_free_shape`, normalised to ∫W² dz = l.

    Returns:
        Added mass per length, kg/m², shape (shapes, shapes), symmetric.

    Source: theory of the aquarium, docs, § 2 ("gravity F at given lam").
    """
    if squared_frequency <= 0:
        raise ValueError(f"squared_frequency is {squared_frequency}; it must be positive")
    if beam.covers_tank and 0 in indices:
        raise ValueError("heave has no added mass where no surface is left to make room for it")
    scaled = beam.dimensionless()
    ratio = squared_frequency / beam.frequency_unit**2
    # The nodes are chosen for a tone below the given λ; here λ itself must be resolved, so it gets some to spare.
    shapes = wetted_shapes(_operator(scaled, 1.5 * ratio, max(indices)), indices)
    count = len(shapes.root_weights)
    unit = beam.density * beam.length
    if count == 0:
        return unit * shapes.beam
    system = np.zeros((count + 1, count + 1))
    system[:count, :count] = shapes.water - np.eye(count) / ratio
    system[:count, count] = system[count, :count] = shapes.root_weights
    load = -np.vstack([shapes.coupling, shapes.volume])
    added = shapes.beam - load.T @ np.linalg.solve(system, load)
    return unit * (added + added.T) / 2


def gravity_tones(beam: FloatingBeam, indices: tuple[int, ...], squared_frequency: float) -> Tones:
    """Return the tones of a beam restricted to a few dry shapes, coupled with the full free surface.

    It is a Ritz solution of the exact problem: each λ lies above the exact one of the same index.

    Args:
        indices: shapes of `free_free_shape`; 2 (dry mode 1) must be among them.
        squared_frequency: largest λ of interest, rad²/s²; sets the resolution.

    Returns:
        The tones, λ in rad²/s².

    Source: theory of the aquarium, docs, § 0 (energy form) and § 2 (`gravity`, `gravity_rigid`).
    """
    scaled = beam.dimensionless()
    unit = beam.frequency_unit**2
    shapes = wetted_shapes(_operator(scaled, squared_frequency / unit, max(indices)), indices)
    dry = scaled.dry_stiffnesses(max(indices) + 1)[list(indices)]
    structure = scaled.mass_per_length * np.eye(len(indices))
    tones = solve_tones(
        TonePencil(
            stiffness=np.concatenate([np.ones(len(shapes.root_weights)), dry]),
            mass=np.block([[shapes.water, shapes.coupling], [shapes.coupling.T, shapes.beam + structure]]),
            volume=np.concatenate([shapes.root_weights, shapes.volume]),
            elastic=len(shapes.root_weights) + indices.index(2),
        )
    )
    return Tones(
        squared_frequencies=unit * tones.squared_frequencies,
        participation=tones.participation,
        elastic_index=tones.elastic_index,
    )


def _operator(scaled: FloatingBeam, ratio: float, largest_index: int) -> SurfaceOperator:
    counts = nodes_needed(scaled, ratio, largest_index)
    if sum(counts) > MOST_NODES:
        raise NoEstimateError(
            f"{sum(counts)} nodes would be needed for the shortest wave or for the depth; at most {MOST_NODES} are used"
        )
    return _cached_operator(scaled, tuple(counts))


@functools.lru_cache(maxsize=2)
def _cached_operator(scaled: FloatingBeam, counts: tuple[int, ...]) -> SurfaceOperator:
    return surface_operator(scaled, list(counts))
