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
    """Forces of radiated and incident waves. Shapes: n frequencies, m motions, w waves.

    Attributes:
        omega: (n,) rad/s; inf is the limit of infinite frequency.
        dofs: m degrees of freedom.
        waves: w names.
        wavenumbers: (n, w) k, 1/m.
        added_mass: (n, m, m) a, kg/m, kg, kg m; entry (i, j) is the force in i by motion in j.
        radiation_damping: (n, m, m) b, kg/(m s), kg/s, kg m/s; the force is −(−ω² a − iω b) ζ. By the power of the
            radiated waves.
        radiation_damping_error: (n, m, m) its estimated error, in the same units.
        excitation_force: (n, w, 2, m) N/m², moments N/m, per metre of elevation e^{i(±kx − ωt)}, in the directions of
            `DIRECTIONS`.
        excitation_force_error: (n, w, 2, m) its estimated error, in the same units.
        froude_krylov_force: (n, w, 2, m) the part of the incident wave.
        diffraction_force: (n, w, 2, m) the part of the scattered waves.
        relative_error: (n,) estimated error of a, of each motion relative to its own |a + ib/ω|, at ω = 0 to |a|; the
            largest.
        energy_residual: (n,) difference of b by the pressure on the bodies and by the power of the radiated waves, over
            ω|a + ib/ω|.
        haskind_residual: (n,) relative difference of the excitation and Haskind's formula with the radiated waves.
        inertia: (m, m) of the bodies, kg/m, kg, kg m.
        stiffness: (m, m) of the bodies and hydrostatics, N/m², N/m, N.
        infinite_frequency_added_mass: (m, m), the limit of infinite frequency, if it was requested.
        factorizations: number of factorizations.
        fields_at: frequencies at which fields are wanted, rad/s; empty for those of the largest damping.
    """

    omega: Floats
    dofs: tuple[Dof, ...]
    waves: tuple[str, ...]
    wavenumbers: Floats
    added_mass: Floats
    radiation_damping: Floats
    radiation_damping_error: Floats
    excitation_force: Complexes
    excitation_force_error: Floats
    froude_krylov_force: Complexes
    diffraction_force: Complexes
    relative_error: Floats
    energy_residual: Floats
    haskind_residual: Floats
    inertia: Floats
    stiffness: Floats
    infinite_frequency_added_mass: Floats | None
    factorizations: int
    fields_at: tuple[float, ...] = ()


@dataclass(frozen=True, kw_only=True)
class PlateDeflection:
    """The deflection of a beam, or of a round plate along its diameter in the direction of the waves.

    Attributes:
        body: its index among the bodies.
        positions: (p,) abscissas, m.
        deflection: (n, w, p) upwards, per unit elevation of the incident wave.
        bending_moment: (n, w, p) EI w″ per metre of elevation, N/m; of a plate D(w_xx + ν w_yy).
        shear_force: (n, w, p) (EI w″)′ per metre of elevation, N/m²; of a plate D ∂Δw/∂x.
        deflection_error: (n, w) estimated error of the deflection anywhere, m/m.
        bending_moment_error: (n, w) the same of the bending moment, N/m.
        shear_force_error: (n, w) the same of the shear force, N/m².
        strain: (n, w, p) of a plate of known thickness, along the diameter at its lower face, per metre of elevation.
        largest_strain: (n, w) at the faces of a plate of known thickness, over all its points, per metre of elevation.
        largest_stress: (n, w) likewise, Pa/m.
    """

    body: int
    positions: Floats
    deflection: Complexes
    bending_moment: Complexes
    shear_force: Complexes
    deflection_error: Floats
    bending_moment_error: Floats
    shear_force_error: Floats
    strain: Complexes | None = None
    largest_strain: Floats | None = None
    largest_stress: Floats | None = None


@dataclass(frozen=True, kw_only=True)
class RoundDeflection:
    """The deflection w = Σ Wₙ(r) cos nθ of a round plate, order by order.

    Attributes:
        body: its index among the bodies.
        radii: (p,) from the axis or the inner edge to the outer one, m.
        derivatives: (4, n, w, orders, p) Wₙ, Wₙ′, Wₙ″ and ∂(ΔₙWₙ)/∂r per unit elevation of the incident wave, m^{-d}.
        uncertain: (2, n, w, orders) estimated errors of moment and shear force over the rigidity anywhere, 1/m², 1/m³.
    """

    body: int
    radii: Floats
    derivatives: Complexes
    uncertain: Floats


@dataclass(frozen=True, kw_only=True)
class HullPressure:
    """The pressure of all waves along the hull of a float, at points that do not move.

    Attributes:
        body: its index among the bodies.
        points: (p, 2) x and y from the left end of the waterplane around the hull, m; of a solid of revolution those of
            its section along the waves, and in one azimuthal order those of half of it.
        pressure: (n, w, p) complex amplitudes per metre of elevation, Pa/m.
        pressure_error: (n, w) estimated error anywhere on the hull, Pa/m.
        partial_pressures: (n, w, orders, half of p) pₙ of Σ pₙ cos nθ about an axis, at the points of x ≥ 0 in their
            order; ``None`` of sections.
    """

    body: int
    points: Floats
    pressure: Complexes
    pressure_error: Floats
    partial_pressures: Complexes | None = None


@dataclass(frozen=True, kw_only=True)
class UnresolvedPeak:
    """A peak or a dip between two frequencies of a response, that its curve does not show.

    Attributes:
        below: the frequency below it, rad/s.
        above: the frequency above it, rad/s.
        omega: of the resonance, about where the extreme is, rad/s.
        quantity: what changes most there: a motion, "|R|" or "|T|".
        value: its magnitude there, in its unit per unit elevation.
        drawn: that of the straight line between the two frequencies.
    """

    below: float
    above: float
    omega: float
    quantity: str
    value: float
    drawn: float


@dataclass(frozen=True, kw_only=True)
class Largest:
    """The largest magnitudes over the frequencies, those between the requested ones too.

    Attributes:
        value: of each motion, m/m or rad/m, or of each reflected wave.
        omega: where they are, rad/s, of the same shape.
        error: their estimated errors, of the same shape.
    """

    value: Floats
    omega: Floats
    error: Floats


@dataclass(frozen=True, kw_only=True)
class ResponseTable:
    """Motions and waves per unit elevation of the incident wave. Shapes: n frequencies, m motions, w waves.

    Attributes:
        omega: (n,) rad/s.
        waves: w names.
        wavenumbers: (n, w) k, 1/m.
        dofs: m degrees of freedom.
        waves_from: the side from which the waves are incident.
        amplitudes: (n, w, m) of the motions, m/m or rad/m.
        amplitude_error: (n, w, m) their estimated errors, by that of the largest motion, m/m or rad/m.
        reflection: (n, w in, w out) ratio of elevations; ``None`` about an axis.
        transmission: (n, w in, w out) ratio of elevations; ``None`` about an axis.
        absorption: (n, w) power that damping from outside takes, over incident power; about an axis over that of 1/k of
            the crest.
        drift_force: (n, w) mean force on the bodies along x, per square of the amplitude of the waves, N/m³.
        drift_error: (n, w) its estimated error, N/m³.
        energy_residual: (n, w) relative difference of incident power and outgoing and absorbed power.
        relative_error: (n,) estimated error of motions and waves, relative to the elevation of the incident wave, or to
            the largest motion where that is larger.
        plates: one for each beam and each round plate.
        round_plates: one for each round plate.
        hulls: one for each float, if pressures were requested.
        near_field_drift: (n, w) the drift force by the field beside the bodies, N/m³; in one liquid, if pressures were
            requested.
        fields_at: frequencies at which fields are wanted, rad/s; empty for that of the largest motion.
        wave_amplitude: of the incident waves, m, on which the damping by drag depends; 0 where it is not given.
        curve: the same at frequencies between which nothing is missed, of more than six frequencies, to be drawn.
        missed_peaks: peaks that curves over ω do not show, found on a reduced basis.
        largest: motions, shape (w, m); of more than six frequencies those of the curve.
        largest_reflection: of each wave into itself, shape (w,); ``None`` about an axis.
        partial_waves: (n, w in, w out, orders) aⱼ of the elevation εⱼ iʲ [Jⱼ(kr) + aⱼ Hⱼ(kr)] cos jθ of each azimuthal
            order j about an axis, j = 0, 1 …; ``None`` of a section.
    """

    omega: Floats
    waves: tuple[str, ...]
    wavenumbers: Floats
    dofs: tuple[Dof, ...]
    waves_from: Literal["left", "right"]
    amplitudes: Complexes
    amplitude_error: Floats
    reflection: Complexes | None
    transmission: Complexes | None
    absorption: Floats
    drift_force: Floats
    drift_error: Floats
    energy_residual: Floats
    relative_error: Floats
    plates: tuple[PlateDeflection, ...]
    round_plates: tuple[RoundDeflection, ...] = ()
    hulls: tuple[HullPressure, ...] = ()
    near_field_drift: Floats | None = None
    fields_at: tuple[float, ...] = ()
    wave_amplitude: float = 0.0
    curve: ResponseTable | None = None
    missed_peaks: tuple[UnresolvedPeak, ...] = ()
    largest: Largest | None = None
    largest_reflection: Largest | None = None
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
    """Freely decaying motions e^{−iωt}. Shapes: r resonances, m motions.

    Attributes:
        omega: (r,) rad/s, with negative imaginary part.
        dofs: m degrees of freedom.
        labels: the dominant motion of each.
        body_amplitudes: (r, m) of the motions; the dominant one is 1.
        residuals: (r,) relative residual of the equations.
        relative_error: (r,) estimated relative error of ω.
        counted: number of resonances in the region by an independent count; ``None`` where that is not certain.
        region: of ω in which they were counted; ``None`` where no motion has a restoring force.
        not_sought: frequency of the lowest of the elastic tones that were left out, as waves are far shorter there than
            the bodies, rad/s; ``None`` of none.
    """

    omega: Complexes
    dofs: tuple[Dof, ...]
    labels: tuple[Dof, ...]
    body_amplitudes: Complexes
    residuals: Floats
    relative_error: Floats
    counted: int | None
    region: Region | None
    not_sought: float | None = None


@dataclass(frozen=True, kw_only=True)
class DecayTable:
    """The motion of a float that is released at rest. Shapes: n times, m motions.

    Attributes:
        times: (n,) s.
        dofs: m degrees of freedom.
        displacement: (n, m) m or rad.
        initial: (m,) the displacement at t = 0, m or rad.
        absolute_error: (n,) estimated error of the displacement, m or rad.
        tail: T of the tail T/tⁿ of the released motion, m sⁿ or rad sⁿ; None where no tail is known.
        tail_power: n, 2, or 4 about an axis in deep water.
        certified_until: the time to which the error holds, s.
    """

    times: Floats
    dofs: tuple[Dof, ...]
    displacement: Floats
    initial: Floats
    absolute_error: Floats
    tail: float | None
    certified_until: float
    tail_power: int = 2
