"""Strongly damped resonances, whose outgoing waves grow faster with the distance than complex scaling can turn to
decay.

Their complex conjugate e^{−iω̄t} grows in time, and has incoming waves only. At λ̄, above the axis, the outgoing waves
of T = A − λ̄M decay with the distance, the faster the further from the axis, and coordinates are rotated by a small
angle only. With amplitudes b of an even and an odd standing wave φ, each incident from both sides and outgoing to both,

    ψ = T⁻¹(Fa − gb) + Σ bφ

has no outgoing wave if Xa + Wb = 0, with

    X = ∫ρφφᵢ + Fᵀφ_D,    W = gᵀT⁻¹g − ∫ρφ ∂φ'/∂n ∓ 2ikN,    φ_D = −T⁻¹g,

−2ikN for the even one: W is the scattering matrix of fixed bodies, by the fluxes I(φ) of `incident_waves`. Then the
conjugate of

    FᵀT⁻¹F − Xᵀ W⁻¹ X

is H(λ) of outgoing waves, continued from the axis. It is stationary, so that its discretization error is the energy
error of T⁻¹(Fa − gb). On a thin float XᵀW⁻¹X is the term −2πi R(−z²)² of `docs/theory_open_water.md`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, pi

import numpy as np
from mpi4py import MPI
from scipy.linalg import eig

from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.incident_waves import Standing, surface_integrals
from hydroelastic.fem.open_water.reduced_pencil import ReducedPencil
from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.resonance_search import Eigenpair
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.modal.liquid.deep_water_wave import DeepWaterWave

# Newton's method: relative last step, most steps on one basis, most solutions that are added to the basis.
_STEP = 1e-11
_MOST_STEPS = 20
_MOST_SOLUTIONS = 8
# Relative step of the difference quotient in λ, whose error is of second order.
_DIFFERENCE = 1e-4
# Largest change of λ from the start of Newton's method, relative.
_FARTHEST = 0.25
# Relative difference of ω below which two starts have found the same resonance.
_SAME = 1e-6
# Excitation below this part of the largest is that of asymmetric meshes.
_NOT_EXCITED = 1e-3
# Loads of a wave below this part of those of the other one are rounding.
_CANCELLED = 1e-13


def mirror_angle(damping: float) -> float:
    """α of the complex scaling, rad, for equally fast decay of waves on the real axis and at −Im ω/Re ω =
    ``damping``."""
    return 0.5 * pi - atan(damping)


@dataclass(frozen=True, kw_only=True)
class Root:
    """A resonance on the reduced basis."""

    squared: complex
    bodies: np.ndarray  # body unknowns a, shape (body unknowns,)
    norm: complex  # aᵀ D'(λ) a
    step: float  # relative last step of Newton's method


@dataclass(frozen=True, kw_only=True)
class _Waves:
    """The waves φ at λ̄: loads L = (F, −g), ∫ρφφᵢ, and the part of W without gᵀT⁻¹g."""

    loads: np.ndarray
    pressures: np.ndarray
    scattering: np.ndarray

    def without_radiation(self, responses: np.ndarray) -> _Motions:
        """Motions without outgoing waves."""
        count = len(responses) - len(self.pressures)
        excitation = self.pressures + responses[count:, :count]
        scattering = self.scattering + responses[count:, count:]
        amplitudes = -np.linalg.solve(scattering, excitation)
        return _Motions(
            hydrodynamic=responses[:count, :count] + excitation.T @ amplitudes,
            unknowns=np.hstack([np.eye(count), amplitudes.T]),
            excitation=excitation,
            scattering=scattering,
        )


@dataclass(frozen=True, kw_only=True)
class _Motions:
    """Motions at λ̄ without outgoing waves: H, (a, b) of a unit of each, shape (body unknowns, …), X, and W."""

    hydrodynamic: np.ndarray
    unknowns: np.ndarray
    excitation: np.ndarray
    scattering: np.ndarray


@dataclass(frozen=True, kw_only=True)
class _Reduced:
    """Motions without outgoing waves on the reduced basis."""

    motions: _Motions  # H, unknowns, X and W
    loads: np.ndarray  # Fa − gb of a unit of each, shape (body unknowns, own free unknowns)
    coordinates: np.ndarray  # of T⁻¹(Fa − gb), shape (body unknowns, basis)


class DampedSolver:
    """H of one model in infinitely deep liquids, on a reduced basis.

    Args:
        model: the problem, with coordinates rotated by `mirror_angle`.
    """

    def __init__(self, model: OpenModel) -> None:
        """Prepare (collective)."""
        self.model = model
        self._direct: ShiftedSolver = model.pencil.solver()
        self._reduced = ReducedPencil(model.pencil)
        # Whether motions of bodies excite the even and the odd wave at any frequency solved so far.
        self._excited = np.zeros(2, dtype=bool)

    @property
    def basis_size(self) -> int:
        """Number of vectors of the reduced basis."""
        return self._reduced.size

    def wavenumber(self, omega: complex) -> complex:
        """k of the waves at ω in rad/s, in units of the basin."""
        return DeepWaterWave(
            layers=self.model.basin.scaled_layers, squared=self.model.squared_frequency(omega)
        ).wavenumber

    def radiation(self, squared: complex) -> None:
        """Add the solutions at λ to the basis (collective)."""
        mirrored = squared.conjugate()
        waves = self._waves(mirrored)
        self._direct.shift(mirrored)
        solutions = np.array([self._direct.solve(load) for load in waves.loads])
        unknowns = waves.without_radiation(self.model.pencil.products(waves.loads, solutions)).unknowns
        self._reduced.add(mirrored, unknowns @ solutions, unknowns @ waves.loads)

    def hydrodynamics(self, squares: np.ndarray) -> np.ndarray:
        """H at many λ on the basis, shape (λ, body unknowns, body unknowns) (collective)."""
        return np.array([self._mirrored(square.conjugate()).motions.hydrodynamic.conj() for square in squares])

    def continued(self, squares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return H, shape (λ, body unknowns, body unknowns), and det W/|det W|, shape (λ,), zero at poles of H
        (collective).

        Waves that no motion excites, as beside symmetric bodies, are left out.
        """
        found = [self._mirrored(square.conjugate()).motions for square in squares]
        water = [np.linalg.slogdet(one.scattering[np.ix_(self._excited, self._excited)])[0] for one in found]
        return np.array([one.hydrodynamic.conj() for one in found]), np.array(water).conj()

    def hydrodynamic(self, squared: complex) -> tuple[np.ndarray, float]:
        """H at λ on the basis, and the largest relative residual of its motions (collective)."""
        found = self._mirrored(squared.conjugate())
        sizes = np.abs(found.motions.excitation).max(axis=1)
        self._excited |= sizes > _NOT_EXCITED * sizes.max()
        misfits = self._reduced.misfits(squared.conjugate(), found.loads, found.coordinates)
        # Far from the axis H is nearly all XᵀW⁻¹X: the residual is relative to the whole inertia.
        whole = np.abs(np.diag(self.model.mass + found.motions.hydrodynamic))
        return found.motions.hydrodynamic.conj(), float((misfits / np.sqrt(whole)).max())

    def root(self, start: complex) -> Root | None:
        """The resonance next to a λ by Newton's method on the basis; ``None`` without convergence (collective)."""
        squared = start
        for _ in range(_MOST_STEPS):
            own, *around = self.hydrodynamics(squared * np.array([1.0, 1.0 - _DIFFERENCE, 1.0 + _DIFFERENCE]))
            inertia = self.model.mass + own
            slope = inertia + (around[1] - around[0]) / (2.0 * _DIFFERENCE)
            slope = slope + 0.5j / np.sqrt(squared) * self.model.outside.damping
            steps, vectors = eig(self.model.restoring(squared) - squared * inertia, slope)
            nearest = int(np.argmin(np.where(np.isfinite(steps), np.abs(steps), np.inf)))
            # All processes must take the same branch in spite of rounding.
            step, bodies = self.model.pencil.comm.bcast((complex(steps[nearest]), vectors[:, nearest]))
            squared += step
            if abs(squared - start) > _FARTHEST * abs(start):
                return None
            if abs(step) <= _STEP * abs(squared):
                return Root(
                    squared=squared, bodies=bodies, norm=-complex(bodies @ slope @ bodies), step=abs(step / squared)
                )
        return None

    def refined(self, eigenvalue: complex) -> Eigenpair:
        """The resonance next to a λ; its potential is that of the elements, without the waves φ (collective)."""
        squared = eigenvalue
        for _ in range(_MOST_SOLUTIONS):
            self.radiation(squared)
            root = self.root(squared)
            if root is None:
                break
            moved, squared = abs(root.squared - squared), root.squared
            if moved <= _STEP * abs(squared):
                return self._pair(root)
        raise EigenSolverError(f"Newton's method does not converge to a resonance near {eigenvalue:g}")

    def _pair(self, root: Root) -> Eigenpair:
        pencil = self.model.pencil
        found = self._mirrored(root.squared.conjugate())
        potential = (root.bodies.conj() @ self._reduced.potentials(found.coordinates)).conj()
        turned = [complex_product(matrix, potential.conj()) for matrix in pencil.turning()]
        moved = turned[0] - root.squared.conjugate() * turned[1]
        return Eigenpair(
            eigenvalue=root.squared,
            bodies=root.bodies,
            potential=potential,
            norm=root.norm,
            drift=abs(complex(pencil.products(potential.conj()[None], moved[None])[0, 0]) / root.norm),
            participation=abs(root.bodies @ self.model.mass @ root.bodies / root.norm),
            residual=root.step,
        )

    def _waves(self, mirrored: complex) -> _Waves:
        wave = DeepWaterWave(layers=self.model.basin.scaled_layers, squared=mirrored)
        standing = [Standing(wave=wave, odd=odd) for odd in (False, True)]
        fluxes, pressures, own = surface_integrals(self.model, standing)
        # Beside a slit x is zero but for rounding, by which the flux of waves that grow along it is multiplied.
        sizes = np.abs(fluxes).max(axis=1, initial=0.0)
        self.model.pencil.comm.Allreduce(MPI.IN_PLACE, sizes, op=MPI.MAX)
        cancelled = sizes < _CANCELLED * sizes.max()
        fluxes[cancelled], own[cancelled], own[:, cancelled] = 0.0, 0.0, 0.0
        power = wave.wavenumber * wave.energy
        return _Waves(
            loads=np.vstack([self.model.pencil.loads, -fluxes]),
            pressures=pressures,
            scattering=np.diag([-2j * power, 2j * power]) - own,
        )

    def _mirrored(self, mirrored: complex) -> _Reduced:
        waves = self._waves(mirrored)
        projected = self._reduced.project(waves.loads)
        coordinates = self._reduced.solve(mirrored, projected)
        motions = waves.without_radiation(projected @ coordinates.T)
        return _Reduced(
            motions=motions, loads=motions.unknowns @ waves.loads, coordinates=motions.unknowns @ coordinates
        )


def damped_resonances(
    solver: DampedSolver, region: Region, shallowest: float, known: list[complex], spacing: float
) -> list[complex]:
    """Resonances of a region on the basis, rad/s, by ascending |ω| (collective)."""
    unit = solver.model.basin.units.frequency
    found: list[complex] = []
    for start in (*known, *_starts(region, shallowest, spacing)):
        root = solver.root(solver.model.squared_frequency(start))
        if root is None:
            continue
        omega = complex(np.sqrt(root.squared)) * unit
        if region.holds(omega) and all(abs(omega - other) > _SAME * abs(omega) for other in found):
            found.append(omega)
    return sorted(found, key=abs)


def _starts(region: Region, shallowest: float, spacing: float) -> list[complex]:
    angles = np.arange(atan(shallowest), atan(region.damping) + spacing, spacing)
    highest = region.highest * np.sqrt(1.0 + region.damping**2)
    sizes = np.exp(np.arange(np.log(region.lowest), np.log(highest), spacing))
    points = (complex(size * np.exp(-1j * angle)) for size in sizes for angle in angles)
    return [point for point in points if region.lowest <= point.real <= region.highest]
