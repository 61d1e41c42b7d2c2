"""Requests to the solvers of open water, SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

from hydroelastic.physics.dofs import Dof

if TYPE_CHECKING:
    # Spectra need SciPy, whose import is slow.
    from hydroelastic.physics.wave_spectrum import WaveSpectrum


@dataclass(frozen=True, kw_only=True)
class RadiationRequest:
    """Added mass, radiation damping and excitation forces."""

    kind: ClassVar = "radiation"
    omega: tuple[float, ...]  # frequencies, rad/s; 0 for the limit of long waves, inf for the infinite-frequency limit
    elastic_modes: int = 4  # number of elastic shapes of each beam that are reported
    # frequencies at which fields are written and drawn, rad/s; empty for those of the largest damping
    fields_at: tuple[float, ...] = ()

    @property
    def band(self) -> tuple[float, float] | None:
        """Lowest and highest frequency of waves, rad/s; ``None`` of limits alone."""
        finite = [omega for omega in self.omega if 0.0 < omega < inf]
        return (min(finite), max(finite)) if finite else None


@dataclass(frozen=True, kw_only=True)
class ResponseRequest:
    """Motions, reflection and transmission in incident waves."""

    kind: ClassVar = "response"
    omega: tuple[float, ...]  # frequencies, rad/s, positive and finite
    waves_from: Literal["left", "right"] = "left"  # the side from which the waves are incident
    positions: int = 101  # number of points along each beam at which its deflection is reported
    elevation: float = 0.0  # amplitude of the incident waves, m, on which the damping by drag depends
    hull_pressures: bool = False  # whether pressures along hulls are reported, and the drift force by them
    # frequencies at which fields are written and drawn, rad/s; empty for that of the largest motion
    fields_at: tuple[float, ...] = ()

    @property
    def band(self) -> tuple[float, float]:
        """Lowest and highest frequency, rad/s."""
        return min(self.omega), max(self.omega)


@dataclass(frozen=True, kw_only=True)
class ResonanceRequest:
    """Complex frequencies of freely decaying motions."""

    kind: ClassVar = "resonance"
    count: int = 4  # largest number of resonances, from the smallest |ω|
    below: float | None = None  # upper limit of Re ω, rad/s; ``None`` for the lowest resonances
    # upper limit of −Im ω/Re ω; above `region.MOST_DAMPING_ANYWHERE` all liquids must be infinitely deep
    largest_damping: float = 0.5


@dataclass(frozen=True, kw_only=True)
class DecayRequest:
    """The motion of a float that is released at rest."""

    kind: ClassVar = "decay"
    body: int = 0  # index of the float among the bodies
    heave: float = 0.0  # its initial displacement upwards, m
    roll: float = 0.0  # its initial rotation anticlockwise, the roll of a section or the pitch of a solid, rad
    times: tuple[float, ...]  # times after the release, s


@dataclass(frozen=True, kw_only=True)
class ImpulseResponseRequest:
    """Impulse response functions of radiation."""

    kind: ClassVar = "impulse_response"
    times: tuple[float, ...]  # times after the impulse, s
    elastic_modes: int = 4  # number of elastic shapes of each beam


@dataclass(frozen=True, kw_only=True)
class RegularWave:
    """An incident wave A cos(ωt − phase) at the middle of the first body."""

    omega: float  # ω, rad/s
    amplitude: float  # A, m
    phase: float  # rad


@dataclass(frozen=True, kw_only=True)
class MotionRequest:
    """Motions over time in waves that begin at t = 0, from rest, or from a displacement of one float."""

    kind: ClassVar = "motion"
    times: tuple[float, ...]  # ascending, s
    waves: tuple[RegularWave, ...]  # the incident waves
    waves_from: Literal["left", "right"] = "left"  # the side from which they come
    ramp: float = 0.0  # time in which they grow to their height, s
    elastic_modes: int = 4  # number of elastic shapes of each beam
    body: int = 0  # index of the float that is released at t = 0
    # its initial displacement by the name of the motion, m or rad
    displacement: Mapping[str, float] = field(default_factory=dict)

    def initial(self, dofs: tuple[Dof, ...]) -> tuple[float, ...]:
        """Return the displacement of each motion at t = 0, m or rad."""
        return tuple(
            self.displacement.get(dof.motion, 0.0) if (dof.body or 1) - 1 == self.body else 0.0 for dof in dofs
        )


@dataclass(frozen=True, kw_only=True)
class AirGapPoint:
    """A point over the water, whose height above the moving surface is asked for."""

    at: tuple[float, float]  # (x, y) at rest, m
    across: float = 0.0  # its distance from the vertical plane of x and y, m; of solids of revolution alone
    body: int | None = None  # index of the body with which it moves; ``None`` of a fixed point


@dataclass(frozen=True, kw_only=True)
class SpectrumRequest:
    """Statistics of the response to irregular waves."""

    kind: ClassVar = "spectrum"
    spectrum: WaveSpectrum  # of the waves
    words: str  # description of the waves
    waves_from: Literal["left", "right"] = "left"  # the side from which the waves are incident
    duration: float = 10800.0  # of the sea state, s
    # highest frequency, rad/s; ``None`` for that of the spectrum, or one that leaves little beyond
    highest: float | None = None
    # points of bodies at which motions are reported, (index of the body, (x, y) in m)
    points: tuple[tuple[int, tuple[float, float]], ...] = ()
    positions: int = 51  # number of points along each beam
    thickness: float | None = None  # of beams, m, for their stresses 6M/h²; ``None`` for no stresses
    air_gaps: tuple[AirGapPoint, ...] = ()  # points whose height above the moving surface is reported

    @property
    def band(self) -> tuple[float, float]:
        """Lowest and highest frequency, rad/s."""
        low, high = self.spectrum.band
        # A table ends with nothing beyond.
        return low, (self.highest or high) if self.spectrum.tail(high, 0) else min(high, self.highest or high)


OVER_TIME = (ImpulseResponseRequest, MotionRequest)
"""Requests that need the memory of the water."""

Request: TypeAlias = (
    RadiationRequest
    | ResponseRequest
    | ResonanceRequest
    | DecayRequest
    | SpectrumRequest
    | ImpulseResponseRequest
    | MotionRequest
)
