"""Solutions of a field model at any frequency: in full by a factorization, or on a reduced basis of such solutions."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigvals

from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenFrequency, OpenResponse
from hydroelastic.fem.open_water.incident_waves import Incidence, incidence, incident_waves
from hydroelastic.fem.open_water.reduced_pencil import ReducedPencil
from hydroelastic.fem.stopwatch import Stopwatch


class OpenSolver:
    """Solves one model; frequencies ω in rad/s.

    Args:
        model: the problem.
        watch: records the time by stage.
    """

    def __init__(self, model: OpenModel, watch: Stopwatch) -> None:
        """Prepare (collective)."""
        self.model = model
        self._watch = watch
        with watch.stage("solve"):
            self._direct: ShiftedSolver = model.pencil.solver()
        self._reduced = ReducedPencil(model.pencil)
        self._loads = model.pencil.loads.astype(complex)
        self._projected = np.zeros((len(self._loads), 0), dtype=complex)
        # A sweep evaluates a frequency several times.
        self._waves: dict[float, Incidence] = {}

    @property
    def factorizations(self) -> int:
        """Number of factorizations."""
        return self._direct.factorizations

    @property
    def basis_size(self) -> int:
        """Number of vectors of the reduced basis."""
        return self._reduced.size

    def incidence(self, omega: float) -> Incidence:
        """Return the travelling waves at ω in rad/s (collective)."""
        if omega not in self._waves:
            with self._watch.stage("waves"):
                basin = self.model.basin
                scaled = omega / basin.units.frequency
                self._waves[omega] = incidence(self.model, incident_waves(basin.waves(scaled), basin.tank.geometry))
        return self._waves[omega]

    def radiation(self, squared: complex) -> np.ndarray:
        """Return ψ radiated by a unit of each body unknown at λ, shape (body unknowns, free unknowns), by a
        factorization; the solutions extend the basis (collective)."""
        with self._watch.stage("solve"):
            self._direct.shift(squared)
            radiated = self._solved(self._loads)
        with self._watch.stage("reduce"):
            self._reduced.add(squared, radiated, self._loads)
        return radiated

    def hydrodynamics(self, squares: np.ndarray) -> np.ndarray:
        """H at many λ on the basis, shape (λ, body unknowns, body unknowns) (collective)."""
        with self._watch.stage("reduce"):
            projected = self._projected_loads()
            return np.array([projected @ self._reduced.solve(square, projected).T for square in squares])

    def hydrodynamic(self, squared: complex) -> tuple[np.ndarray, float]:
        """Return H at λ on the basis, shape (body unknowns, body unknowns), and a relative residual (collective).

        The residual is that of one combination of all motions.
        """
        with self._watch.stage("reduce"):
            projected = self._projected_loads()
            coordinates = self._reduced.solve(squared, projected)
            # Factors without simple ratios, so that no parts cancel by symmetry.
            parts = np.cos(1.0 + np.arange(len(projected)))[None]
            residual = self._reduced.residuals(squared, parts @ self._loads, parts @ coordinates)[0]
            return projected @ coordinates.T, float(residual)

    def frequency(self, omega: float) -> OpenFrequency:
        """Return radiation and diffraction at ω in rad/s by a factorization; the solutions extend the basis
        (collective)."""
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        radiated = self.radiation(squared)
        with self._watch.stage("solve"):
            diffracted = self._solved(-waves.fluxes)
        with self._watch.stage("reduce"):
            self._reduced.add(squared, diffracted, -waves.fluxes)
        return self._frequency(squared, waves, radiated, diffracted)

    def frequency_between(self, omega: float) -> tuple[OpenFrequency, float]:
        """The same on the basis, and its largest relative residual (collective)."""
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        with self._watch.stage("reduce"):
            loads = np.vstack([self._loads, -waves.fluxes])
            projected = np.vstack([self._projected_loads(), -self._reduced.project(waves.fluxes)])
            coordinates = self._reduced.solve(squared, projected)
            residual = self._reduced.residuals(squared, loads, coordinates).max()
            potentials = self._reduced.potentials(coordinates)
        count = len(self._loads)
        return self._frequency(squared, waves, potentials[:count], potentials[count:]), float(residual)

    def _frequency(
        self, squared: complex, waves: Incidence, radiated: np.ndarray, diffracted: np.ndarray
    ) -> OpenFrequency:
        return OpenFrequency(
            model=self.model,
            squared=squared,
            incidence=waves,
            radiated=radiated,
            diffracted=diffracted,
            hydrodynamic=self.model.pencil.products(self._loads, radiated),
        )

    def response(self, omega: float, incident: list[int]) -> OpenResponse:
        """Return the response of free bodies by a factorization; the scattered waves extend the basis (collective).

        Args:
            omega: ω, rad/s.
            incident: indices of the incident waves, see `Incidence`.
        """
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        with self._watch.stage("solve"):
            self._direct.shift(squared)
            radiated, diffracted = self._solved(self._loads), self._solved(-waves.fluxes)
        products = self.model.pencil.products
        dynamic = self.model.stiffness - squared * (self.model.mass + products(self._loads, radiated))
        forces = squared * (waves.pressures + products(diffracted, self._loads))
        motions = np.linalg.solve(dynamic, forces.T).T
        scattered = diffracted + motions @ radiated
        with self._watch.stage("reduce"):
            # Waves from the other side are the dual problem of amplitudes: with them these are of second order.
            self._reduced.add(squared, scattered, motions @ self._loads - waves.fluxes)
        return self._response(squared, waves, incident, scattered[incident], motions[incident])

    def response_between(self, omega: float, incident: list[int]) -> tuple[OpenResponse, float]:
        """The same on the basis, and its largest relative residual (collective).

        The bodies keep all their unknowns: (VᵀAV − λVᵀMV) y − VᵀF a = −Vᵀg, −λFᵀV y + (K − λM_b) a = λ∫ρφφᵢ.
        """
        squared = self.model.squared_frequency(omega)
        waves = self.incidence(omega)
        with self._watch.stage("reduce"):
            operator = self._coupled(squared)
            loads = -waves.fluxes[incident]
            right = np.hstack([self._reduced.project(loads), squared * waves.pressures[incident]])
            unknowns = np.linalg.solve(operator, right.T).T
            coordinates, motions = unknowns[:, : self.basis_size], unknowns[:, self.basis_size :]
            residual = self._reduced.residuals(squared, loads + motions @ self._loads, coordinates).max()
            scattered = self._reduced.potentials(coordinates)
        return self._response(squared, waves, incident, scattered, motions), float(residual)

    def resonances_between(self) -> np.ndarray:
        """Return ω of bodies and liquid on the basis, rad/s, Re ω ≥ 0, with those of the continuous spectrum
        (collective)."""
        with self._watch.stage("reduce"):
            stiffness = self._coupled(0.0)
            squares = eigvals(stiffness, stiffness - self._coupled(1.0))
            omegas = np.sqrt(squares[np.isfinite(squares)]) * self.model.basin.units.frequency
        # All processes must take the same branch in spite of rounding.
        found: np.ndarray = self.model.pencil.comm.bcast(omegas)
        return found

    def _coupled(self, squared: complex) -> np.ndarray:
        """The operator of bodies and liquid on the basis, linear in λ (collective)."""
        coupling = self._projected_loads()
        return np.block(
            [
                [self._reduced.operator(squared), -coupling.T],
                [-squared * coupling, self.model.stiffness - squared * self.model.mass],
            ]
        )

    def _response(
        self, squared: complex, waves: Incidence, incident: list[int], scattered: np.ndarray, motions: np.ndarray
    ) -> OpenResponse:
        return OpenResponse(
            model=self.model,
            squared=squared,
            incidence=waves,
            incident=incident,
            scattered=scattered,
            motions=motions,
        )

    def _projected_loads(self) -> np.ndarray:
        """VᵀF, for the basis as it is (collective)."""
        if self._projected.shape[1] != self._reduced.size:
            self._projected = self._reduced.project(self._loads)
        return self._projected

    def _solved(self, loads: np.ndarray) -> np.ndarray:
        return np.array([self._direct.solve(load) for load in loads]).reshape(loads.shape)
