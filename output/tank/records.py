"""Values of the quantities of a closed tank by key, in SI units, from its dimensionless solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.closed.tones import FloatMode, added_mass_of, mode_kinds
from hydroelastic.fem.mode_set import bending_fractions
from hydroelastic.fem.tank.solve import TankSolution, ToneSolution
from hydroelastic.modal.beam.beam_shapes import first_dry_eigenvalue
from hydroelastic.modal.estimate import Estimate, difference
from hydroelastic.modal.tank_estimates import exact_frequencies
from hydroelastic.output.quantities import Values
from hydroelastic.physics.dofs import FIRST_ELASTIC

if TYPE_CHECKING:
    from hydroelastic.modal.floats.estimates import FloatEstimate


def natural_modes(solution: TankSolution) -> list[Values]:
    """Return the modes asked for."""
    rows = []
    field = solution.field
    kinds = mode_kinds(np.array([mode.energy for mode in solution.asked]), field.bodies, field.surfaces)
    fractions = bending_fractions(solution.asked, field.bodies)
    for index, mode in enumerate(solution.asked):
        omega = solution.omega(mode.eigenvalue)
        rows.append(
            {
                "omega": omega,
                "frequency_hz": solution.units.hertz(omega / solution.units.frequency),
                "relative_error": float(solution.relative_errors[index]),
                "kind": kinds[index],
                "symmetry": field.parity(index),
                "elastic_energy_fraction": float(fractions[index]),
                "residual": mode.residual,
            }
        )
    return rows


def first_elastic_tone(solution: TankSolution, tone: ToneSolution) -> Values:
    """Return the first elastic tone of a beam; what is not known is left out."""
    beam = solution.tank.beams[tone.body]
    found: Values = {
        "body": tone.body + 1,
        "dry_omega": solution.omega(first_dry_eigenvalue(beam)),
        "pressure_release_relative_error": tone.pressure_release_error,
        "note": tone.reason,
    }
    if tone.pressure_release is not None:
        found["pressure_release_omega"] = solution.omega(tone.pressure_release)
    if tone.tone is not None:
        eigenvalue = float(solution.modes.eigenvalues[tone.tone.index])
        error = float(solution.relative_errors[tone.tone.index])
        # Dry mode 1 of the body, in units of the tank: EI κ⁴ l, (EI κ⁴ + s) l and m l.
        shapes = solution.field.bodies[tone.body]
        first = shapes.dofs.index(FIRST_ELASTIC)
        added, added_error = added_mass_of(shapes.stiffness[first], shapes.mass[first, first], eigenvalue, error)
        found |= {
            "omega": solution.omega(eigenvalue),
            "relative_error": error,
            "index": tone.tone.index + 1,
            "participation": tone.tone.participation,
            "runner_up": tone.tone.runner_up,
            "shared": tone.tone.is_shared,
            "one_mode": tone.tone.is_of_one_mode,
            "first_sharing_mode": tone.tone.sharing[0] + 1,
            "last_sharing_mode": tone.tone.sharing[1] + 1,
            "added_mass_per_length": float(added) * solution.units.mass_per_length / beam.length,
            "added_mass_relative_error": float(added_error),
        }
        if tone.tone.is_shared:
            found["note"] = "the tone is shared between hybrid modes; see the pressure-release tone"
    return found


def float_values(solution: TankSolution, index: int, estimates: dict[str, FloatEstimate] | None) -> Values:
    """Return hydrostatics, added mass and modes of a float, its estimates beside its mode of heave."""
    body = solution.physical.floats[index]
    modes = [_float_mode(solution, mode) for mode in solution.float_modes if mode.body == index]
    heave: Values = next((mode for mode in modes if mode["motion"] == "heave"), {})
    return {
        **vars(body.hydrostatics),
        "body": index + 1,
        "motions": list(body.motions),
        "boundary": "thin" if body.hull.is_thin else "exact",
        "moment_of_inertia": body.hydrostatics.mass * body.hydrostatics.radius_of_gyration**2,
        "high_frequency": _high_frequency(solution, index),
        "modes": modes,
        "estimates": {
            name: {
                **vars(estimate),
                "difference": difference(estimate.omega, heave.get("omega")),
                "added_mass_difference": difference(estimate.added_mass, heave.get("added_mass")),
            }
            for name, estimate in (estimates or {}).items()
        },
    }


def _high_frequency(solution: TankSolution, index: int) -> Values | None:
    if solution.added_mass is None:
        return None
    turns = solution.tank.floats[index].is_rotation
    units = solution.units.density * solution.units.length ** (2.0 + turns[:, None] + turns)
    matrix = solution.added_mass.block(solution.tank, index) * units
    return {"added_mass": matrix, "relative_error": solution.added_mass.error}


def _float_mode(solution: TankSolution, mode: FloatMode) -> Values:
    found: Values = {"motion": str(mode.motion), "note": mode.reason}
    if mode.index is not None:
        unit = solution.units.density * solution.units.length ** (4.0 if mode.motion.is_rotation else 2.0)
        eigenvalue = float(solution.modes.eigenvalues[mode.index])
        error = float(solution.relative_errors[mode.index])
        added, added_error = added_mass_of(mode.stiffness, mode.inertia, eigenvalue, error)
        found |= {
            "index": mode.index + 1,
            "omega": solution.omega(eigenvalue),
            "relative_error": error,
            "modal_mass": mode.modal_mass * unit,
            "runner_up_modal_mass": mode.runner_up * unit if np.isfinite(mode.runner_up) else None,
            "shared": mode.is_shared,
            "added_mass": added * unit,
            "added_mass_relative_error": added_error,
        }
        if mode.is_shared:
            found["note"] = "shared with waves or other bodies: no single mode represents this motion"
    return found


def growing_motions(solution: TankSolution) -> list[Values]:
    """Return the motions of unstable floats, e^{σt}, fastest first."""
    field, modes = solution.field, solution.modes.growing
    rows = [
        {
            "growth_rate": solution.omega(-mode.eigenvalue),
            "relative_error": float(error),
            "symmetry": field.parts[part].parity,
            "kind": kind,
        }
        for mode, (part, _), error, kind in zip(
            modes,
            field.growing_origins,
            solution.growing_errors,
            mode_kinds(np.array([mode.energy for mode in modes]), field.bodies, field.surfaces),
            strict=True,
        )
    ]
    return sorted(rows, key=lambda row: -row["growth_rate"])


def compared(solution: TankSolution, estimates: dict[str, Estimate]) -> dict[str, Values]:
    """Return each estimate beside the first elastic tone of the first beam, by name."""
    first = first_elastic_tone(solution, solution.tones[0]) if solution.tones and estimates else {}
    return {name: _estimate(solution, estimate, first) for name, estimate in estimates.items()}


def _estimate(solution: TankSolution, estimate: Estimate, first: Values) -> Values:
    return {
        **vars(estimate),
        "difference": difference(estimate.omega, first.get("omega")),
        "added_mass_difference": difference(estimate.added_mass_per_length, first.get("added_mass_per_length")),
        "difference_to_pressure_release": difference(estimate.omega, first.get("pressure_release_omega")),
        "bound_mode": estimate.mode_index,
        "bound_holds": _bound_holds(solution, estimate),
    }


def _bound_holds(solution: TankSolution, estimate: Estimate) -> bool | None:
    """Whether an upper bound is above the bounded frequency; ``None`` if unknown or without a bound."""
    if estimate.omega is None or estimate.mode_index is None:
        return None
    number = estimate.mode_index - 1
    if estimate.bound == "above_mode_index":
        values, errors = solution.modes.eigenvalues, solution.relative_errors
    elif estimate.bound == "above_pressure_release_tone" and solution.tones:
        values = np.array(solution.tones[0].pressure_release_values)
        errors = np.full(len(values), solution.tones[0].pressure_release_error or 0.0)
    else:
        return None
    if number >= len(values) or np.isnan(errors[number]):
        return None
    # The field solution is itself an upper bound: its error is allowed for.
    return bool(estimate.omega >= solution.omega(values[number]) * (1.0 - errors[number] - 1e-9))


def exact_modes(solution: TankSolution) -> list[Values]:
    """Return the exact frequencies of the modes asked for, of tanks that have a closed form."""
    formula, frequencies = exact_frequencies(solution.physical, solution.count)
    return [
        {"formula": formula, "omega": exact, "difference": solution.omega(mode.eigenvalue) / exact - 1.0}
        for mode, exact in zip(solution.asked, frequencies, strict=False)
    ]
