"""Motions of bodies in waves over time: Cummins' equation.

    (M + a∞) ξ″ + B ξ′ + Σ pᵢ βᵢ |pᵢᵀξ′| pᵢᵀξ′ + ∫₀ᵗ K(t − u) ξ′(u) du + C ξ = r(t) Re Σ fₙ e^{−iωₙt}

from rest at t = 0, in equilibrium or displaced from it, with the stiffness C of hydrostatics and of forces from
outside, their damping B and drags β along paths p, and a ramp r of the waves (W. E. Cummins 1962). The convolution is
the sum of the exponentials of `RadiationMemory`, whose states z′ = pz + ξ′ make the equation one of first order, which
SciPy's DOP853 integrates. Exponentials far quicker than all else are only a damping and a mass: ∫ e^{pu} ξ′(t − u) du =
−ξ′/p − ξ″/p² …
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import block_array, block_diag, csr_array

from hydroelastic.fem.time_domain.radiation_memory import Complexes, Floats, RadiationMemory
from hydroelastic.physics.attachments import IRREGULAR, REGULAR, OutsideForces

# Rates over the highest frequency of waves and bodies beyond which an exponential has no state: what is neglected of it
# is of the third order in the inverse.
_QUICK = 30.0
# Multiple of the motion in the same waves without a beginning beyond which one grows without bound.
_UNBOUNDED = 1e6


class UnsolvedMotionError(RuntimeError):
    """The motion grows without bound, or its equation cannot be integrated."""


@dataclass(frozen=True, kw_only=True)
class WaveForces:
    """Forces of waves on m motions, r(t) Re Σ fₙ e^{−iωₙt}."""

    omega: Floats  # ω of the waves, rad/s, shape (n,)
    forces: Complexes  # f, with amplitudes and phases of the waves, shape (n, m)
    ramp: float = 0.0  # time in which the waves grow to their height, s: r = (1 − cos(πt/ramp))/2 until then

    def grown(self, times: Floats) -> Floats:
        """r at times, shape (n,)."""
        part = np.minimum(times / self.ramp, 1.0) if self.ramp else np.ones_like(times)
        grown: Floats = 0.5 - 0.5 * np.cos(np.pi * part)
        return grown

    def at(self, time: float) -> Floats:
        """The forces at a time, shape (m,)."""
        grown = self.grown(np.array([time]))[0]
        force: Floats = grown * (np.exp(-1j * self.omega * time) @ self.forces).real
        return force


@dataclass(frozen=True, kw_only=True)
class MovingBodies:
    """The equation of m motions, SI units."""

    memory: RadiationMemory  # added mass at infinite frequency and impulse responses
    inertia: Floats  # M, shape (m, m)
    stiffness: Floats  # of hydrostatics and of the bodies, shape (m, m)
    outside: OutsideForces  # springs, dampers and drags from outside

    def steady(self, waves: WaveForces) -> Complexes:
        """Amplitudes of the motions in waves without a beginning, with the linear damping that takes the same power as
        the drags in one wave, or in many of random phases, shape (n, m)."""
        return _moved(self._impedance(waves), waves.forces)

    def errors(self, waves: WaveForces, error: float) -> Floats:
        """Return estimated errors of the motions, shape (m,).

        With Z ξ = f an error of the hydrodynamics leaves |Z⁻¹| (|δf| + ω² |δH| |ξ|): near a resonance it grows as the
        motion does.
        """
        impedance = self._impedance(waves)
        radiated = self.memory.infinite_frequency_added_mass + 1j * (
            self.memory.transform(waves.omega) / waves.omega[:, None, None]
        )
        roots = np.sqrt(np.abs(np.einsum("nii->ni", radiated)))
        added = (waves.omega**2 * (roots * np.abs(_moved(impedance, waves.forces))).sum(axis=1))[:, None] * roots
        loads = error * (np.abs(waves.forces) + added)
        total: Floats = (np.abs(np.linalg.inv(impedance)) @ loads[..., None])[..., 0].sum(axis=0)
        return total

    def _impedance(self, waves: WaveForces) -> Complexes:
        """Forces by motions at the frequencies of waves, with the linear damping in place of the drags, shape
        (n, m, m)."""
        omega, paths = waves.omega[:, None, None], self.outside.paths
        without_drag = np.asarray(
            self.stiffness
            - omega**2 * (self.inertia + self.memory.infinite_frequency_added_mass)
            - 1j * omega * self.memory.transform(waves.omega)
            + np.array([self.outside.impedance(one) for one in waves.omega]).reshape(-1, *self.inertia.shape),
            dtype=complex,
        )
        if not len(self.outside.drag):
            return without_drag
        is_regular = len(waves.omega) == 1

        def speeds(damping: Floats) -> Floats:
            along = np.abs(waves.omega[:, None] * (_moved(without_drag - 1j * omega * damping, waves.forces) @ paths.T))
            return along[0] if is_regular else np.sqrt(0.5 * (along**2).sum(axis=0))

        damping = self.outside.equivalent_damping(speeds, REGULAR if is_regular else IRREGULAR)
        return without_drag - 1j * omega * damping

    def motion(
        self, waves: WaveForces, times: Floats, tolerance: float, initial: Floats | None = None
    ) -> tuple[Floats, Floats]:
        """Integrate from rest at t = 0, the water at rest too."""
        matrix, inverse = self._system(self._highest(waves))
        count = len(self.inertia)
        velocity, drag = slice(count, 2 * count), self.outside.drag

        def rates(time: float, state: Floats) -> Floats:
            speeds = self.outside.paths @ state[velocity]
            change: Floats = matrix @ state
            change[velocity] += inverse @ (waves.at(time) - self.outside.paths.T @ (drag * np.abs(speeds) * speeds))
            return change

        start = np.zeros(matrix.shape[0])
        if initial is not None:
            start[:count] = initial
        size = np.abs(self.steady(waves)).sum(axis=0) + np.abs(start[:count]).max() + np.finfo(float).tiny
        # States far below the motions need no digits of their own.
        scale = np.concatenate([size, size * self._highest(waves), np.full(matrix.shape[0] - 2 * count, size.max())])

        def bounded(_time: float, state: Floats) -> float:
            return float(_UNBOUNDED - np.abs(state[:count] / size).max())

        bounded.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(
            rates,
            (0.0, float(times[-1])) if times[-1] > 0.0 else (0.0, 1.0),
            start,
            method="DOP853",
            t_eval=times,
            rtol=max(tolerance, 1e-12),
            atol=tolerance * scale,
            events=bounded,
        )
        if found.status != 0:
            raise UnsolvedMotionError(found.message)
        return found.y[:count].T, found.y[velocity].T

    def _highest(self, waves: WaveForces) -> float:
        mass = self.inertia + self.memory.infinite_frequency_added_mass
        stiffness = self.stiffness + self.outside.stiffness
        natural = np.sqrt(np.abs(np.linalg.eigvals(np.linalg.solve(mass, stiffness))).max())
        return max(float(waves.omega.max(initial=0.0)), float(natural))

    def _system(self, highest: float) -> tuple[csr_array, Floats]:
        """The matrix of the linear part with states ξ, ξ′, and Re z and Im z of each exponential and motion, and the
        inverse of the mass."""
        memory, count = self.memory, len(self.inertia)
        is_quick = np.abs(memory.rates) > _QUICK * highest
        quick, weights = memory.rates[is_quick][:, None, None], memory.weights[is_quick]
        rates, kept = memory.rates[~is_quick], memory.weights[~is_quick]
        mass = self.inertia + memory.infinite_frequency_added_mass - (weights / quick**2).sum(axis=0).real
        damping = self.outside.damping - (weights / quick).sum(axis=0).real
        inverse = np.linalg.inv(mass)
        one, states = np.eye(count), 2 * len(rates) * count
        turning = block_diag([np.kron([[p.real, -p.imag], [p.imag, p.real]], one) for p in rates])
        driven = np.tile(np.vstack([one, np.zeros_like(one)]), (len(rates), 1))
        # The force −Re(cz).
        pulled = np.concatenate([np.hstack([c.real, -c.imag]) for c in kept], axis=1)
        matrix = block_array(
            [
                [csr_array((count, count)), one, csr_array((count, states))],
                [-inverse @ (self.stiffness + self.outside.stiffness), -inverse @ damping, -inverse @ pulled],
                [csr_array((states, count)), driven, turning],
            ]
        )
        return matrix.tocsr(), inverse


def _moved(impedance: Complexes, forces: Complexes) -> Complexes:
    return np.asarray(np.linalg.solve(impedance, forces[..., None])[..., 0], dtype=complex)
