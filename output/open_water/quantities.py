"""Quantities of open water, per metre of width, with the names and dimensions of Capytaine in ``dataset.nc``.

Capytaine has the same time factor e^{−iωt} and incident waves e^{ik(x cos β) − iωt} of unit elevation. Names of motions
are capitalised there: "Heave", "body_2__Heave". What it has no name for, here has one of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.results import DIRECTIONS, Complexes, Floats, ResponseTable
from hydroelastic.output.open_water.bodies import BODIES
from hydroelastic.output.open_water.declarations import (
    CREST,
    DOFS,
    NUMBERED,
    OF_BODIES,
    joined_array,
    named_dofs,
    own_array,
)
from hydroelastic.output.open_water.estimates import ESTIMATES
from hydroelastic.output.open_water.hull_pressures import HULLS, Pressure, pressure_along
from hydroelastic.output.open_water.irregular import SPECTRUM
from hydroelastic.output.open_water.time_quantities import IMPULSE_RESPONSE, MOTION
from hydroelastic.output.provenance import PROCESSES
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.physics.dofs import Dof, body_name

_INERTIA: dict[str, Any] = {"unit": "kg/m", "of_roll": ("kg", "kg m")}
_DAMPING: dict[str, Any] = {"unit": "kg/(m s)", "of_roll": ("kg/s", "kg m/s")}
_FORCE: dict[str, Any] = {"unit": "N/m^2", "of_roll": ("N/m",)}
_MOTION: dict[str, Any] = {"unit": "m", "of_roll": ("rad",)}
_PER_ELEVATION: dict[str, Any] = {"unit": "m/m", "of_roll": ("rad/m",)}


@dataclass(frozen=True, kw_only=True)
class Deflection:
    """The deflection of a beam or round plate in waves: `number` of the body, from 1, and `PlateDeflection` with the
    waves."""

    number: int
    omega: Floats
    waves: tuple[str, ...]
    positions: Floats
    deflection: Complexes
    bending_moment: Complexes
    shear_force: Complexes
    deflection_error: Floats
    bending_moment_error: Floats
    shear_force_error: Floats
    largest_strain: Floats | None
    largest_stress: Floats | None


@dataclass(frozen=True, kw_only=True)
class WavesAndMotions(ResponseTable):
    """A response with the bodies.

    Attributes:
        centres: x of the middle of the waterplane of each body, from where the phase of the wave is 0, m.
        motions: those of the radiation analyses; of this response if there is none.
    """

    centres: tuple[float, ...]
    motions: tuple[Dof, ...]

    @property
    def further(self) -> list[int]:
        """Places of the motions that the radiation analyses lack: further shapes of beams."""
        return [place for place, dof in enumerate(self.dofs) if dof not in self.motions]

    @property
    def direction(self) -> float:
        """In which the incident waves travel, rad."""
        return DIRECTIONS[0] if self.waves_from == "left" else DIRECTIONS[1]

    @property
    def deflections(self) -> Iterator[Deflection]:
        """The deflection of each beam and round plate."""
        for plate in self.plates:
            yield Deflection(
                number=plate.body + 1,
                omega=self.omega,
                waves=self.waves,
                positions=plate.positions,
                deflection=plate.deflection,
                bending_moment=plate.bending_moment,
                shear_force=plate.shear_force,
                deflection_error=plate.deflection_error,
                bending_moment_error=plate.bending_moment_error,
                shear_force_error=plate.shear_force_error,
                largest_strain=plate.largest_strain,
                largest_stress=plate.largest_stress,
            )

    @property
    def pressures(self) -> Iterator[Pressure]:
        """The pressure along each hull."""
        return (pressure_along(self, hull) for hull in self.hulls)


def region_words(region: Region | None) -> str:
    """Return a description of the region of ω in which resonances were sought."""
    if region is None:
        return "any ω: the bodies have no restoring force"
    return f"{region.lowest:.4g} < Re ω < {region.highest:.4g} rad/s, −Im ω < {region.damping:g} Re ω"


def _responses(solution: Any) -> list[WavesAndMotions]:
    motions = motions_of(*solution.radiation) or motions_of(*solution.response)
    tank = solution.tank
    middles = [0.0 if tank.geometry.is_revolved else sum(body.waterplane) / 2.0 for body in tank.bodies]
    centres = tuple(middle - tank.phase_at for middle in middles)
    return [WavesAndMotions(**vars(table), centres=centres, motions=motions) for table in solution.response]


def motions_of(*tables: Any) -> tuple[Dof, ...]:
    """Return the motions of the table that has most."""
    return max((table.dofs for table in tables), key=len, default=())


def _phase_at_body(table: WavesAndMotions) -> Floats:
    """Return θ, degrees, of the motion |a| cos(ωt − θ) of a body that the crest of the incident wave passes at t = 0.

    The phase of a is beside the crest at x_p, and waves e^{±ik(x − x_p) − iωt} are e^{±ikx_b} at the middle of the
    waterplane, x_b from there: θ = arg(a e^{∓ikx_b}), upper signs for waves from the left. NaN where |a| is not larger
    than its error.
    """
    centres = np.array([table.centres[(dof.body or 1) - 1] for dof in table.dofs])
    towards = 1.0 if table.waves_from == "left" else -1.0
    at_body = table.amplitudes * np.exp(-1j * towards * table.wavenumbers[:, :, None] * centres)
    is_known = np.abs(table.amplitudes) > table.amplitude_error
    # No negative zero.
    return np.where(is_known, np.degrees(np.angle(at_body)) + 0.0, np.nan)


def scattering_width(table: ResponseTable) -> Floats | None:
    """Return σ = (4/k) Σ εₙ |aₙ|², m, shape (frequencies, 1); of solids of revolution in waves on one level."""
    if table.partial_waves is None or len(table.waves) > 1:
        return None
    sizes = np.abs(table.partial_waves[:, :, 0]) ** 2
    factors = np.where(np.arange(sizes.shape[-1]) == 0, 1.0, 2.0)
    return np.asarray(4.0 / table.wavenumbers * (sizes @ factors))


def scattering_width_error(table: ResponseTable) -> Floats | None:
    """Return the error of σ where each aₙ has the error that is relative to the incident wave, m."""
    if table.partial_waves is None or len(table.waves) > 1:
        return None
    error = table.relative_error[:, None]
    changes = 2.0 * error * np.abs(table.partial_waves[:, 0, 0]) + error**2
    factors = np.where(np.arange(changes.shape[-1]) == 0, 1.0, 2.0)
    return np.asarray(4.0 / table.wavenumbers * (changes @ factors)[:, None])


def directional_scattering(table: ResponseTable, angles: Floats) -> Floats | None:
    """Return dσ/dθ = 2/(πk) |Σ εₙ aₙ cos nθ|², m/rad, shape (frequencies, 1, angles), whose integral is σ; of solids of
    revolution in waves on one level.

    Far away iⁿHₙ(kr) is √(2/(πkr)) e^{i(kr − π/4)} of every order n.
    """
    if table.partial_waves is None or len(table.waves) > 1:
        return None
    orders = np.arange(table.partial_waves.shape[-1])
    cosines = np.where(orders == 0, 1.0, 2.0)[:, None] * np.cos(np.outer(orders, angles))
    far = np.abs(table.partial_waves[:, :, 0] @ cosines) ** 2
    return np.asarray(2.0 / (np.pi * table.wavenumbers[..., None]) * far)


def _inverse(name: str) -> Callable[[Any], Floats]:
    def found(table: Any) -> Floats:
        # Infinite in the limit of long waves.
        with np.errstate(divide="ignore"):
            return np.asarray(2.0 * np.pi / getattr(table, name))

    return found


SCATTERING_ANGLES: Floats = np.linspace(0.0, np.pi, 37, dtype=np.float64)
"""Steps of five degrees; the waves on the other side are their mirror images."""

# fmt: off
# A table: as many arguments on a line as fit.
OMEGA = joined_array("omega", "angular frequency", "omega", unit="rad/s", symbol="ω", shown=".6g")
_WAVES = (
    WAVES := joined_array("waves", "branch of the dispersion relation", "wave", short="wave", variable="wave",
        column="wave", note="a dimension only where waves travel on two levels"),
    WAVENUMBERS := joined_array("wavenumbers", "wavenumber", "omega wave", unit="1/m", symbol="k", shown=".6g",
        variable="wavenumber", column="wavenumber", is_coordinate=True),
    own_array("wavelength", "wavelength", "omega wave", _inverse("wavenumbers"), unit="m", is_coordinate=True),
    own_array("period", "period", "omega", _inverse("omega"), unit="s", is_coordinate=True),
)


_MATRIX = "omega influenced_dof radiating_dof", "omega radiating_dof influenced_dof"  # Capytaine puts the motion first.
_FORCES = "omega wave wave_direction influenced_dof"
RADIATION = Group("radiation", "radiated and incident waves, by analysis; matrices are force by motion", (
    OMEGA,
    *_WAVES,
    DOFS,
    named_dofs("radiating_dof", "motion that radiates"),
    named_dofs("influenced_dof", "motion that a force excites"),
    joined_array("wave_direction", "direction in which incident waves travel", "wave_direction", unit="rad",
        value=lambda _: DIRECTIONS, printed=False),
    joined_array("added_mass", "added mass", *_MATRIX, symbol="a", error="relative_error", **_INERTIA),
    RADIATION_DAMPING := joined_array("radiation_damping", "radiation damping", *_MATRIX, symbol="b",
        error="radiation_damping_error", note="by the power of the radiated waves", **_DAMPING),
    joined_array("radiation_damping_error", "estimated error of the radiation damping", *_MATRIX, short="± b",
        shown=".1e", note="of each entry by itself", **_DAMPING, contract=False),
    joined_array("excitation_force", "excitation force per unit elevation", _FORCES, symbol="|f|", phase=CREST,
        error="excitation_force_error", **_FORCE),
    joined_array("excitation_force_error", "estimated error of the excitation force per unit elevation", _FORCES,
        printed=False, note="of each force by itself", **_FORCE, contract=False),
    joined_array("froude_krylov_force", "force of the incident wave per unit elevation", _FORCES,
        variable="Froude_Krylov_force", printed=False, phase=CREST, **_FORCE),
    joined_array("diffraction_force", "force of the scattered waves per unit elevation", _FORCES, printed=False,
        phase=CREST, **_FORCE),
    RADIATION_ERROR := joined_array("relative_error",
        "estimated error of the added mass, of each motion relative to the magnitude of a + ib/ω of that motion alone",
        "omega", unit="1", short="error/|H|", shown=".1e", variable="radiation_relative_error",
        note="the largest of all motions; at ω = 0 relative to a. Coupling terms, and motions beside others "
            "that move far more water, may be wrong by more of themselves", contract=False),
    joined_array("energy_residual",
        "difference of damping by pressure and by the radiated power, relative to ω times the magnitude of a + ib/ω",
        "omega", unit="1", printed=False, variable="radiation_energy_residual", contract=False),
    joined_array("haskind_residual", "relative difference of the excitation and its value by Haskind's relation",
        "omega", unit="1", printed=False, contract=False),
    joined_array("inertia", "inertia of the bodies", OF_BODIES, variable="inertia_matrix", **_INERTIA),
    joined_array("stiffness", "stiffness of bodies and hydrostatics", OF_BODIES, variable="hydrostatic_stiffness",
        unit="N/m^2", of_roll=("N/m", "N")),
    joined_array("infinite_frequency_added_mass", "added mass at infinite frequency", OF_BODIES,
        note="`null` if it was not requested", **_INERTIA),
    Quantity("factorizations", "number of factorizations", "1", contract=False),
), dimension="radiation_analysis")


def _largest(key: str, words: str, dimensions: str, *, note: str = "", **units: Any) -> Group:
    names = tuple(dimensions.split())
    return Group(key, f"{words} over the frequencies, of more than six also between the requested ones", (
        Quantity("value", words, dimensions=names, printed=False, variable="", **units),
        Quantity("omega", "frequency at which it is", "rad/s", dimensions=names, printed=False, variable=""),
        Quantity("error", "its estimated error", dimensions=names, printed=False, variable="", **units, contract=False),
    ), note=note)


# fmt: off
_AMPLITUDES = "omega wave radiating_dof", "omega wave_direction wave radiating_dof"
_RATIOS = "omega wave outgoing_wave", "omega wave_direction wave outgoing_wave"
ALONG_BEAM = "position_on_body_{.number}"
"""The dimension of the places along a beam."""
PLATES = Group("plates", "the deflection of each beam, and of each round plate along the diameter of the waves", (
    PLATE_BODY := Quantity("body", "number of the body", "1", value=lambda it: it.number, variable="", column="body"),
    POSITIONS := joined_array("positions", "position on body {.number}", ALONG_BEAM, unit="m", variable=ALONG_BEAM,
        column="x"),
    DEFLECTION := joined_array("deflection", "deflection of body {.number}", f"omega wave {ALONG_BEAM}",
        f"omega wave_direction wave {ALONG_BEAM}", unit="m/m", variable="deflection_of_body_{.number}",
        phase=CREST),
    BENDING_MOMENT := joined_array("bending_moment", "bending moment of body {.number} per metre of width",
        f"omega wave {ALONG_BEAM}", f"omega wave_direction wave {ALONG_BEAM}", unit="N/m",
        variable="bending_moment_of_body_{.number}", phase=CREST),
    SHEAR_FORCE := joined_array("shear_force", "shear force of body {.number} per metre of width",
        f"omega wave {ALONG_BEAM}", f"omega wave_direction wave {ALONG_BEAM}", unit="N/m^2",
        variable="shear_force_of_body_{.number}", phase=CREST),
    *(joined_array(f"{key}_error", f"estimated error of the {words} of body {{.number}} anywhere", "omega wave",
        "omega wave_direction wave", unit=unit, variable=f"{key}_error_of_body_{{.number}}", printed=False, column="",
        contract=False)
        for key, words, unit in (("deflection", "deflection", "m/m"), ("bending_moment", "bending moment", "N/m"),
            ("shear_force", "shear force", "N/m^2"))),
    LARGEST_STRAIN := joined_array("largest_strain",
        "largest principal strain at the faces of body {.number} per unit elevation", "omega wave",
        "omega wave_direction wave", unit="1/m", short="largest strain", variable="largest_strain_of_body_{.number}",
        note="over the whole plate and all times; `null` of beams, and of plates without `thickness`"),
    LARGEST_STRESS := joined_array("largest_stress",
        "largest principal stress at the faces of body {.number} per unit elevation", "omega wave",
        "omega wave_direction wave", unit="Pa/m", short="largest stress", variable="largest_stress_of_body_{.number}",
        note="as `largest_strain`"),
), record=lambda table: list(table.deflections), dimension="plate")
RESPONSE = Group("response", "motions and waves per unit elevation of the incident wave, by analysis", (
    OMEGA,
    WAVES_FROM := Quantity("waves_from", 'side from which the waves come, `"left"` or `"right"`', variable="",
        column="waves_from"),
    *_WAVES,
    DOFS,
    named_dofs("radiating_dof", "motion that radiates"),
    own_array("shape", "further shape", "shape", lambda it: [it.dofs[place].capitalised for place in it.further]),
    own_array("outgoing_wave", "branch of the outgoing wave", "outgoing_wave", lambda it: it.waves),
    own_array("wave_direction", "direction in which incident waves travel", "wave_direction",
        lambda it: [it.direction], unit="rad"),
    REFLECTION := joined_array("reflection", "elevation of the reflected wave over that of the incident one", *_RATIOS,
        unit="1", symbol="|R|", error="relative_error", variable="reflection_coefficient", phase=CREST,
        note="`null` of solids of revolution"),
    TRANSMISSION := joined_array("transmission", "elevation of the transmitted wave over that of the incident one",
        *_RATIOS, unit="1", symbol="|T|", error="relative_error", variable="transmission_coefficient", phase=CREST,
        note="`null` of solids of revolution"),
    AMPLITUDES := joined_array("amplitudes", "motion per unit elevation of the incident wave", *_AMPLITUDES,
        error="amplitude_error", variable="RAO", column="", phase=CREST, **_PER_ELEVATION),
    AMPLITUDE_ERROR := joined_array("amplitude_error", "estimated error of the motion per unit elevation",
        *_AMPLITUDES, variable="RAO_error", printed=False, note="by `relative_error`, of the largest motion",
        **_PER_ELEVATION, contract=False),
    joined_array("partial_waves",
        "a_n of the elevation eps_n i^n [J_n(kr) + a_n H_n(kr)] cos(n theta) of each azimuthal order n",
        "omega wave outgoing_wave azimuthal_order", "omega wave_direction wave outgoing_wave azimuthal_order", unit="1",
        printed=False, column="partial_wave",
        note="about the axis of solids of revolution; `null` of sections; their error is `relative_error`, whatever "
            "their size"),
    SCATTERING_WIDTH := joined_array("scattering_width",
        "power of the scattered waves over that of the incident wave per metre of crest", "omega wave",
        "omega wave_direction wave", unit="m", symbol="σ", error="scattering_width_error", value=scattering_width,
        note="of solids of revolution, in waves on one level; `null` of sections"),
    SCATTERING_WIDTH_ERROR := joined_array("scattering_width_error", "estimated error of the scattering width",
        "omega wave", "omega wave_direction wave", unit="m", printed=False, value=scattering_width_error,
        note="by `relative_error` of each partial wave", contract=False),
    own_array("scattering_angle", "angle from the direction in which the incident waves travel", "scattering_angle",
        lambda it: None if it.partial_waves is None else SCATTERING_ANGLES, unit="rad", note="`null` of sections"),
    own_array("directional_scattering", "scattering width per angle", "omega wave scattering_angle",
        lambda it: directional_scattering(it, SCATTERING_ANGLES), order="omega wave_direction wave scattering_angle",
        unit="m/rad", note="as `scattering_width`, which it is the integral of"),
    PHASE_AT_BODY := joined_array("phase_at_body",
        "phase of the motion beside the crest of the incident wave at the middle of the body's waterplane",
        *_AMPLITUDES, unit="degree", value=_phase_at_body, shown=".1f", variable="RAO_phase_at_body",
        note="positive where it comes after the crest, `null` where the motion is not larger than its error"),
    own_array("shape_amplitude", "amplitude of a further shape per unit elevation", "omega wave shape",
        lambda it: it.amplitudes[:, :, it.further] if it.further else None, order="omega wave_direction wave shape",
        unit="1", phase=CREST),
    own_array("shape_phase_at_body", "phase of a further shape, as `RAO_phase_at_body`", "omega wave shape",
        lambda it: _phase_at_body(it)[:, :, it.further] if it.further else None,
        order="omega wave_direction wave shape", unit="degree"),
    ABSORPTION := joined_array("absorption", "power that damping from outside takes, over that of the incident wave",
        "omega wave", "omega wave_direction wave", unit="1", short="absorbed", shown=".4g",
        variable="absorbed_power_fraction", value=lambda it: it.absorption if it.partial_waves is None else None,
        note="`null` of solids of revolution"),
    CAPTURE_WIDTH := joined_array("capture_width",
        "power that damping from outside takes, over that of a metre of the incident crest", "omega wave",
        "omega wave_direction wave", unit="m", short="capture width", shown=".4g",
        value=lambda it: None if it.partial_waves is None else it.absorption / it.wavenumbers,
        note="of solids of revolution; `null` of sections"),
    DRIFT_FORCE := joined_array("drift_force", "mean force along x over the square of the amplitude of the waves",
        "omega wave", "omega wave_direction wave", unit="N/m^3", short="drift/A²", error="drift_error"),
    DRIFT_ERROR := joined_array("drift_error", "its estimated error", "omega wave", "omega wave_direction wave",
        unit="N/m^3", printed=False, contract=False),
    joined_array("near_field_drift", "the same by the field beside the bodies, as a check", "omega wave",
        "omega wave_direction wave", unit="N/m^3", note="`null` unless `hull_pressures`, in one liquid"),
    ENERGY_RESIDUAL := joined_array("energy_residual",
        "relative difference of incident power, and outgoing and absorbed power", "omega wave",
        "omega wave_direction wave", unit="1", short="energy", shown=".1e", variable="response_energy_residual",
        contract=False),
    RESPONSE_ERROR := joined_array("relative_error",
        "estimated error of motions and waves, relative to the incident wave, or to the largest motion where that is "
        "larger", "omega", "omega wave_direction", unit="1", short="error/largest", shown=".1e",
        variable="response_relative_error", note="smaller motions, rotations and partial waves may have a larger error "
            "relative to themselves", contract=False),
    LARGEST := _largest("largest", "largest motion", "wave dof", unit="m/m", of_roll=("rad/m",)),
    LARGEST_REFLECTION := _largest("largest_reflection", "largest reflection of each wave into itself", "wave",
        unit="1", note="`null` of solids of revolution"),
    PLATES,
    HULLS,
    Group("missed_peaks", "resonances between two frequencies that the curve does not show", (
        Quantity("below", "frequency below", "rad/s"),
        Quantity("above", "frequency above", "rad/s"),
        Quantity("omega", "frequency of the extreme", "rad/s"),
        Quantity("quantity", "a motion, `|R|` or `|T|`"),
        Quantity("value", "its magnitude there", "m/m or, of roll, rad/m"),
        Quantity("drawn", "that of the straight line between the two", "m/m or, of roll, rad/m"),
    ), dimension="missed_peak", prefix="missed_peak",
        note="those that differ by a tenth of the largest or more, of sweeps of more than six frequencies"),
), record=_responses, dimension="response_analysis")
RESONANCE = Group("resonance", "resonances e^{−iωt}, by analysis", (
    own_array("resonance", "number of the resonance", "resonance",
        lambda table: np.arange(1, len(table.omega) + 1, dtype=np.int32), column="resonance"),
    Quantity("labels", "dominant motion of a resonance", dimensions=("resonance",), variable="", column="label"),
    own_array("resonance_motion", "dominant motion of a resonance", "resonance",
        lambda table: np.array([dof.capitalised for dof in table.labels], dtype=np.str_)),
    RESONANCE_OMEGA := joined_array("omega", "complex frequency of a resonance", "resonance", unit="rad/s", symbol="ω",
        variable="resonance_omega", note="with Im ω < 0"),
    DOFS,
    named_dofs("dof"),
    joined_array("body_amplitudes", "motion in a resonance, the dominant one 1", "resonance dof", unit="1",
        variable="resonance_amplitude", column=""),
    RESONANCE_ERROR := joined_array("relative_error", "estimated relative error of the frequency of a resonance",
        "resonance", unit="1", shown=".1e", variable="resonance_relative_error", contract=False),
    joined_array("residuals", "relative residual of the equations", "resonance", unit="1", shown=".1e",
        variable="resonance_residual", column="residual", contract=False),
    Quantity("counted", "number of resonances in the region by an independent count", "1", note="`null` if not",
        contract=False),
    Quantity("region", "region of ω in which they were counted", value=lambda table: region_words(table.region),
        contract=False),
    Quantity("not_sought", "frequency of the lowest elastic tone that was not sought, as its waves are far shorter "
        "than the body; `below` has it sought", "rad/s", note="`null` if all were sought", contract=False),
), dimension="resonance_analysis", note=NUMBERED)
DECAY = Group("decay", "motion after release, by analysis", (
    DECAY_TIMES := joined_array("times", "time after release", "time", unit="s", symbol="t", shown=".6g",
        variable="time", column="time"),
    DOFS,
    named_dofs("dof"),
    DISPLACEMENT := joined_array("displacement", "motion after release", "time dof", variable="decay_displacement",
        column="", **_MOTION),
    INITIAL := joined_array("initial", "motion at release", "dof", variable="decay_initial", **_MOTION),
    DECAY_ERROR := joined_array("absolute_error", "estimated error of the motion after release", "time",
        variable="decay_absolute_error", shown=".1e", **_MOTION, contract=False),
    joined_array("tail", "asymptotic coefficient of 1/t^2, or of 1/t^4 if that is `tail_power`", "",
        variable="decay_tail", unit="m s^2", of_roll=("rad s^2",), note="`null` where no tail is known"),
    joined_array("tail_power", "power of the tail: 4 about an axis in deep water, else 2", "", unit="1",
        variable="decay_tail_power"),
    joined_array("certified_until", "time to which the error of the motion after release holds", "", unit="s",
        variable="decay_certified_until"),
), dimension="decay_analysis", note=NUMBERED)


def _of_scene(key: str, meaning: str, value: Callable[[Any], Any], unit: str | None = None) -> Quantity:
    return Quantity(key, meaning, unit, value=lambda it: value(it.tank), in_summary=False, is_coordinate=True)


OPEN_WATER = Group("", "open water", (
    BODIES, RADIATION, RESPONSE, RESONANCE, DECAY, SPECTRUM, IMPULSE_RESPONSE, MOTION, ESTIMATES,
    SIZE := Group("size", "size of the largest problem", (
        CELLS := Quantity("cells", "number of cells", "1"),
        DOFS := Quantity("dofs", "number of unknowns of ψ", "1"),
        DEGREE := Quantity("degree", "degree of the polynomials", "1"),
        PROCESSES,
    ), contract=False),
    _of_scene("g", "gravity", lambda tank: tank.gravity, "m/s^2"),
    _of_scene("rho", "density of the lower liquid", lambda tank: tank.layers[0].density, "kg/m^3"),
    _of_scene("water_depth", "depth of the lower liquid", lambda tank: tank.layers[0].depth, "m"),
    _of_scene("rho_upper", "density of the upper liquid", lambda tank: _upper(tank, "density"), "kg/m^3"),
    _of_scene("depth_upper", "depth of the upper liquid", lambda tank: _upper(tank, "depth"), "m"),
    _of_scene("body_name", "bodies", lambda tank: "+".join(map(body_name, range(1, len(tank.bodies) + 1)))),
))


def _upper(tank: Any, name: str) -> float | None:
    return getattr(tank.layers[1], name) if len(tank.layers) > 1 else None
