"""Decay of a mode by quadratic drag in a liquid at rest, as that of a linear damping that takes the same energy.

    ∫ kn |v_n|³ over a period with v = ω a φ cos ωt is that of the linear resistance c = (8/3π) kn ω a |φ|,

so that the amplitude a decays at the rate σ = (4/3π) ω a D₃/(φᵀMφ), where D₃ = ∫ kn |φ_n|³ + kt |φ_t|³ + Σ k |φ|³. It
is an estimate, the first term for small damping; linear damping comes besides.
"""

from __future__ import annotations

import numpy as np
from dolfinx import fem
from mpi4py import MPI

from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.thread.eigenpairs import Eigenpair
from hydroelastic.fem.thread.operators import ThreadOperators
from hydroelastic.fem.thread.table import line_table
from hydroelastic.meshes.compat import collapsed


class QuadraticDecay:
    """Decay rates of the modes of one thread.

    Raises:
        ValueError: in a stream, where the drag has a linear part that C holds.
    """

    def __init__(self, operators: ThreadOperators) -> None:
        forms, space = operators.equilibrium.forms, operators.equilibrium.space
        if forms.stream is not None:
            raise ValueError("amplitude is given, but in a stream the drag damps linearly: leave it out")
        self._operators = operators
        positions, self._places = collapsed(space.mixed, 0)
        self._shape = fem.Function(positions)
        self._velocity = fem.Function(self._shape.function_space)
        position = operators.equilibrium.state.position
        work = forms.load_work(position, self._velocity, self._shape) - forms.load_work(position, None, self._shape)
        self._work = compiled_form(work)

    def rate(self, pair: Eigenpair, amplitude: float) -> float:
        """σ in 1/s."""
        operators, equilibrium = self._operators, self._operators.equilibrium
        function = operators.function(pair.real)
        table = line_table(function, equilibrium.space.nodes, 0).at(equilibrium.space.nodes)
        largest = float(np.linalg.norm(table, axis=1).max())
        self._shape.x.array[:] = function.x.array[self._places] / largest
        cubic = self._cubic_part()
        image = operators.zeros()
        operators.mass.mult(pair.real, image)
        time = operators.time_unit / equilibrium.units.time
        mass = float(image.dot(pair.real)) * time**2 / largest**2
        scaled = amplitude / equilibrium.units.length
        frequency = abs(pair.root) / time
        return 4.0 / (3.0 * np.pi) * frequency * scaled * cubic / mass / equilibrium.units.time

    def _cubic_part(self) -> float:
        """D₃ of A x² + D₃ x³, the power at x times the shape as velocity, from two values of x."""
        powers = []
        for factor in (1.0, 2.0):
            self._velocity.x.array[:] = factor * self._shape.x.array
            work = self._shape.function_space.mesh.comm.allreduce(fem.assemble_scalar(self._work), op=MPI.SUM)
            powers.append(-factor * float(work))
        return (powers[1] - 4.0 * powers[0]) / 4.0
