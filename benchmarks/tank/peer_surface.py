"""What both peers make of their matrices: the eigenproblem on the top, from an answer of the liquid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse

from hydroelastic.benchmarks.tank.cases import BenchmarkTank
from hydroelastic.benchmarks.tank.surface_modes import SurfaceProblem, lowest_eigenvalues
from hydroelastic.benchmarks.tank.symmetry import ModeClass
from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class Surface:
    """Matrices of the top; its unknowns are those of ψ there that are not prescribed.

    Attributes:
        water_mass: ∫φφ over the water, all unknowns of the top.
        water: unknowns on the closure of the water.
        loads: ∫φW over the beam, shape (unknowns, shapes).
        constant: coefficients of ψ = 1.
        beam_length: length of the beam in what is meshed, m.
    """

    water_mass: scipy.sparse.csr_matrix
    water: np.ndarray
    loads: FloatArray
    constant: FloatArray
    beam_length: float

    def restricted(self, kept: np.ndarray, shapes: tuple[int, ...]) -> Surface:
        """The same for some of the unknowns of the top and some shapes."""
        return Surface(
            water_mass=self.water_mass[kept][:, kept],
            water=np.flatnonzero(np.isin(kept, self.water)),
            loads=self.loads[kept][:, list(shapes)],
            constant=self.constant[kept],
            beam_length=self.beam_length,
        )


def class_frequencies(
    tank: BenchmarkTank, surface: Surface, modes: ModeClass, answer: Callable[[FloatArray], FloatArray]
) -> tuple[float, ...]:
    """Lowest ω of one class of modes, rad/s.

    As Kη = ρgSη on the water and the liquid's momentum there is ρSψ, K⁻¹ of it is ψ/g, and nothing is to be inverted.
    """
    beam = tank.beam
    shapes = len(modes.shapes)
    stiffness = beam.dry_stiffnesses(max(modes.shapes) + 1)[list(modes.shapes)] * surface.beam_length / beam.density
    mass = beam.mass_per_length * surface.beam_length / beam.density
    rigid = np.flatnonzero(stiffness == 0.0)
    flexibility = np.divide(1.0, stiffness, out=np.zeros(shapes), where=stiffness > 0.0)
    water, gravity = surface.water, beam.gravity
    mass_of_water = surface.water_mass[water][:, water]
    loads, shapes_of = surface.loads, np.ascontiguousarray(surface.loads.T)

    def weigh(vector: FloatArray) -> FloatArray:
        return np.concatenate([stiffness * vector[:shapes], gravity * (mass_of_water @ vector[shapes:])])

    def respond(vector: FloatArray, weighed: FloatArray) -> tuple[FloatArray, FloatArray]:
        load = loads @ vector[:shapes]
        load[water] += weighed[shapes:] / gravity
        potential = answer(load)
        momentum = mass * vector[:shapes] + shapes_of @ potential
        return momentum[rigid], np.concatenate([flexibility * momentum, potential[water] / gravity])

    displaced = shapes_of @ surface.constant
    on_water = surface.constant[water]
    problem = SurfaceProblem(
        size=shapes + len(water),
        free_rigid=rigid,
        weigh=weigh,
        respond=respond,
        volume=None if modes.antisymmetric else np.concatenate([displaced, mass_of_water @ on_water]),
        volume_response=np.concatenate([flexibility * displaced, on_water / gravity]),
    )
    modes_found = lowest_eigenvalues(problem, modes.count, tolerance=1e-11)
    return tuple(float(value) for value in np.sqrt(modes_found.eigenvalues))
