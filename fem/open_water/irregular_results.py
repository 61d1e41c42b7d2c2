"""Results of bodies in irregular waves, per metre of width or of whole solids, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from hydroelastic.fem.open_water.requests import AirGapPoint
from hydroelastic.fem.open_water.results import Complexes, Floats
from hydroelastic.physics.dofs import Dof


@dataclass(frozen=True, kw_only=True)
class ErrorsByCause:
    """Parts of the relative errors of significant amplitudes; of several the largest."""

    sampling_error: float  # by the sampling of transfer functions
    truncation_error: float  # by waves beyond the frequencies
    transfer_error: float  # by the errors of the transfer functions


@dataclass(frozen=True, kw_only=True)
class IrregularResponse(ErrorsByCause):
    """Statistics of one response to irregular waves; amplitudes have its unit."""

    quantity: str
    unit: str  # m, rad or m/s², of moments N, of strain 1
    significant_amplitude: float  # mean of the highest third of the amplitudes
    largest_amplitude: float  # most probable largest amplitude in the duration
    zero_crossing_period: float  # s
    relative_error: float  # estimated relative error of the significant amplitude by all causes


@dataclass(frozen=True, kw_only=True)
class AirGap:
    """The height of a point above the surface of irregular waves, linear in these."""

    point: AirGapPoint  # where it is, and whether it moves
    still_air_gap: float  # its height above the still water, m
    relative_elevation: IrregularResponse  # of the water less that of the point

    @property
    def smallest_air_gap(self) -> float:
        """Most probable smallest air gap in the duration, m; negative where the water rises above the point."""
        return self.still_air_gap - self.relative_elevation.largest_amplitude

    @property
    def air_gap_error(self) -> float:
        """Estimated error of the smallest air gap, m."""
        return self.relative_elevation.relative_error * self.relative_elevation.largest_amplitude


@dataclass(frozen=True, kw_only=True)
class PlateStatistics(ErrorsByCause):
    """Statistics along a beam, or along the diameter of a round plate, in irregular waves, per metre of width.

    Each is of shape (p,).
    """

    body: int  # its index among the bodies
    positions: Floats  # abscissas, m
    significant_deflection: Floats  # m
    significant_bending_moment: Floats  # N
    largest_bending_moment: Floats  # most probable largest in the duration, N
    significant_shear_force: Floats  # N/m
    largest_stress: Floats | None  # most probable largest stress at its faces, N/m²; ``None`` without a thickness
    # estimated errors of the significant "deflection", "bending_moment" and "shear_force" anywhere, relative to the
    # largest along the beam
    relative_errors: dict[str, float]

    @property
    def relative_error(self) -> float:
        """The largest of `relative_errors`."""
        return max(self.relative_errors.values())


@dataclass(frozen=True, kw_only=True)
class SpectrumTable:
    """Responses to irregular waves. Shapes: n frequencies, q quantities, m motions."""

    waves: str  # description of the waves
    waves_from: Literal["left", "right"]  # the side from which they come
    significant_height: float  # Hs, m
    duration: float  # of the sea state, s
    omega: Floats  # (n,) frequencies chosen by the solver, rad/s
    density: Floats  # (n,) spectrum of the waves, m² s/rad
    quantities: tuple[str, ...]  # q names
    transfer: Complexes  # (n, q) responses per unit elevation
    response_density: Floats  # (n, q) spectra of the responses
    relative_error: Floats  # (n,) estimated relative error of the transfer functions
    responses: tuple[IrregularResponse, ...]  # statistics of each quantity
    dofs: tuple[Dof, ...]  # m degrees of freedom
    mean_drift_force: float  # mean force on the bodies along x, N/m; NaN about an axis in waves on two levels
    mean_drift_error: float  # its estimated error, N/m
    mean_drift_truncation: float  # the part of this by the waves beyond the last frequency, N/m
    mean_absorbed_power: float  # mean power that linear damping from outside takes, W/m
    equivalent_damping: Floats  # (m, m) linear damping in place of drag, kg/(m s), kg/s, kg m/s
    plates: tuple[PlateStatistics, ...]  # one for each beam and round plate
    air_gaps: tuple[AirGap, ...] = ()  # of the points over the water

    def largest_error(self, cause: str) -> float:
        """Return the largest error of a significant amplitude or load by a cause, an attribute of `IrregularResponse`,
        relative to the largest in the same unit, or along the beam: a point may move little by symmetry."""
        largest: dict[str, float] = {}
        for one in self.responses:
            largest[one.unit] = max(largest.get(one.unit, 0.0), one.significant_amplitude)
        of_motions = (
            getattr(one, cause) * one.significant_amplitude / largest[one.unit]
            for one in self.responses
            if largest[one.unit]
        )
        return max((*of_motions, *(getattr(plate, cause) for plate in self.plates)), default=0.0)
