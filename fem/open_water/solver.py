"""Solutions of a field model at any frequency: in full by a factorization, or on a reduced basis of such solutions."""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.linalg import eig

from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import BodyEquations, OpenFrequency, OpenResponse
from hydroelastic.fem.open_water.incident_waves import Incidence, incidence, incident_waves
from hydroelastic.fem.open_water.model_building import open_model
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.reduced_pencil import LoadProducts, ReducedPencil
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.attachments import REGULAR


def shared_solver(problem: OpenWaterProblem, band: Band, resolution: Resolution) -> OpenSolver:
    """Return the solver of a band and a resolution, with its basis: that of the last analysis if it is the same
    (collective)."""
    order = problem.tank.geometry.order
    known: tuple[tuple[Band, Resolution], OpenSolver] | None = problem.solvers.get(order)
    if known is None or known[0] != (band, resolution):
        problem.solvers.pop(order, None)
        model = open_model(problem, band, resolution)
        known = (band, resolution), OpenSolver(model)
        problem.solvers[order] = known
    return known[1]


class OpenSolver:
    """Solves one model; frequencies ω in rad/s.

    Args:

    Attributes:
        model: the problem.
        elevation: amplitude of regular waves, m, on which the damping by drag depends; 0 for none.
        damping: further damping of the body unknowns, in place of drag in irregular waves, dimensionless.
    """

    def __init__(self, model: OpenModel) -> None:
        """Prepare (collective)."""
        self.model = model
        self.elevation, self.damping = 0.0, np.zeros_like(model.mass)
        self._direct: ShiftedSolver = model.pencil.solver()
        self._reduced = ReducedPencil(model.pencil)
        self._loads = model.pencil.loads.astype(complex)
        self._sampled = np.zeros((0, self._loads.shape[1]))
        self._known = self._reduced.load_products(self._loads[:, model.pencil.wet])
        # A sweep evaluates a frequency several times, and so do several analyses.
        self._waves: dict[float, Incidence] = {}
        self._solutions: dict[float, tuple[np.ndarray, np.ndarray]] = {}

    @property
    def factorizations(self) -> int:
        """Number of factorizations."""
        return self._direct.factorizations

    @property
    def basis_size(self) -> int:
        """Number of vectors of the reduced basis."""
        return self._reduced.size

    def sample(self, rows: np.ndarray) -> None:
        """Let ψ on the basis be as accurate as forces are at some places, by the dual problem of each."""
        self._sampled = rows
        self._solutions.clear()

    def incidence(self, omega: float) -> Incidence:
        """Return the travelling waves at ω in rad/s (collective)."""
        if omega not in self._waves:
            basin = self.model.basin
            scaled = omega / basin.units.frequency
            self._waves[omega] = incidence(self.model, incident_waves(basin.waves(scaled), basin.tank.geometry))
        return self._waves[omega]

    def radiation(self, squared: complex) -> np.ndarray:
        """Return ψ radiated by a unit of each body unknown at λ, shape (body unknowns, free unknowns), by a
        factorization; the solutions extend the basis (collective)."""
        self._direct.shift(squared)
        radiated = self._solved(self._loads)
        self._reduced.add(squared, radiated, self._loads)
        return radiated

    def hydrodynamics(self, squares: np.ndarray) -> np.ndarray:
        """H at many λ on the basis, shape (λ, body unknowns, body unknowns) (collective)."""
        projected = self._known_loads().projected
        found = [projected @ self._reduced.solve(square, projected).T for square in squares]
        return np.array(found).reshape(len(found), len(projected), len(projected))

    def hydrodynamic(self, squared: complex) -> tuple[np.ndarray, float]:
        """Return H at λ on the basis, shape (body unknowns, body unknowns), and a relative residual (collective).

        The residual is that of one combination of all motions.
        """
        known = self._known_loads()
        coordinates = self._reduced.solve(squared, known.projected)
        # Factors without simple ratios, so that no parts cancel by symmetry.
        parts = np.cos(1.0 + np.arange(len(coordinates)))[None]
        residual = self._reduced.residuals(squared, known, parts, parts @ coordinates)[0]
        return known.projected @ coordinates.T, float(residual)

    def frequency(self, omega: float) -> OpenFrequency:
        """Return radiation and diffraction at ω in rad/s by a factorization; the solutions extend the basis
        (collective)."""
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        radiated, diffracted = self._at(omega)
        if self.model.basin.tank.elastic:
            self._reduced.add(squared, np.vstack([radiated, diffracted]), np.vstack([self._loads, -waves.fluxes]))
        products = self.model.pencil.products
        return OpenFrequency(
            model=self.model,
            squared=squared,
            incidence=waves,
            hydrodynamic=products(self._loads, radiated),
            diffraction=products(diffracted, self._loads),
            potentials=lambda: (radiated, diffracted),
        )

    def _at(self, omega: float) -> tuple[np.ndarray, np.ndarray]:
        """Return radiated and diffracted ψ at ω in rad/s by a factorization (collective).

        Of rigid bodies they extend the basis. Beams have many shapes: their basis is extended by sums of them.
        """
        if omega not in self._solutions:
            squared, waves = self.model.squared_frequency(omega), self.incidence(omega)
            self._direct.shift(squared)
            found = self._solved(self._loads), self._solved(-waves.fluxes)
            dual = self._solved(self._sampled.astype(complex))
            if not self.model.basin.tank.elastic:
                self._reduced.add(squared, np.vstack(found), np.vstack([self._loads, -waves.fluxes]))
            if len(dual):
                self._reduced.add(squared, dual, self._sampled)
            self._solutions[omega] = found
        return self._solutions[omega]

    def frequency_between(self, omega: float) -> tuple[OpenFrequency, float]:
        """The same on the basis, and its largest relative residual (collective)."""
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        known, count = self._with_waves(waves), len(self._loads)
        found = self._reduced.solve(squared, known.projected)
        residual = self._reduced.residuals(squared, known, np.eye(len(found)), found).max()
        lift = self._reduced.lift()
        coupling = known.projected[:count]
        return OpenFrequency(
            model=self.model,
            squared=squared,
            incidence=waves,
            hydrodynamic=coupling @ found[:count].T,
            diffraction=found[count:] @ coupling.T,
            potentials=lambda: (lift(found[:count]), lift(found[count:])),
        ), float(residual)

    def response(self, omega: float, incident: list[int]) -> OpenResponse:
        """Return the response of free bodies by a factorization; the scattered waves extend the basis (collective)."""
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        radiated, diffracted = self._at(omega)
        products = self.model.pencil.products
        equations = self._equations(
            squared,
            waves,
            products(self._loads, radiated),
            products(diffracted, self._loads),
            (products(waves.fluxes, radiated), products(waves.fluxes, diffracted)),
        )
        motions, dampings = self._motions(squared, waves, equations)
        scattered = diffracted + motions @ radiated
        if self.model.basin.tank.elastic:
            # Waves from the other side are the dual problem of amplitudes: with them these are of second order.
            self._reduced.add(squared, scattered, motions @ self._loads - waves.fluxes)
        return OpenResponse(
            model=self.model,
            squared=squared,
            incidence=waves,
            incident=incident,
            fluxes=products(waves.fluxes, scattered[incident]),
            potentials=lambda parts, moved: parts @ diffracted + moved @ radiated,
            motions=motions[incident],
            equations=equations,
            damping=dampings[incident],
        )

    def response_between(self, omega: float, incident: list[int]) -> tuple[OpenResponse, float]:
        """The same on the basis, and its largest relative residual (collective).

        The bodies keep all their unknowns.
        """
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        known, count = self._with_waves(waves), len(self._loads)
        found = self._reduced.solve(squared, known.projected)
        radiated, diffracted, coupling = found[:count], found[count:], known.projected[:count]
        fluxes = -known.projected[count:]
        equations = self._equations(
            squared,
            waves,
            coupling @ radiated.T,
            diffracted @ coupling.T,
            (fluxes @ radiated.T, fluxes @ diffracted.T),
        )
        motions, dampings = (part[incident] for part in self._motions(squared, waves, equations))
        coordinates = diffracted[incident] + motions @ radiated
        parts = np.hstack([motions, np.eye(len(diffracted))[incident]])
        residual = self._reduced.residuals(squared, known, parts, coordinates).max()
        lift = self._reduced.lift()
        return OpenResponse(
            model=self.model,
            squared=squared,
            incidence=waves,
            incident=incident,
            fluxes=fluxes @ coordinates.T,
            potentials=lambda parts, moved: lift(parts @ diffracted + moved @ radiated),
            motions=motions,
            equations=equations,
            damping=dampings,
        ), float(residual)

    def _equations(
        self,
        squared: complex,
        waves: Incidence,
        hydrodynamic: np.ndarray,
        diffraction: np.ndarray,
        fluxes: tuple[np.ndarray, np.ndarray],
    ) -> BodyEquations:
        """Return the equations of motion from H, Fᵀφ_D, and gᵀψ of radiation and diffraction."""
        return BodyEquations(
            dynamic=self.model.restoring(squared) - squared * (self.model.mass + hydrodynamic),
            forces=squared * (waves.pressures + diffraction),
            radiated=fluxes[0],
            diffracted=fluxes[1],
        )

    def _motions(self, squared: complex, waves: Incidence, equations: BodyEquations) -> tuple[np.ndarray, np.ndarray]:
        """Return the motions in each wave, shape (waves, body unknowns), and the damping beyond that of the equations,
        shape (waves, body unknowns, body unknowns)."""
        outside, omega = self.model.outside, float(np.sqrt(squared).real)
        dynamic, forces = equations.dynamic - 1j * omega * self.damping, equations.forces
        motions: np.ndarray = np.linalg.solve(dynamic, forces.T).T
        dampings = np.repeat(self.damping[None], len(motions), axis=0)
        if self.elevation:
            # Drag depends on the height of the wave: each has a damping of its own.
            heights = waves.heights(self.model.basin, self.elevation)
            for place, (height, force) in enumerate(zip(heights, forces, strict=True)):
                speeds = partial(_speeds, outside.paths, omega, dynamic, height * force)
                damping = outside.equivalent_damping(speeds, REGULAR)
                motions[place] = _moved(omega, dynamic, force, damping)
                dampings[place] += damping
        return motions, dampings

    def resonances_between(self) -> np.ndarray:
        """Return ω of bodies and liquid on the basis, rad/s, Re ω ≥ 0, with those of the continuous spectrum
        (collective)."""
        return self.free_motions()[0]

    def free_motions(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the same with the coordinates of ψ and the body unknowns of each, shape (motions, basis + body
        unknowns) (collective)."""
        stiffness = self._coupled(0.0)
        size, own = len(stiffness), self._reduced.size
        damping = np.zeros_like(stiffness)
        damping[own:, own:] = 1j * self.model.outside.damping
        mass = stiffness - self._coupled(1.0) - damping
        if damping.any():
            # (S − ωC − ω²M) x = 0 in (x, ωx).
            zero, one = np.zeros_like(stiffness), np.eye(size)
            left, right = np.block([[zero, one], [stiffness, -damping]]), np.block([[one, zero], [zero, mass]])
            omegas, vectors = eig(left, right)
        else:
            squares, vectors = eig(stiffness, mass)
            omegas = np.sqrt(squares)
        chosen = np.isfinite(omegas) & (omegas.real >= 0.0)
        found = omegas[chosen] * self.model.basin.units.frequency, vectors[:size, chosen].T
        # All processes must take the same branch in spite of rounding.
        motions: tuple[np.ndarray, np.ndarray] = self.model.pencil.comm.bcast(found)
        return motions

    def zeros_and_poles(self) -> tuple[np.ndarray, np.ndarray]:
        """Return ω of `free_motions`, where det D is zero, and of `water_resonances`, where it has poles, rad/s
        (collective)."""
        squares = self.water_resonances()[0]
        return self.free_motions()[0], np.sqrt(squares[np.isfinite(squares)]) * self.model.basin.units.frequency

    def lifted(self, coordinates: np.ndarray) -> np.ndarray:
        """Return ψ of coordinates on the basis, shape (basis,): shape (own free unknowns,)."""
        return self._reduced.potentials(coordinates)

    def water_resonances(self) -> tuple[np.ndarray, np.ndarray]:
        """Return λⱼ at which the water oscillates about fixed bodies, shape (basis,), and R of H = Σ R/(λⱼ − λ), shape
        (basis, body unknowns, body unknowns), on the basis; with those of the continuous spectrum (collective)."""
        laplace = self._reduced.operator(0.0)
        mass = laplace - self._reduced.operator(1.0)
        squares, vectors = eig(laplace, mass)
        forces = self._known_loads().projected @ vectors
        residues = np.einsum("ij,kj,j->jik", forces, forces, 1.0 / np.einsum("ij,ik,kj->j", vectors, mass, vectors))
        # All processes must take the same branch in spite of rounding.
        found: tuple[np.ndarray, np.ndarray] = self.model.pencil.comm.bcast((squares, residues))
        return found

    def _coupled(self, squared: complex) -> np.ndarray:
        """The operator of bodies and liquid on the basis, linear in λ (collective)."""
        coupling = self._known_loads().projected
        return np.block(
            [
                [self._reduced.operator(squared), -coupling.T],
                [-squared * coupling, self.model.restoring(squared) - squared * self.model.mass],
            ]
        )

    def _known_loads(self) -> LoadProducts:
        """Products of F, for the basis as it is (collective)."""
        if self._known.projected.shape[1] != self._reduced.size:
            self._known = self._reduced.load_products(self._loads[:, self.model.pencil.wet])
        return self._known

    def _with_waves(self, waves: Incidence) -> LoadProducts:
        """Products of F and of −g, for the basis as it is (collective)."""
        return self._reduced.load_products(-waves.fluxes[:, self.model.pencil.wet], self._known_loads())

    def _solved(self, loads: np.ndarray) -> np.ndarray:
        return np.array([self._direct.solve(load) for load in loads]).reshape(loads.shape)


def _moved(omega: float, dynamic: np.ndarray, force: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Motions by a force with further damping, shape (body unknowns,)."""
    motions: np.ndarray = np.linalg.solve(dynamic - 1j * omega * damping, force)
    return motions


def _speeds(paths: np.ndarray, omega: float, dynamic: np.ndarray, force: np.ndarray, damping: np.ndarray) -> np.ndarray:
    speeds: np.ndarray = omega * np.abs(paths @ _moved(omega, dynamic, force, damping))
    return speeds
