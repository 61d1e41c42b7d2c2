"""Quantities of a tank in three dimensions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, pi
from typing import Any, Protocol

import numpy as np

from hydroelastic.fem.closed.tones import added_mass_of, mode_kinds
from hydroelastic.fem.level_bed.solution import LevelMode, LevelSolution, PlateTone
from hydroelastic.fem.mode_set import bending_fractions
from hydroelastic.modal.estimate import difference
from hydroelastic.modal.plate.closed_forms import ExactMode
from hydroelastic.modal.plate.estimates import PlateEstimate
from hydroelastic.output.level_tank.floats import FLOATS, FloatAtRest
from hydroelastic.output.provenance import PROCESSES, largest_memory
from hydroelastic.output.quantities import Group, Quantity, array


class EstimatedLevelTank(Protocol):
    """What the quantities are taken from."""

    @property
    def tank(self) -> LevelSolution:
        """The field solution."""

    @property
    def floats(self) -> Sequence[FloatAtRest]:
        """The floats with draught at rest."""

    @property
    def exact(self) -> Sequence[ExactMode]:
        """Frequencies of a closed form."""

    @property
    def estimates(self) -> Sequence[PlateEstimate]:
        """Estimates of motions of the plates."""


@dataclass(frozen=True, kw_only=True)
class ShownMode:
    """One mode in SI units."""

    omega: float
    one: LevelMode


def _modes(result: EstimatedLevelTank) -> Iterator[ShownMode]:
    return (ShownMode(omega=result.tank.omega(one.mode.eigenvalue), one=one) for one in result.tank.modes)


def _kind(mode: ShownMode) -> str:
    return mode_kinds(mode.one.mode.energy[None], mode.one.bodies, mode.one.problem.pencil.surfaces)[0]


def _tones(result: EstimatedLevelTank) -> Iterator[dict[str, Any]]:
    return (_tone(result.tank, tone) for tone in result.tank.tones)


def _tone(solution: LevelSolution, tone: PlateTone) -> dict[str, Any]:
    found: dict[str, Any] = {
        "body": tone.plate + 1,
        "order": tone.order,
        "dry_omega": solution.omega(tone.dry) if isfinite(tone.dry) else None,
        "pressure_release_omega": None if tone.pressure_release is None else solution.omega(tone.pressure_release),
        "pressure_release_relative_error": tone.pressure_release_error,
        **dict.fromkeys(_OF_TONE),
        "note": tone.reason,
    }
    if tone.tone is None or tone.eigenvalue is None or tone.relative_error is None:
        return found
    added, error = added_mass_of(tone.stiffness, tone.mass, tone.eigenvalue, tone.relative_error)
    values = [
        number
        for number, one in enumerate(solution.modes, 1)
        if one.problem.order == tone.order and abs(one.mode.eigenvalue / tone.eigenvalue - 1.0) < _SAME
    ]
    return found | {
        "omega": solution.omega(tone.eigenvalue),
        "relative_error": tone.relative_error,
        "index": values[0] if values else None,
        "index_in_order": tone.tone.index + 1,
        "participation": tone.tone.participation,
        "runner_up": tone.tone.runner_up,
        "shared": tone.tone.is_shared,
        "one_mode": tone.tone.is_of_one_mode,
        "added_mass_per_area": added / tone.squares * solution.units.mass_per_length,
        "added_mass_relative_error": error,
        "note": "the tone is shared between hybrid modes; see the pressure-release tone" if tone.tone.is_shared else "",
    }


_OF_TONE = (
    "omega",
    "relative_error",
    "index",
    "index_in_order",
    "participation",
    "runner_up",
    "shared",
    "one_mode",
    "added_mass_per_area",
    "added_mass_relative_error",
)
# Modes of one order whose λ agree so well are one.
_SAME = 1e-4


def _first(result: EstimatedLevelTank) -> dict[str, Any] | None:
    return next(_tones(result), None)


def _estimates(result: EstimatedLevelTank) -> dict[str, dict[str, Any]]:
    """The estimates by name; those of the second and further plates have its number behind the name."""
    tones = {tone["body"]: tone for tone in _tones(result)}
    # Of several plates a mode does not tell which one heaves.
    single = len(result.tank.tank.plates) == 1
    rigid = {_kind(shown): shown.omega for shown in reversed(list(_modes(result)))} if single else {}
    found = {}
    for one in result.estimates:
        tone = tones.get(one.plate + 1, {}) if one.motion == "elastic" else {"omega": rigid.get(one.motion)}
        found[one.name if one.plate == 0 else f"{one.name}_{one.plate + 1}"] = {
            "body": one.plate + 1,
            "motion": one.motion,
            "omega": one.omega,
            "added_mass_per_area": one.added_mass_per_area,
            "difference": difference(one.omega, tone.get("omega")),
            "difference_to_pressure_release": difference(one.omega, tone.get("pressure_release_omega")),
            "note": one.note,
        }
    return found


def _exact(result: EstimatedLevelTank) -> Iterator[dict[str, Any]]:
    for one, exact in zip(_modes(result), result.exact, strict=False):
        yield {
            "formula": exact.formula,
            "order": exact.order,
            "omega": exact.omega,
            "difference": one.omega / exact.omega - 1.0,
        }


# fmt: off
# A table: as many arguments on a line as fit.
MODES = Group("modes", "natural modes by ascending frequency", (
    MODE_OMEGA := Quantity("omega", "natural frequency", "rad/s", "ω", error="relative_error", digits=12,
        variable="omega"),
    FREQUENCY := Quantity("frequency_hz", "frequency of a mode", "Hz", "f", value=lambda it: it.omega / (2.0 * pi),
        shown=".6g"),
    RELATIVE_ERROR := Quantity("relative_error", "estimated relative error", "1",
        value=lambda it: it.one.relative_error, shown=".1e", contract=False),
    ORDER := Quantity("order", "order", "1", "n", value=lambda it: it.one.problem.order,
        note="of cos nθ about the axis, of cos nπy/B across a box; `null` where it is not separated"),
    SYMMETRY := Quantity("symmetry", "symmetry", value=lambda it: it.one.problem.symmetry, printed=False,
        note='`""` where none is used'),
    MULTIPLICITY := Quantity("multiplicity", "multiplicity", "1", value=lambda it: it.one.problem.multiplicity,
        note="2 of modes that may be turned about the axis, cos nθ and sin nθ"),
    KIND := Quantity("kind", "kind", value=_kind, note="what has most of the potential energy"),
    BENDING := Quantity("elastic_energy_fraction", "bending energy over the potential energy", "1",
        short="bending energy", value=lambda it: float(bending_fractions([it.one.mode], it.one.bodies)[0]),
        shown=".3f"),
    Quantity("residual", "relative residual of the eigenpair", "1", value=lambda it: it.one.mode.residual,
        printed=False, contract=False),
), record=_modes, dimension="mode", prefix="mode")
_TONE_PARTS = (
    TONE_BODY := Quantity("body", "number of the plate", "1"),
    Quantity("order", "order of its lowest elastic dry mode", "1", "n"),
    TONE_OMEGA := Quantity("omega", "frequency of the first elastic tone", "rad/s", "ω", error="relative_error"),
    Quantity("relative_error", "estimated relative error of the tone", "1", shown=".1e", contract=False),
    TONE_INDEX := Quantity("index", "number of the tone among the modes", "1", note="`null` if it lies above them"),
    Quantity("index_in_order", "number of the tone among the modes of its order", "1"),
    Quantity("participation", "participation of the first dry mode", "1", "p", shown=".3f"),
    Quantity("runner_up", "next largest participation", "1", shown=".3f"),
    Quantity("shared", "whether hybrid modes share the tone"),
    Quantity("one_mode", "whether the tone is attributed to one mode", printed=False),
    Quantity("added_mass_per_area", "added mass per area of the first dry mode", "kg/m^2", "m_a",
        error="added_mass_relative_error", note="(stiffness/ω² − mass) over ∫W²"),
    Quantity("added_mass_relative_error", "estimated relative error of the added mass", "1", shown=".1e",
        printed=False, contract=False),
    Quantity("dry_omega", "frequency of the dry mode with the hydrostatic restoring", "rad/s",
        note="`null` without mass"),
    Quantity("pressure_release_omega", "frequency with ψ = 0 on the water", "rad/s",
        error="pressure_release_relative_error", note="`null` without open water"),
    Quantity("pressure_release_relative_error", "estimated relative error of that frequency", "1", shown=".1e",
        printed=False, contract=False),
    TONE_NOTE := Quantity("note", "remark", printed=False),
)
FIRST_ELASTIC = Group("first_elastic", "first elastic tone of the first elastic plate", _TONE_PARTS, record=_first)
TONES = Group("first_elastic_by_body", "first elastic tone of each elastic plate", _TONE_PARTS, record=_tones,
    dimension="elastic_plate", prefix="elastic_plate")
ESTIMATES = Group("estimates", "estimates of the first elastic tone of plates, and of heave and pitch of rigid ones", (
    Quantity("body", "number of the plate", "1", short="plate"),
    Quantity("motion", "motion that is estimated", short="motion"),
    Quantity("omega", "estimated frequency", "rad/s", "ω", shown=".6g"),
    Quantity("added_mass_per_area", "estimated added mass per area", "kg/m^2", "m_a", shown=".6g"),
    Quantity("difference", "relative difference from the tone or the mode", "1", "Δω/ω", shown="+.2e"),
    Quantity("difference_to_pressure_release", "relative difference from the pressure-release tone", "1", "Δω/ω₀",
        shown="+.2e"),
    ESTIMATE_NOTE := Quantity("note", "what it is", printed=False),
), record=_estimates, dimension="estimate")
EXACT = Group("exact", "frequencies of a closed form", (
    FORMULA := Quantity("formula", "formula", printed=False),
    Quantity("order", "order", "1", "n"),
    Quantity("omega", "exact frequency", "rad/s", "ω", shown=".12g"),
    Quantity("difference", "relative difference of the solution", "1", shown="+.1e", contract=False),
), record=_exact, dimension="exact_mode")
SOLVER = Group("solver", "how the modes were found", (
    MODEL := Quantity("model", "how the plan is solved", value=lambda tank: tank.model),
    COUNT_CONFIRMED := Quantity("count_confirmed_by_inertia", "whether an independent count confirms the modes",
        value=lambda tank: tank.counted, note="by what, `count_method` tells"),
    COUNT_METHOD := Quantity("count_method", "what confirms the number of modes",
        note='`"inertia"` of the matrices of a coarser model; of large volumes residuals and a second start'),
    LARGEST_RESIDUAL := Quantity("largest_residual", "largest residual of a mode", "1",
        value=lambda tank: tank.residual, shown=".1e"),
), record=lambda it: it.tank, contract=False)
SIZE = Group("size", "size of the problem", (
    PROBLEMS := Quantity("problems", "orders or symmetry classes that were solved, each a problem of its own", "1"),
    DEGREE := Quantity("degree", "polynomial degree of ψ", "1"),
    LAYERS := Quantity("layers", "layers at each edge", "1"),
    POLES := Quantity("poles", "poles of the depth; 0 where it is exact", "1"),
    Quantity("cells", "tetrahedra of a volume; 0 of other models", "1", value=lambda size: size.get("cells", 0)),
    Quantity("iterations",
        "iterations of each solution of Laplace's equation by multigrid, in the mean; 0 of a factorization", "1",
        value=lambda size: size.get("iterations", 0)),
    DOFS := Quantity("dofs", "unknowns of all problems", "1"),
    Quantity("surface_unknowns", "unknowns of plates and water", "1"),
    Quantity("plate_shapes", "dry modes of the plates, of all problems", "1"),
    PROCESSES,
    MEMORY_OF_A_PROCESS := Quantity("memory_of_a_process", "largest memory of one process", "byte",
        value=lambda _: largest_memory()),
), record=lambda it: it.tank.size, contract=False)
# Of the patches and elevations, a `output.level_tank.sample.SampledModes`.
_ARRAYS = (
    array("point", "number of a place", None, "point", lambda it: np.arange(len(it.sample.points), dtype=np.int32),
        contract=False),
    array("shape", "mode, with the second one of a pair after the first", None, "shape",
        lambda it: np.array(it.sample.names)),
    array("x", "x of a place on the still surface", "m", "point", lambda it: it.sample.points[:, 0]),
    array("y", "y of a place on the still surface", "m", "point", lambda it: it.sample.points[:, 1]),
    array("plate", "number of the plate at a place, 0 for water", None, "point", lambda it: it.sample.plate_of_points),
    array("elevation", "upward displacement of plate or water in a mode", "m", "shape point",
        lambda it: it.sample.elevations),
)
LEVEL_TANK = Group("", "a tank in three dimensions", (
    FLOATS,
    MODES,
    ZERO_MODES := Quantity("zero_modes", "motions without stiffness", "1", value=lambda it: it.tank.zero_modes),
    FIRST_ELASTIC, TONES, ESTIMATES, EXACT, SOLVER, SIZE, *_ARRAYS,
))
