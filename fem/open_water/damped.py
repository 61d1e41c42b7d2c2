"""Strongly damped resonances, whose outgoing waves grow faster with the distance than complex scaling can follow.

Their conjugate grows as e^{−iω̄t}, and waves only come in. At λ̄, above the axis, the outgoing waves of T = A − λ̄M
decay with the distance, the faster the further from the axis, and coordinates are turned by a small angle only. With
amplitudes b of an even and an odd wave φ, each of which comes from both sides and leaves to both,

    ψ = T⁻¹(Fa − gb) + Σ bφ

sends no wave away if Xa + Wb = 0, with

    X = ∫ρφφᵢ + Fᵀφ_D,    W = gᵀT⁻¹g − ∫ρφ ∂φ'/∂n ∓ 2ikN,    φ_D = −T⁻¹g,

−2ikN for the even one: W is the scattering of bodies that are held, in the fluxes I(φ) of `incident_waves`. Then the
conjugate of

    FᵀT⁻¹F − Xᵀ W⁻¹ X

is H(λ) of outgoing waves, continued from the axis. The error that elements make in it is the energy that T⁻¹(Fa − gb)
lacks, for it is stationary. On a thin float XᵀW⁻¹X is the term −2πi R(−z²)² of `docs/theory_open_water.md`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, pi

import numpy as np
from scipy.linalg import eig

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.incident_waves import Standing, surface_integrals
from hydroelastic.fem.open_water.reduced_pencil import ReducedPencil
from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.resonance_search import Eigenpair
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.modal.liquid.endless_wave import EndlessWave

# Newton's method: its last step and the number of steps on one basis, and how often a solution is added to that.
_STEP = 1e-11
_MOST_STEPS = 20
_MOST_SOLUTIONS = 8
# Of ω: the difference quotient of an analytic matrix errs by its square.
_DIFFERENCE = 1e-4
# Of |λ|, from where Newton's method begins.
_FARTHEST = 0.25
# The same resonance from two starts.
_SAME = 1e-6
# Of the largest excitation; a mesh that is not symmetric excites this little.
_UNFELT = 1e-3


def mirror_angle(damping: float) -> float:
    """α of the complex scaling with which waves decay equally fast on the axis and where −Im ω/Re ω is ``damping``."""
    return 0.5 * pi - atan(damping)


@dataclass(frozen=True, kw_only=True)
class Root:
    """A resonance on the reduced basis.

    Attributes:
        squared: λ.
        bodies: a.
        norm: aᵀ D'(λ) a.
        step: the last one of Newton's method, relative.
    """

    squared: complex
    bodies: np.ndarray
    norm: complex
    step: float


@dataclass(frozen=True, kw_only=True)
class _Waves:
    """The waves φ at λ̄: loads L = (F, −g), ∫ρφφᵢ, and W without what the elements add to it."""

    loads: np.ndarray
    pressures: np.ndarray
    scattering: np.ndarray

    def without_leaving(self, responses: np.ndarray) -> _Motions:
        """Motions beside which no wave leaves.

        Args:
            responses: LᵀT⁻¹L.
        """
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
    """Motions at λ̄ beside which no wave leaves: H, (a, b) of a unit of each, shape (body unknowns, …), X, and W."""

    hydrodynamic: np.ndarray
    unknowns: np.ndarray
    excitation: np.ndarray
    scattering: np.ndarray


@dataclass(frozen=True, kw_only=True)
class _Reduced:
    """The same on the basis.

    Attributes:
        motions: them.
        loads: Fa − gb of a unit of each, shape (body unknowns, own free unknowns).
        coordinates: of T⁻¹(Fa − gb), shape (body unknowns, basis).
    """

    motions: _Motions
    loads: np.ndarray
    coordinates: np.ndarray


class DampedSolver:
    """H of one model in endless liquids, on a reduced basis.

    Args:
        model: the problem, with coordinates turned by `mirror_angle`.
        watch: records the time by stage.
    """

    def __init__(self, model: OpenModel, watch: Stopwatch) -> None:
        """Prepare (collective)."""
        self.model = model
        self._watch = watch
        with watch.stage("solve"):
            self._direct: ShiftedSolver = model.pencil.solver()
        self._reduced = ReducedPencil(model.pencil)
        # Whether the motions of bodies excite even and odd waves, at the frequencies that were judged.
        self._felt = np.zeros(2, dtype=bool)

    @property
    def basis_size(self) -> int:
        """Vectors of the reduced basis."""
        return self._reduced.size

    def wavenumber(self, omega: complex) -> complex:
        """k of the waves at ω in rad/s, in units of the basin."""
        return EndlessWave(
            layers=self.model.basin.scaled_layers, squared=self.model.squared_frequency(omega)
        ).wavenumber

    def radiation(self, squared: complex) -> None:
        """Take the solutions at λ into the basis (collective)."""
        mirrored = squared.conjugate()
        waves = self._waves(mirrored)
        with self._watch.stage("solve"):
            self._direct.shift(mirrored)
            solutions = np.array([self._direct.solve(load) for load in waves.loads])
        with self._watch.stage("reduce"):
            unknowns = waves.without_leaving(self.model.pencil.products(waves.loads, solutions)).unknowns
            self._reduced.add(mirrored, unknowns @ solutions, unknowns @ waves.loads)

    def hydrodynamics(self, squares: np.ndarray) -> np.ndarray:
        """H at many λ on the basis, shape (λ, body unknowns, body unknowns) (collective)."""
        return np.array([self._mirrored(square.conjugate()).motions.hydrodynamic.conj() for square in squares])

    def continued(self, squares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The same, and det W over its magnitude, which vanishes where H has poles (collective).

        Waves that no motion feels, as a body with a symmetry has them, are left out.
        """
        found = [self._mirrored(square.conjugate()).motions for square in squares]
        water = [np.linalg.slogdet(one.scattering[np.ix_(self._felt, self._felt)])[0] for one in found]
        return np.array([one.hydrodynamic.conj() for one in found]), np.array(water).conj()

    def hydrodynamic(self, squared: complex) -> tuple[np.ndarray, float]:
        """H at λ on the basis, and the largest relative residual of its motions (collective)."""
        found = self._mirrored(squared.conjugate())
        sizes = np.abs(found.motions.excitation).max(axis=1)
        self._felt |= sizes > _UNFELT * sizes.max()
        with self._watch.stage("reduce"):
            misfits = self._reduced.misfits(squared.conjugate(), found.loads, found.coordinates)
        # Far from the axis hardly anything of H is left to the elements.
        whole = np.abs(np.diag(self.model.mass + found.motions.hydrodynamic))
        return found.motions.hydrodynamic.conj(), float((misfits / np.sqrt(whole)).max())

    def root(self, start: complex) -> Root | None:
        """The resonance next to a λ by Newton's method on the basis; ``None`` if that leads away (collective)."""
        squared = start
        for _ in range(_MOST_STEPS):
            own, *around = self.hydrodynamics(squared * np.array([1.0, 1.0 - _DIFFERENCE, 1.0 + _DIFFERENCE]))
            inertia = self.model.mass + own
            slope = inertia + (around[1] - around[0]) / (2.0 * _DIFFERENCE)
            steps, vectors = eig(self.model.stiffness - squared * inertia, slope)
            nearest = int(np.argmin(np.where(np.isfinite(steps), np.abs(steps), np.inf)))
            # Rounding of one process must not lead it elsewhere than the others.
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
        """The resonance next to a λ; its potential is what the elements hold of it, without the waves φ (collective).

        Raises:
            EigenSolverError: if Newton's method does not converge.
        """
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
        with self._watch.stage("waves"):
            wave = EndlessWave(layers=self.model.basin.scaled_layers, squared=mirrored)
            standing = [Standing(wave=wave, odd=odd) for odd in (False, True)]
            fluxes, pressures, own = surface_integrals(self.model, standing)
        power = wave.wavenumber * wave.energy
        return _Waves(
            loads=np.vstack([self.model.pencil.loads, -fluxes]),
            pressures=pressures,
            scattering=np.diag([-2j * power, 2j * power]) - own,
        )

    def _mirrored(self, mirrored: complex) -> _Reduced:
        waves = self._waves(mirrored)
        with self._watch.stage("reduce"):
            projected = self._reduced.project(waves.loads)
            coordinates = self._reduced.solve(mirrored, projected)
        motions = waves.without_leaving(projected @ coordinates.T)
        return _Reduced(
            motions=motions, loads=motions.unknowns @ waves.loads, coordinates=motions.unknowns @ coordinates
        )


def damped_resonances(
    solver: DampedSolver, region: Region, shallowest: float, known: list[complex], spacing: float
) -> list[complex]:
    """Resonances of a region on the basis, rad/s, by ascending |ω| (collective).

    Args:
        solver: with a basis that is good enough there.
        region: where.
        shallowest: −Im ω/Re ω above which all of it is searched.
        known: ω in rad/s of those that are known roughly.
        spacing: distance in ln ω of the points at which Newton's method begins.
    """
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
    """Points all over the damped part of a region, rad/s."""
    angles = np.arange(atan(shallowest), atan(region.damping) + spacing, spacing)
    highest = region.highest * np.sqrt(1.0 + region.damping**2)
    sizes = np.exp(np.arange(np.log(region.lowest), np.log(highest), spacing))
    points = (complex(size * np.exp(-1j * angle)) for size in sizes for angle in angles)
    return [point for point in points if region.lowest <= point.real <= region.highest]
