"""Quantities of a closed tank: its natural modes, the first elastic tones of its beams, its floats, the estimates.

They are taken from a field solution `tank`, a `fem.closed.section.SectionSolution`, the estimates of its beam by name,
`beam`, and those of its floats by index, `floats`, which may be ``None``. Everything is per metre of width.
"""

from __future__ import annotations

from hydroelastic.output.provenance import PROCESSES
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.tank.records import (
    compared,
    exact_modes,
    float_values,
    growing_motions,
    natural_modes,
    rows,
)
from hydroelastic.output.tank.variables import ARRAYS

# fmt: off
# A table: as many arguments on a line as fit.
NOTE = Quantity("note", "remark", note='or `""`', printed=False)
SYMMETRY = Quantity("symmetry", "symmetry about the middle of the tank", short="symmetry",
    note="of a tank that is its own mirror image")
KIND = Quantity("kind", "what holds most of the potential energy", short="kind",
    note='`"sloshing"`, of two liquids `"interface wave"` or `"surface wave"`; `"heave"`, `"pitch"`, `"sway"`, '
    '`"roll"`; `"elastic"`: bending and hydrostatic energy of the elastic shapes of all beams together')
RELATIVE_ERROR = Quantity("relative_error", "estimated relative error", "1", short="relative error", shown=".1e",
    contract=False)
_ADDED_MASS_ERROR = Quantity("added_mass_relative_error", "estimated relative error of the added mass", "1",
    shown=".1e", contract=False)
MODES = Group("modes", "the modes asked for, in ascending order", (
    MODE_OMEGA := Quantity("omega", "angular frequency of a mode", "rad/s", "ω", error="relative_error"),
    FREQUENCY := Quantity("frequency_hz", "frequency of a mode", "Hz", "f", shown=".6g"),
    RELATIVE_ERROR, KIND, SYMMETRY,
    BENDING := Quantity("elastic_energy_fraction", "part of the potential energy in bending of beams", "1",
        short="bending energy", shown=".3f"),
    Quantity("residual", "relative residual of the equations", "1", "‖Kζ − λ(Mζ + ρCᵀψ)‖/‖Kζ‖ by K⁻¹", printed=False,
        contract=False),
), record=lambda it: natural_modes(it.tank.dataset), dimension="mode", prefix="")
FIRST_ELASTIC_TONES: Group = Group("first_elastic_by_body", "first elastic tone of each beam", (
    TONE_BODY := Quantity("body", "number of the body", "1"),
    DRY_OMEGA := Quantity("dry_omega", "angular frequency of the first bending mode in vacuo", "rad/s", "√(EIκ₁⁴/m)",
        shown=".8g"),
    PRESSURE_RELEASE_OMEGA := Quantity("pressure_release_omega",
        "angular frequency of the tone in the limit of infinite frequency", "rad/s",
        error="pressure_release_relative_error",
        note="with ψ = 0 on the water; ρψ is continuous across an interface; `null` without waves"),
    Quantity("pressure_release_relative_error", "estimated relative error in the limit of infinite frequency", "1",
        contract=False),
    TONE_OMEGA := Quantity("omega", "angular frequency of the first elastic tone", "rad/s", "ω", error="relative_error",
        note="of the mode of largest participation; `null` if no mode represents it, `note` has the reason"),
    RELATIVE_ERROR,
    TONE_INDEX := Quantity("index", "number of the mode", "1", note="may exceed the number of modes asked for"),
    PARTICIPATION := Quantity("participation", "participation of that mode", "1", "(e₁ᵀKφ)²", shown=".3f",
        note="e₁ the first dry mode, φ the mode, both of eᵀKe = 1; over all modes the sum is 1"),
    RUNNER_UP := Quantity("runner_up", "next largest participation", "1", shown=".3f"),
    Quantity("shared", "whether the runner-up exceeds half of the largest participation", "1"),
    ONE_MODE := Quantity("one_mode", "whether one mode represents it", "1",
        note="not shared, or participation at least 0.25"),
    FIRST_SHARING_MODE := Quantity("first_sharing_mode", "first mode with half of the largest participation or more",
        "1"),
    LAST_SHARING_MODE := Quantity("last_sharing_mode", "last mode with half of the largest participation or more", "1"),
    ADDED_MASS_PER_LENGTH := Quantity("added_mass_per_length", "added mass of the first elastic tone", "kg/m^2",
        "(EIκ₁⁴ + sρg)/ω² − m", error="added_mass_relative_error", digits=9),
    _ADDED_MASS_ERROR, NOTE,
),  record=lambda it: map(FIRST_ELASTIC_TONES.with_nulls, rows(it.tank.dataset, "elastic_body", "first_elastic_")),
    dimension="elastic_body", prefix="first_elastic")
_MASS_OF_MOTION = "kg/m or, of roll, kg m"
FLOAT_MODES: Group = Group("modes", "for each motion with restoring force, the mode of its largest participation", (
    MOTION := Quantity("motion", "motion"),
    FLOAT_MODE_INDEX := Quantity("index", "number of the mode", "1"),
    FLOAT_OMEGA := Quantity("omega", "angular frequency of the motion", "rad/s", "ω", error="relative_error"),
    RELATIVE_ERROR,
    MODAL_MASS := Quantity("modal_mass", "2 · kinetic energy/(velocity of the motion)²", _MASS_OF_MOTION, shown=".6g"),
    RUNNER_UP_MODAL_MASS := Quantity("runner_up_modal_mass", "next smallest modal mass", _MASS_OF_MOTION, shown=".6g"),
    Quantity("shared", "whether that is less than twice as large", "1"),
    ADDED_MASS := Quantity("added_mass", "added mass of the motion", _MASS_OF_MOTION, "k/ω² − m",
        error="added_mass_relative_error", digits=9, note="may be negative where the mode is shared with waves"),
    _ADDED_MASS_ERROR, NOTE,
), record=lambda it: map(FLOAT_MODES.with_nulls, it["modes"]), dimension="float_mode", prefix="float_mode")
_DIFFERENCE = Quantity("difference", "relative difference of ω from the field solution", "1", short="to field",
    shown="%")
_ADDED_MASS_DIFFERENCE = Quantity("added_mass_difference", "relative difference of the added mass from it", "1",
    short="to field", shown="%")
ESTIMATE_NOTE = Quantity("note", "assumptions of the theory, or why it has no value", printed=False)
FLOAT_ESTIMATES = Group("estimates", "estimates of heave by older theories, by name", (
    Quantity("omega", "angular frequency of heave by an older theory", "rad/s", "ω", note="or `null`"),
    _DIFFERENCE,
    Quantity("added_mass", "added mass of heave by an older theory", "kg/m", short="added mass"),
    _ADDED_MASS_DIFFERENCE, ESTIMATE_NOTE,
), dimension="float_estimate", prefix="float_estimate")
FLOATS = Group("floats", "each float", (
    FLOAT_BODY := Quantity("body", "number of the body", "1"),
    MOTIONS := Quantity("motions", "motions of the float", dimensions=("float_motion",)),
    BOUNDARY := Quantity("boundary", "boundary condition on the float", note='`"exact"` or `"thin"`'),
    MASS := Quantity("mass", "mass", "kg/m"),
    Quantity("moment_of_inertia", "moment of inertia about the centre of mass", "kg m"),
    Quantity("centre_of_mass", "x and y of the centre of mass", "m", dimensions=("axis",)),
    Quantity("reference_level", "y of the level of the shape", "m"),
    WATERPLANE := Quantity("waterplane", "x of the contact points", "m", dimensions=("side",)),
    HEAVE_STIFFNESS := Quantity("heave_stiffness", "hydrostatic stiffness of heave", "N/m^2", "c33"),
    Quantity("coupling_stiffness", "hydrostatic stiffness of heave with roll", "N/m", "c35"),
    Quantity("roll_stiffness", "hydrostatic stiffness of roll about the centre of mass", "N", "c55"),
    HIGH_FREQUENCY := Group("high_frequency",
        "limit of infinite frequency: ψ = 0 on an open top, ρψ continuous across an interface, beams fixed", (
        HIGH_FREQUENCY_ADDED_MASS := Quantity("added_mass", "added mass in the order of the motions", variable="",
            note="kg/m, of roll kg·m, coupling of roll kg; the dataset has `infinite_frequency_added_mass`"),
        HIGH_FREQUENCY_ERROR := Quantity("relative_error",
            "estimated error of an added mass, of the root of the product of its diagonal entries", "1",
            contract=False),
    ), note="`null` under a lid on one liquid"),
    FLOAT_MODES, FLOAT_ESTIMATES,
),  record=lambda it: [float_values(it.tank, index, (it.floats or {}).get(index)) for index in it.tank.tank.rigid],
    dimension="float", prefix="float")
GROWING = Group("growing", "motions e^{σt} of unstable floats, the fastest first", (
    GROWTH_RATE := Quantity("growth_rate", "growth rate of a motion", "1/s", "σ", error="relative_error"),
    RELATIVE_ERROR, SYMMETRY, KIND,
), record=lambda it: growing_motions(it.tank.dataset), dimension="growing_mode")
ESTIMATES = Group("estimates",
    "estimates of the first elastic tone by [older theories](../theory_aquarium.md), by name", (
    ESTIMATE_OMEGA := Quantity("omega", "angular frequency of the tone by an older theory", "rad/s", "ω",
        note="or `null`"),
    _DIFFERENCE,
    Quantity("added_mass_per_length", "added mass of the tone by an older theory", "kg/m^2", short="added mass"),
    _ADDED_MASS_DIFFERENCE,
    Quantity("difference_to_pressure_release", "relative difference of ω from the limit of infinite frequency", "1",
        printed=False),
    BOUND := Quantity("bound", "what the estimate is not below by theory", short="bound",
        note='`"above_mode_index"`: mode `bound_mode`; `"above_pressure_release_tone"`: that mode with ψ = 0 on the '
        'water; `"none"`'),
    BOUND_MODE := Quantity("bound_mode", "number of the mode that is bounded", "1", printed=False),
    BOUND_HOLDS := Quantity("bound_holds", "whether the bound holds", "1", printed=False, note="`null` if not checked"),
    ESTIMATE_NOTE,
),  record=lambda it: compared(it.tank.dataset, it.beam), dimension="estimate", prefix="estimate",
    note='of one beam with free ends and `top = "free"`, else empty')
TANK = Group("", "a closed tank", (
    MODES,
    ZERO_MODES := Quantity("zero_modes", "number of motions with ω = 0", "1",
        value=lambda it: it.tank.dataset.attrs["zero_modes"]),
    Quantity("first_elastic", "first elastic tone of the first beam, with the keys of the next list",
        value=lambda it: next(map(FIRST_ELASTIC_TONES.evaluated, FIRST_ELASTIC_TONES.of(it)), None), variable="",
        note="`null` without a beam"),
    FIRST_ELASTIC_TONES, FLOATS, GROWING, ESTIMATES,
    EXACT := Group("exact", "each mode of a tank that has a closed form", (
        FORMULA := Quantity("formula", "formula"),
        Quantity("omega", "angular frequency of the exact solution", "rad/s", "ω"),
        EXACT_DIFFERENCE := Quantity("difference", "relative difference of the field solution from the exact one", "1",
            contract=False),
    ), record=lambda it: exact_modes(it.tank), dimension="exact_mode"),
    SOLVER := Group("solver", "the solution of the eigenvalue problem", (
        Quantity("pairs_converged", "number of modes that converged", "1", value=lambda it: it.sizes["mode"]),
        Quantity("pairs_kept", "number of modes kept", "1", value=lambda it: it.attrs["asked"]),
        COUNT_CONFIRMED := Quantity("count_confirmed_by_inertia",
            "whether a count by the inertia of the matrices confirms that no mode is missing",
            value=lambda it: bool(it.attrs["counted"])),
        LARGEST_RESIDUAL := Quantity("largest_residual", "largest residual of the modes", "1",
            value=lambda it: float(it.residual.values[: it.attrs["asked"]].max(initial=0.0)), shown=".1e"),
    ), record=lambda it: it.tank.dataset, contract=False),
    SIZE := Group("size", "size of the problem", (
        CELLS := Quantity("cells", "number of cells", "1", value=lambda it: it["cells"]),
        DOFS := Quantity("dofs", "number of unknowns of ψ and of the surfaces", "1", value=lambda it: it["unknowns"]),
        DEGREE := Quantity("degree", "degree of ψ", "1", value=lambda it: it["degree"]),
        SURFACE_UNKNOWNS := Quantity("surface_unknowns", "number of unknowns of the surfaces", "1",
            value=lambda it: it["surface_unknowns"]),
        PROCESSES,
    ), record=lambda it: it.tank.dataset.attrs, contract=False),
    *ARRAYS,
))
