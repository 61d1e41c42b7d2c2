"""Vibration modes of a thread about an equilibrium: roots λ of (λ² M + λ C + K) y = 0, with errors and shapes.

Decay of a mode by quadratic drag in a liquid at rest, as that of a linear damping that takes the same energy.

    ∫ kn |v_n|³ over a period with v = ω a φ cos ωt is that of the linear resistance c = (8/3π) kn ω a |φ|,

so that the amplitude a decays at the rate σ = (4/3π) ω a D₃/(φᵀMφ), where D₃ = ∫ kn |φ_n|³ + kt |φ_t|³ + Σ k |φ|³. It
is an estimate, the first term for small damping; linear damping comes besides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.thread.eigenpairs import Eigenpair, eigenpairs, is_oscillating, roots_near_zero
from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.hyperbolicity import require_real_wave_speeds
from hydroelastic.fem.thread.operators import ThreadOperators, thread_operators
from hydroelastic.fem.thread.table import line_table
from hydroelastic.meshes.compat import collapsed

# Relative to its extent: a thread is planar, or straight, if it deviates less from a plane, or a line.
_FLAT = 1e-8
# Relative error of a root by the iteration.
_CONVERGED = 1e-12


@dataclass(frozen=True, kw_only=True)
class Roots:
    """Motions e^{λt} of one kind, by ascending magnitude."""

    values: NDArray[np.complex128]  # λ, 1/s, Im λ ≥ 0, shape (modes,)
    errors: NDArray[np.float64]  # estimate of their absolute errors, 1/s, shape (modes,)
    residuals: NDArray[np.float64]  # backward errors of the algebraic problem, shape (modes,)
    # displacements y at the nodes, y*My = (m + ma) L + Σ (M_k + M_a,k), the largest component real and positive, shape
    # (modes, nodes, dimension)
    shapes: NDArray[np.complex128]
    # share of y*My that leaves the plane of the equilibrium, from 0 to 1; NaN in two dimensions, for a straight thread
    # and for one that lies in no plane, shape (modes,)
    out_of_plane: NDArray[np.float64]

    @property
    def damping_ratios(self) -> NDArray[np.float64]:
        """−Re λ/|λ|; negative for a motion that grows."""
        ratios: NDArray[np.float64] = -self.values.real / np.abs(self.values)
        return ratios

    @property
    def relative_errors(self) -> NDArray[np.float64]:
        """Errors over |λ|."""
        ratios: NDArray[np.float64] = self.errors / np.abs(self.values)
        return ratios


@dataclass(frozen=True, kw_only=True)
class ThreadModes:
    """The motions of smallest |λ|."""

    nodes: NDArray[np.float64]  # s of the shapes, m, shape (nodes,)
    oscillating: Roots  # as many as requested, one of each conjugate pair; ω = Im λ
    aperiodic: Roots  # all with real λ up to the magnitude of the last oscillating one; in a stream often the slowest
    # rates at which the amplitudes asked for begin to decay by quadratic drag in a liquid at rest, 1/s, shape
    # (oscillating,); an estimate, besides −Re λ
    quadratic_decay: NDArray[np.float64] | None = None

    @property
    def frequencies(self) -> NDArray[np.float64]:
        """Circular frequencies Im λ of the oscillating motions, rad/s."""
        return self.oscillating.values.imag

    @property
    def relative_error(self) -> float:
        """The largest of the relative errors of all roots, those that do not oscillate among them."""
        return max(float(np.max(part.relative_errors, initial=0.0)) for part in (self.oscillating, self.aperiodic))

    @property
    def is_stable(self) -> bool:
        """Whether none of the motions grows by more than the error of its root."""
        parts = (self.oscillating, self.aperiodic)
        return not any(np.any(part.values.real > part.errors) for part in parts)


def thread_modes(
    equilibrium: Equilibrium,
    coarser: Equilibrium,
    count: int,
    *,
    velocity_damping: bool = True,
    amplitude: float | None = None,
    ill_posed_too: bool = False,
) -> ThreadModes:
    """The slowest motions of a thread about an equilibrium."""
    if not ill_posed_too:
        require_real_wave_speeds(equilibrium)
    operators = thread_operators(equilibrium, velocity_damping=velocity_damping)
    pairs = eigenpairs(operators, count)
    rough = thread_operators(coarser, velocity_damping=velocity_damping)
    compared = roots_near_zero(rough, count) / rough.time_unit
    normal = _plane_normal(equilibrium)
    modes = [_Mode(operators, pair, compared, normal) for pair in pairs]
    oscillating = np.array([is_oscillating(pair.root) for pair in pairs])
    decay = None
    if amplitude is not None:
        quadratic = QuadraticDecay(operators)
        decay = np.array([quadratic.rate(pair, amplitude) for pair in pairs if is_oscillating(pair.root)])
    return ThreadModes(
        nodes=equilibrium.space.nodes * equilibrium.units.length,
        oscillating=_roots(equilibrium, modes, oscillating),
        aperiodic=_roots(equilibrium, modes, ~oscillating),
        quadratic_decay=decay,
    )


class _Mode:
    def __init__(
        self,
        operators: ThreadOperators,
        pair: Eigenpair,
        compared: NDArray[np.complex128],
        normal: NDArray[np.float64] | None,
    ) -> None:
        parts = (pair.real, pair.imaginary)
        generalized_mass = sum(_product(operators.mass, part, part) for part in parts)
        if not generalized_mass > 0.0:
            raise EigenSolverError(f"the motion with λ = {pair.root:g} has no mass")
        self.value = pair.root / operators.time_unit
        rounded = sum(_rounding(operators.stiffness, part) for part in parts) / (
            2.0 * generalized_mass * abs(pair.root)
        )
        distance = float(np.min(np.abs(compared - self.value)))
        self.error = distance + rounded / operators.time_unit + _CONVERGED * abs(self.value)
        self.residual = pair.residual
        total = _total_mass(operators)
        self.shape = _shape(operators, pair) * np.sqrt(total / generalized_mass)
        self.out_of_plane = np.nan
        if normal is not None:
            out = sum(_product(operators.mass, out, out) for out in (_along(operators, part, normal) for part in parts))
            self.out_of_plane = out / generalized_mass


def _roots(equilibrium: Equilibrium, modes: list[_Mode], chosen: NDArray[np.bool_]) -> Roots:
    parts = [mode for mode, included in zip(modes, chosen, strict=True) if included]
    size = (len(parts), len(equilibrium.space.nodes), equilibrium.space.dimension)
    return Roots(
        values=np.array([mode.value for mode in parts], dtype=np.complex128),
        errors=np.array([mode.error for mode in parts], dtype=np.float64),
        residuals=np.array([mode.residual for mode in parts], dtype=np.float64),
        shapes=np.array([mode.shape for mode in parts], dtype=np.complex128).reshape(size),
        out_of_plane=np.array([mode.out_of_plane for mode in parts], dtype=np.float64),
    )


def _total_mass(operators: ThreadOperators) -> float:
    """(m + ma) L + Σ (M_k + M_a,k) in the units of the matrix M."""
    model = operators.equilibrium.forms.model
    total = (model.mass + model.added_mass) * model.length + sum(load.mass + load.added_mass for load in model.bodies)
    return float(total * (operators.equilibrium.units.time / operators.time_unit) ** 2)


def _shape(operators: ThreadOperators, pair: Eigenpair) -> NDArray[np.complex128]:
    nodes = operators.equilibrium.space.nodes
    real, imaginary = (line_table(operators.function(part), nodes, 0).at(nodes) for part in (pair.real, pair.imaginary))
    shape = real + 1j * imaginary
    largest = shape.flat[int(np.argmax(np.abs(shape)))]
    return np.asarray(shape * np.conj(largest) / abs(largest))


def _along(operators: ThreadOperators, vector: PETSc.Vec, normal: NDArray[np.float64]) -> PETSc.Vec:
    function = operators.function(vector)
    _, places = collapsed(function.function_space, 0)
    displacement = function.x.array[places].reshape(-1, len(normal))
    function.x.array[:] = 0.0
    function.x.array[places] = np.outer(displacement @ normal, normal).ravel()
    result = operators.zeros()
    result.array[:] = function.x.array[operators.free]
    return result


def _plane_normal(equilibrium: Equilibrium) -> NDArray[np.float64] | None:
    """Normal of the only plane in which the thread lies, or ``None`` (collective)."""
    if equilibrium.space.dimension == 2:
        return None
    points = line_table(equilibrium.solution, equilibrium.space.nodes, 0).values.reshape(-1, 3)
    _, extents, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    flat = extents < _FLAT * extents[0]
    return axes[2] if flat[2] and not flat[1] else None


def _product(matrix: PETSc.Mat, left: PETSc.Vec, right: PETSc.Vec) -> float:
    image = left.duplicate()
    matrix.mult(right, image)
    return float(left.dot(image))


def _rounding(stiffness: PETSc.Mat, vector: PETSc.Vec) -> float:
    """Bound of the change of yᵀKy by rounding of the entries of K, taken as independent (collective)."""
    terms = stiffness.getDiagonal().array_r * vector.array_r**2
    total = stiffness.comm.tompi4py().allreduce(float(terms @ terms), op=MPI.SUM)
    return float(4.0 * np.finfo(float).eps * np.sqrt(total))


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
