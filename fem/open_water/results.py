"""Results of the analyses of open water, per metre of width in SI units, with the time factor e^{−iωt}.

Those of solids of revolution are whole, and their units have one metre more.

Bodies move in their degrees of freedom `dofs`. Waves are the branches of the dispersion relation, "surface" and
"internal".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from hydroelastic.fem.open_water.region import Region
from hydroelastic.physics.dofs import Dof

Floats: TypeAlias = npt.NDArray[np.float64]
Complexes: TypeAlias = npt.NDArray[np.complex128]

DIRECTIONS = (0.0, np.pi)
"""Directions in which incident waves of a `RadiationTable` travel, rad: to the right, to the left."""

# Part of the load of a wave on a beam that does not follow it, below which loads count as none.
_NO_LOAD = 1e-4


@dataclass(frozen=True, kw_only=True)
class RadiationTable:
    """Forces of radiated and incident waves. Shapes: n frequencies, m motions, w waves."""

    omega: Floats  # (n,) rad/s; inf is the limit of infinite frequency
    dofs: tuple[Dof, ...]  # m degrees of freedom
    waves: tuple[str, ...]  # w names
    wavenumbers: Floats  # (n, w) k, 1/m
    added_mass: Floats  # (n, m, m) a, kg/m, kg, kg m; entry (i, j) is the force in i by motion in j
    # (n, m, m) b, kg/(m s), kg/s, kg m/s; the force is −(−ω² a − iω b) ζ. By the power of the radiated waves.
    radiation_damping: Floats
    radiation_damping_error: Floats  # (n, m, m) its estimated error, in the same units
    # (n, w, 2, m) N/m², moments N/m, per metre of elevation e^{i(±kx − ωt)}, in the directions of `DIRECTIONS`
    excitation_force: Complexes
    excitation_force_error: Floats  # (n, w, 2, m) its estimated error, in the same units
    froude_krylov_force: Complexes  # (n, w, 2, m) the part of the incident wave
    diffraction_force: Complexes  # (n, w, 2, m) the part of the scattered waves
    # (n,) estimated error of a, of each motion relative to its own |a + ib/ω|, at ω = 0 to |a|; the largest
    relative_error: Floats
    # (n,) difference of b by the pressure on the bodies and by the power of the radiated waves, over ω|a + ib/ω|
    energy_residual: Floats
    haskind_residual: Floats  # (n,) relative difference of the excitation and Haskind's formula with the radiated waves
    inertia: Floats  # (m, m) of the bodies, kg/m, kg, kg m
    stiffness: Floats  # (m, m) of the bodies and hydrostatics, N/m², N/m, N
    infinite_frequency_added_mass: Floats | None  # (m, m), the limit of infinite frequency, if it was requested
    factorizations: int
    # frequencies at which fields are wanted, rad/s; empty for those of the largest damping
    fields_at: tuple[float, ...] = ()


@dataclass(frozen=True, kw_only=True)
class PlateDeflection:
    """The deflection of a beam, or of a round plate along its diameter in the direction of the waves."""

    body: int  # its index among the bodies
    positions: Floats  # (p,) abscissas, m
    deflection: Complexes  # (n, w, p) upwards, per unit elevation of the incident wave
    bending_moment: Complexes  # (n, w, p) EI w″ per metre of elevation, N/m; of a plate D(w_xx + ν w_yy)
    shear_force: Complexes  # (n, w, p) (EI w″)′ per metre of elevation, N/m²; of a plate D ∂Δw/∂x
    deflection_error: Floats  # (n, w) estimated error of the deflection anywhere, m/m
    bending_moment_error: Floats  # (n, w) the same of the bending moment, N/m
    shear_force_error: Floats  # (n, w) the same of the shear force, N/m²
    # (n, w, p) of a plate of known thickness, along the diameter at its lower face, per metre of elevation
    strain: Complexes | None = None
    # (n, w) at the faces of a plate of known thickness, over all its points, per metre of elevation
    largest_strain: Floats | None = None
    largest_stress: Floats | None = None  # (n, w) likewise, Pa/m


@dataclass(frozen=True, kw_only=True)
class RoundDeflection:
    """The deflection w = Σ Wₙ(r) cos nθ of a round plate, order by order."""

    body: int  # its index among the bodies
    radii: Floats  # (p,) from the axis or the inner edge to the outer one, m
    # (4, n, w, orders, p) Wₙ, Wₙ′, Wₙ″ and ∂(ΔₙWₙ)/∂r per unit elevation of the incident wave, m^{-d}
    derivatives: Complexes
    # (2, n, w, orders) estimated errors of moment and shear force over the rigidity anywhere, 1/m², 1/m³
    uncertain: Floats


@dataclass(frozen=True, kw_only=True)
class HullPressure:
    """The pressure of all waves along the hull of a float, at points that do not move."""

    body: int  # its index among the bodies
    # (p, 2) x and y from the left end of the waterplane around the hull, m; of a solid of revolution those of its
    # section along the waves, and in one azimuthal order those of half of it
    points: Floats
    pressure: Complexes  # (n, w, p) complex amplitudes per metre of elevation, Pa/m
    pressure_error: Floats  # (n, w) estimated error anywhere on the hull, Pa/m
    # (n, w, orders, half of p) pₙ of Σ pₙ cos nθ about an axis, at the points of x ≥ 0 in their order; ``None`` of
    # sections
    partial_pressures: Complexes | None = None


@dataclass(frozen=True, kw_only=True)
class UnresolvedPeak:
    """A peak or a dip between two frequencies of a response, that its curve does not show."""

    below: float  # the frequency below it, rad/s
    above: float  # the frequency above it, rad/s
    omega: float  # of the resonance, about where the extreme is, rad/s
    quantity: str  # what changes most there: a motion, "|R|" or "|T|"
    value: float  # its magnitude there, in its unit per unit elevation
    drawn: float  # that of the straight line between the two frequencies


@dataclass(frozen=True, kw_only=True)
class Largest:
    """The largest magnitudes over the frequencies, those between the requested ones too."""

    value: Floats  # of each motion, m/m or rad/m, or of each reflected wave
    omega: Floats  # where they are, rad/s, of the same shape
    error: Floats  # their estimated errors, of the same shape


@dataclass(frozen=True, kw_only=True)
class ResponseTable:
    """Motions and waves per unit elevation of the incident wave. Shapes: n frequencies, m motions, w waves."""

    omega: Floats  # (n,) rad/s
    waves: tuple[str, ...]  # w names
    wavenumbers: Floats  # (n, w) k, 1/m
    dofs: tuple[Dof, ...]  # m degrees of freedom
    waves_from: Literal["left", "right"]  # the side from which the waves are incident
    amplitudes: Complexes  # (n, w, m) of the motions, m/m or rad/m
    amplitude_error: Floats  # (n, w, m) their estimated errors, by that of the largest motion, m/m or rad/m
    reflection: Complexes | None  # (n, w in, w out) ratio of elevations; ``None`` about an axis
    transmission: Complexes | None  # (n, w in, w out) ratio of elevations; ``None`` about an axis
    # (n, w) power that damping from outside takes, over incident power; about an axis over that of 1/k of the crest
    absorption: Floats
    drift_force: Floats  # (n, w) mean force on the bodies along x, per square of the amplitude of the waves, N/m³
    drift_error: Floats  # (n, w) its estimated error, N/m³
    energy_residual: Floats  # (n, w) relative difference of incident power and outgoing and absorbed power
    # (n,) estimated error of motions and waves, relative to the elevation of the incident wave, or to the largest
    # motion where that is larger
    relative_error: Floats
    plates: tuple[PlateDeflection, ...]  # one for each beam and each round plate
    round_plates: tuple[RoundDeflection, ...] = ()
    hulls: tuple[HullPressure, ...] = ()  # one for each float, if pressures were requested
    # (n, w) the drift force by the field beside the bodies, N/m³; in one liquid, if pressures were requested
    near_field_drift: Floats | None = None
    # frequencies at which fields are wanted, rad/s; empty for that of the largest motion
    fields_at: tuple[float, ...] = ()
    # of the incident waves, m, on which the damping by drag depends; 0 where it is not given
    wave_amplitude: float = 0.0
    # the same at frequencies between which nothing is missed, of more than six frequencies, to be drawn
    curve: ResponseTable | None = None
    missed_peaks: tuple[UnresolvedPeak, ...] = ()  # peaks that curves over ω do not show, found on a reduced basis
    largest: Largest | None = None  # motions, shape (w, m); of more than six frequencies those of the curve
    largest_reflection: Largest | None = None  # of each wave into itself, shape (w,); ``None`` about an axis
    # (n, w in, w out, orders) aⱼ of the elevation εⱼ iʲ [Jⱼ(kr) + aⱼ Hⱼ(kr)] cos jθ of each azimuthal order j about an
    # axis, j = 0, 1 …; ``None`` of a section
    partial_waves: Complexes | None = None

    def largest_load_error(self, weight: float) -> float:
        """The largest error of a load along a beam, relative to the largest of it at all frequencies.

        Loads below a small part of ρgl and ρgl², those of a wave of unit elevation on a beam of length l that does not
        follow it, count as none.
        """
        found = [0.0]
        for plate in self.plates:
            length = plate.positions[-1] - plate.positions[0]
            for name, held in (
                ("deflection", 1.0),
                ("shear_force", weight * length),
                ("bending_moment", weight * length**2),
            ):
                error, of = getattr(plate, f"{name}_error"), getattr(plate, name)
                found.append(float(error.max() / max(np.abs(of).max(), _NO_LOAD * held)))
        return max(found)


@dataclass(frozen=True, kw_only=True)
class ResonanceTable:
    """Freely decaying motions e^{−iωt}. Shapes: r resonances, m motions."""

    omega: Complexes  # (r,) rad/s, with negative imaginary part
    dofs: tuple[Dof, ...]  # m degrees of freedom
    labels: tuple[Dof, ...]  # the dominant motion of each
    body_amplitudes: Complexes  # (r, m) of the motions; the dominant one is 1
    residuals: Floats  # (r,) relative residual of the equations
    relative_error: Floats  # (r,) estimated relative error of ω
    # number of resonances in the region by an independent count; ``None`` where that is not certain
    counted: int | None
    region: Region | None  # of ω in which they were counted; ``None`` where no motion has a restoring force
    # frequency of the lowest of the elastic tones that were left out, as waves are far shorter there than the bodies,
    # rad/s; ``None`` of none
    not_sought: float | None = None


@dataclass(frozen=True, kw_only=True)
class DecayTable:
    """The motion of a float that is released at rest. Shapes: n times, m motions."""

    times: Floats  # (n,) s
    dofs: tuple[Dof, ...]  # m degrees of freedom
    displacement: Floats  # (n, m) m or rad
    initial: Floats  # (m,) the displacement at t = 0, m or rad
    absolute_error: Floats  # (n,) estimated error of the displacement, m or rad
    tail: float | None  # T of the tail T/tⁿ of the released motion, m sⁿ or rad sⁿ; None where no tail is known
    certified_until: float  # the time to which the error holds, s
    tail_power: int = 2  # n, 2, or 4 about an axis in deep water
