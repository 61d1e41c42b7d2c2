"""Results of the analyses over time, in SI units: of sections per metre of width, of bodies of revolution whole."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hydroelastic.fem.time_domain.radiation_memory import Floats
from hydroelastic.physics.dofs import Dof


@dataclass(frozen=True, kw_only=True)
class ImpulseResponseTable:
    """Impulse response functions of radiation. Shapes: n times, c frequencies, m motions."""

    times: Floats  # (n,) s, not negative
    dofs: tuple[Dof, ...]  # m degrees of freedom
    # (n, m, m) K; entry (i, j) is the force in i after a jump of displacement in j, N/m, of width
    impulse_response: Floats
    infinite_frequency_added_mass: Floats  # (m, m) a∞
    omega: Floats  # (c,) rad/s
    added_mass: Floats  # (c, m, m) a∞ − (1/ω) ∫ K sin ωt dt
    radiation_damping: Floats  # (c, m, m) ∫ K cos ωt dt
    # (c,) largest difference of a + i b/ω by K and by the solution at that frequency, relative to |a + i b/ω| of both
    # motions there, at least a∞ and K(0)/Ω²
    causality_error: Floats
    ogilvie_error: Floats  # (c,) the same of a∞ by Ogilvie's relation and by the limit of infinite frequency
    impulse_response_error: Floats  # (n,) estimated error of K, relative to K(0) of both motions
    relative_error: float  # the largest of these, or the estimated relative error of H, from which K is made


@dataclass(frozen=True, kw_only=True)
class MotionTable:
    """Motions in waves over time, from rest. Shapes: n times, w waves, m motions."""

    times: Floats  # (n,) s
    dofs: tuple[Dof, ...]  # m degrees of freedom
    waves_from: str  # the side from which the waves come
    wave_omega: Floats  # (w,) rad/s
    wave_amplitude: Floats  # (w,) m
    wave_phase: Floats  # (w,) rad: η = Σ A cos(ωt − phase) at the middle of the first body
    ramp: float  # time in which the waves grow, s
    initial: Floats  # (m,) displacement at t = 0, m or rad
    elevation: Floats  # (n,) m, there, without the bodies, as the waves grow
    displacement: Floats  # (n, m) m or rad
    velocity: Floats  # (n, m) m/s or rad/s
    # (n, m) m or rad, in the same waves without a beginning, by the frequency domain; drag is linear there
    steady: Floats
    # estimated error of the motions by those of forces, added mass and damping, relative to the largest in the same
    # unit
    relative_error: float

    @property
    def beginning(self) -> str:
        """How the motion begins, in words."""
        waves = f"waves from the {self.waves_from}" if len(self.wave_omega) else "still water"
        return f"after a release in {waves}" if self.initial.any() else f"from rest in {waves}"

    @cached_property
    def _grown(self) -> np.ndarray:
        """Whether the waves have grown, or all times if none is later, shape (n,)."""
        later: np.ndarray = self.times >= self.ramp
        return later if later.any() else np.ones_like(later)

    @property
    def standard_deviation(self) -> Floats:
        """Of each motion after the ramp, about its mean, shape (m,)."""
        return self.displacement[self._grown].std(axis=0)

    @property
    def largest(self) -> Floats:
        """The largest |displacement| after the ramp, shape (m,)."""
        sizes: Floats = np.abs(self.displacement[self._grown]).max(axis=0)
        return sizes
