"""Tanks of one or two liquids with beams and floats, made from a few values, and dense solutions of their matrices."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc
from scipy.linalg import eigh, null_space
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import splu

from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.tank.field_model import build_mesh
from hydroelastic.fem.tank.field_solution import part_models
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, Tank
from hydroelastic.scenes.tank.solve import solve_scene

GRAVITY = 9.81


def layered(
    *bodies: Beam | Float,
    densities: tuple[float, ...] = (1000.0, 850.0),
    depths: tuple[float, ...] = (0.3, 0.2),
    length: float = 1.0,
    top: str = "rigid",
    tolerance: float = 1e-8,
    modes: int = 6,
) -> TankScene:
    """A tank with liquids from the bottom up."""
    return TankScene(
        tank=Tank(length=length, gravity=GRAVITY, top=top),
        liquid=tuple(Liquid(density=density, depth=depth) for density, depth in zip(densities, depths, strict=False)),
        body=bodies,
        accuracy=Accuracy(tolerance=tolerance, modes=modes),
    )


def rigid(shape: str, position: float, motions: str = "heave", **keys: Any) -> Float:
    """A float; its motions as one word each."""
    return Float(kind="float", shape=shape, position=position, motions=tuple(motions.split()), **keys)


def pencils(
    scene: TankScene, *, half: bool = False, coarse: bool = True, infinite_frequency: bool = False
) -> tuple[CoupledPencil, ...]:
    """The matrices of a scene, or of its halves, on a mesh for few unknowns (collective)."""
    tank = physical_tank(scene).scaled()
    resolution = initial_resolution(tank, scene.accuracy.tolerance, modes=scene.accuracy.modes)
    if coarse:
        resolution = replace(resolution, degree=4, shapes=tuple(min(count, 6) for count in resolution.shapes))
    mesh = build_mesh(MPI.COMM_WORLD, tank, resolution, half=half, infinite_frequency=infinite_frequency)
    parts = part_models(
        mesh, tank, resolution.degree, resolution.shapes, half=half, infinite_frequency=infinite_frequency
    )
    return tuple(parts.values())


def sparse(matrix: PETSc.Mat) -> csr_matrix:
    """A matrix of one process for SciPy."""
    rows, columns, values = matrix.getValuesCSR()
    return csr_matrix((values, columns, rows), shape=matrix.getSize())


class PlainProblem:
    """K ζ = λ (M ζ + (ρC)ᵀψ), A ψ = C ζ from the plain matrices of one process, and what keeps the volumes.

    Attributes:
        stiffness, mass: K and M as full arrays.
        coupling, laplace: C and A, sparse.
        densities: ρ at each unknown of ψ.
        fixed: unknowns of ψ that are zero on a surface with ψ = 0.
        volumes: what each unknown takes from each closed layer, shape (closed layers, n).
        pins: one unknown of ψ of each closed layer.
    """

    def __init__(self, pencil: CoupledPencil) -> None:
        """Take nothing that the package made of the matrices."""
        liquid = pencil.liquid
        self.stiffness, self.mass = (sparse(matrix).toarray() for matrix in (pencil.stiffness, pencil.mass))
        self.coupling, self.laplace = sparse(pencil.coupling), sparse(pencil.laplace)
        self.densities = np.array([layer.density for layer in liquid.layers])[liquid.owned_layer_of]
        self.fixed = liquid.surface_dofs(liquid.zero_potential) if liquid.zero_potential else np.empty(0, dtype=int)
        layers = [np.flatnonzero(liquid.owned_layer_of == layer) for layer in range(len(liquid.layers))]
        closed = [dofs for dofs in layers if not np.isin(dofs, self.fixed).any()]
        self.volumes = np.array([self.coupling[dofs].sum(axis=0) for dofs in closed]).reshape(len(closed), -1)
        self.pins = np.array([dofs[0] for dofs in closed], dtype=int)

    def added_mass(self, basis: np.ndarray | None = None, pins: np.ndarray | None = None) -> np.ndarray:
        """(ρC)ᵀA⁻¹C on some combinations of the unknowns, with ψ = 0 at the pins."""
        coupling = self.coupling.toarray() if basis is None else self.coupling @ basis
        free = np.setdiff1d(np.arange(len(self.densities)), [*self.fixed, *(self.pins if pins is None else pins)])
        potential = splu(self.laplace[free][:, free].tocsc()).solve(coupling[free])
        added = (self.densities[free, None] * coupling[free]).T @ potential
        return 0.5 * (added + added.T)

    def eigenvalues(self, count: int, *, shift: float = 1.0, stiffness: np.ndarray | None = None) -> np.ndarray:
        """The lowest λ of what keeps the volumes, motions without stiffness (λ = 0) and growing ones included.

        Args:
            count: how many.
            shift: more than the largest −λ; λ + shift keeps its digits.
            stiffness: another K.
        """
        basis = null_space(self.volumes, rcond=1e-10) if len(self.volumes) else np.eye(len(self.stiffness))
        restoring = basis.T @ (self.stiffness if stiffness is None else stiffness) @ basis
        inertia = basis.T @ self.mass @ basis + self.added_mass(basis)
        return 1.0 / eigh(inertia, restoring + shift * inertia, eigvals_only=True)[::-1][:count] - shift


def frequencies(eigenvalues: np.ndarray, scene: TankScene) -> np.ndarray:
    """ω in rad/s of dimensionless λ > 0."""
    return np.sqrt(eigenvalues * scene.tank.gravity / scene.tank.length)


def check_processes(scene: TankScene, *, halves: bool = True) -> None:
    """All processes together find what each finds on its own, to rounding; nothing is checked on a single one."""
    if MPI.COMM_WORLD.size == 1:
        pytest.skip("there is one process")
    together, alone = (solve_scene(scene, comm=comm, halves=halves) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF))
    assert together.reasons == alone.reasons == ()
    assert together.modes.zero_modes == alone.modes.zero_modes

    def values(solution: TankSolution) -> list[float]:
        return [mode.eigenvalue for mode in (*solution.asked, *solution.modes.growing)]

    # Sums over unknowns in another order; measured below 1e-12 of λ, twice that of ω.
    assert values(together) == pytest.approx(values(alone), rel=2e-11)
    for one, other in zip(together.asked, alone.asked, strict=True):
        sizes = np.abs(other.body_amplitudes).max(initial=1e-300)
        assert np.abs(one.body_amplitudes) == pytest.approx(np.abs(other.body_amplitudes), abs=1e-7 * sizes)
    assert [tone.pressure_release for tone in together.tones] == pytest.approx(
        [tone.pressure_release for tone in alone.tones], rel=2e-11
    )
    if alone.added_mass is not None:
        matrices = [solution.added_mass.matrix for solution in (together, alone)]
        assert matrices[0] == pytest.approx(matrices[1], rel=1e-10, abs=1e-12 * np.abs(matrices[1]).max())
