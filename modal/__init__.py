"""Closed forms and estimates of the older theories: NumPy and SciPy only."""

from hydroelastic.modal.beam.added_mass import (
    deep_open_added_mass,
    deep_open_constant,
    lid_added_mass,
    rigid_heave_added_mass,
    rigid_pitch_added_inertia,
    shallow_added_mass,
    shallow_constant,
    strip_added_mass,
)
from hydroelastic.modal.beam.dry_modes import free_free_roots, free_free_shape, free_free_wavenumber
from hydroelastic.modal.beam.estimates import all_estimates
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.grammel import BeamQuotients, QuotientPair, beam_quotients, quotients
from hydroelastic.modal.beam.grammel_terms import best_term, one_term_root, term_tones
from hydroelastic.modal.beam.gravity_added_mass import gravity_added_mass, gravity_tones
from hydroelastic.modal.beam.paper_model import ERRATA, Erratum, PrintedAndCorrected
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.rayleigh import (
    pressure_release_tones,
    rayleigh,
    rayleigh_dry_mode,
    rayleigh_lid,
    rayleigh_pressure_release,
    rayleigh_pressure_release_dry_mode,
)
from hydroelastic.modal.beam.tone_pencil import Tones
from hydroelastic.modal.estimate import (
    Bound,
    Estimate,
    NoEstimateError,
    added_mass_from_frequency,
    frequency_from_added_mass,
    paper_equivalent_mass,
)
from hydroelastic.modal.floats.box import BoxModes, FloatMode, box_modes, float_mode
from hydroelastic.modal.floats.channel_motion import channel_free_motion, channel_resonance
from hydroelastic.modal.floats.estimates import FloatEstimate, all_float_estimates
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.open_float import OpenFloatEstimate, open_float_estimate, released_float
from hydroelastic.modal.floats.rigid_limits import (
    RigidAddedMass,
    half_immersed_ellipse,
    interface_ellipse,
    section_heave_added_mass,
)
from hydroelastic.modal.floats.thin_float import (
    ThinConstants,
    thin_constants,
    thin_float_added_mass,
    thin_float_frequency,
    thin_float_mass,
    thin_float_stiffness,
)
from hydroelastic.modal.floats.thin_float_decay import FreeMotion, crossover_time, free_motion, free_motion_tail
from hydroelastic.modal.floats.thin_float_paper import THIN_FLOAT_ERRATA, printed_constants
from hydroelastic.modal.floats.thin_float_radiation import HeaveRadiation, complex_added_mass, thin_float_radiation
from hydroelastic.modal.floats.thin_float_resonance import FreePole, heave_pole, pole_count, second_pole
from hydroelastic.modal.liquid.sloshing import (
    deep_sloshing_frequencies,
    guided_cover_frequencies,
    shallow_sloshing_frequencies,
    sloshing_frequencies,
)
from hydroelastic.modal.liquid.two_layer import (
    Branch,
    InterfacePlate,
    LayerMode,
    LayerTop,
    TwoLayers,
    interface_frequencies,
    tank_modes,
)
from hydroelastic.modal.roll.decrement import (
    FroudeCoefficients,
    damping_from_froude,
    equivalent_roll_damping,
    fit_froude,
    froude_coefficients,
    linear_decrement,
    quadratic_decrement,
    swing_amplitudes,
)
from hydroelastic.modal.roll.knots import RollPath
from hydroelastic.modal.roll.motion import LinearRollPath, RollMotion, roll_path, roll_response
from hydroelastic.modal.roll.paper import ROLL_ERRATA, RollSlip, paper_roll_angle, printed_roll_constants
from hydroelastic.modal.roll.quadratic import QuadraticRollPath, RollIntegrationError, quadratic_roll_path
from hydroelastic.modal.roll.statistics import RollStatistics, roll_statistics
from hydroelastic.modal.string.paper import STRING_ERRATA
from hydroelastic.modal.string.partial_sum import partial_sum
from hydroelastic.modal.string.resonance import StringResonance, nearest_resonance, string_resonance
from hydroelastic.modal.string.response import StringResponse, string_response
from hydroelastic.physics.profiles import FloatShape, Profile, ProfileArc, float_profile
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Motion, Ramp, Sine, Smooth, Step, TabulatedMotion, sampled, tabulated
from hydroelastic.physics.wave import WaveTrain

__all__ = [
    "ERRATA",
    "ROLL_ERRATA",
    "STRING_ERRATA",
    "THIN_FLOAT_ERRATA",
    "BeamQuotients",
    "Bound",
    "BoxModes",
    "Branch",
    "Erratum",
    "Estimate",
    "FloatEstimate",
    "FloatInTank",
    "FloatMode",
    "FloatShape",
    "FloatingBeam",
    "FreeMotion",
    "FreePole",
    "FroudeCoefficients",
    "HangingString",
    "HeaveRadiation",
    "InterfacePlate",
    "LayerMode",
    "LayerTop",
    "LinearRollPath",
    "Motion",
    "NoEstimateError",
    "OpenFloatEstimate",
    "PrintedAndCorrected",
    "Profile",
    "ProfileArc",
    "QuadraticRollPath",
    "QuotientPair",
    "Ramp",
    "RigidAddedMass",
    "RollIntegrationError",
    "RollMotion",
    "RollPath",
    "RollSlip",
    "RollStatistics",
    "Ship",
    "Sine",
    "Smooth",
    "Step",
    "StringResonance",
    "StringResponse",
    "TabulatedMotion",
    "ThinConstants",
    "Tones",
    "TwoLayers",
    "WaveTrain",
    "added_mass_from_frequency",
    "all_estimates",
    "all_float_estimates",
    "beam_quotients",
    "best_term",
    "box_modes",
    "channel_free_motion",
    "channel_resonance",
    "complex_added_mass",
    "crossover_time",
    "damping_from_froude",
    "deep_open_added_mass",
    "deep_open_constant",
    "deep_sloshing_frequencies",
    "equivalent_roll_damping",
    "fit_froude",
    "float_mode",
    "float_profile",
    "free_free_roots",
    "free_free_shape",
    "free_free_wavenumber",
    "free_motion",
    "free_motion_tail",
    "frequency_from_added_mass",
    "froude_coefficients",
    "gravity_added_mass",
    "gravity_tones",
    "guided_cover_frequencies",
    "half_immersed_ellipse",
    "heave_pole",
    "interface_ellipse",
    "interface_frequencies",
    "lid_added_mass",
    "linear_decrement",
    "nearest_resonance",
    "one_term_root",
    "open_float_estimate",
    "paper_equivalent_mass",
    "paper_roll_angle",
    "partial_sum",
    "pole_count",
    "pressure_release_added_mass",
    "pressure_release_tones",
    "printed_constants",
    "printed_roll_constants",
    "quadratic_decrement",
    "quadratic_roll_path",
    "quotients",
    "rayleigh",
    "rayleigh_dry_mode",
    "rayleigh_lid",
    "rayleigh_pressure_release",
    "rayleigh_pressure_release_dry_mode",
    "released_float",
    "rigid_heave_added_mass",
    "rigid_pitch_added_inertia",
    "roll_path",
    "roll_response",
    "roll_statistics",
    "sampled",
    "second_pole",
    "section_heave_added_mass",
    "shallow_added_mass",
    "shallow_constant",
    "shallow_sloshing_frequencies",
    "sloshing_frequencies",
    "string_resonance",
    "string_response",
    "strip_added_mass",
    "swing_amplitudes",
    "tabulated",
    "tank_modes",
    "term_tones",
    "thin_constants",
    "thin_float_added_mass",
    "thin_float_frequency",
    "thin_float_mass",
    "thin_float_radiation",
    "thin_float_stiffness",
]
