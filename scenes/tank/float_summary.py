"""Rigid floats in a summary: hydrostatics, added mass at infinite frequency, modes, and growing motions."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydroelastic.fem.tank.elastic_tone import added_mass, mode_kind
from hydroelastic.fem.tank.float_modes import FloatMode
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.modal.estimate import difference
from hydroelastic.modal.floats.tank_estimates import EstimatesOfFloat


def float_rows(solution: TankSolution, estimates: dict[int, EstimatesOfFloat]) -> list[dict[str, Any]]:
    """One entry for each float, SI units.

    Args:
        solution: the field solution.
        estimates: estimates by the theories, by index of the float.
    """
    return [_float_row(solution, index, estimates.get(index)) for index in solution.tank.rigid]


def _float_row(solution: TankSolution, index: int, estimates: EstimatesOfFloat | None) -> dict[str, Any]:
    modes = [_mode(solution, mode) for mode in solution.float_modes if mode.body == index]
    body = solution.physical.floats[index]
    rest = body.hydrostatics
    return {
        "body": index + 1,
        "motions": list(body.motions),
        "boundary": "thin" if body.hull.is_thin else "exact",
        "mass": rest.mass,
        "moment_of_inertia": rest.mass * rest.radius_of_gyration**2,
        "centre_of_mass": list(rest.centre_of_mass),
        "reference_level": rest.reference_level,
        "waterplane": list(rest.waterplane),
        "heave_stiffness": rest.heave_stiffness,
        "coupling_stiffness": rest.coupling_stiffness,
        "roll_stiffness": rest.roll_stiffness,
        "high_frequency": _high_frequency(solution, index),
        "modes": modes,
        "estimates": _compared(estimates, modes) if estimates is not None else {},
        "printed_constants": _printed(estimates) if estimates is not None else {},
    }


def _compared(estimates: EstimatesOfFloat, modes: list[dict[str, Any]]) -> dict[str, Any]:
    """Each estimate of heave and its relative difference from the mode of heave of the field solution."""
    heave: dict[str, Any] = next((mode for mode in modes if mode["motion"] == "heave"), {})
    return {
        name: {
            "omega": estimate.omega,
            "added_mass": estimate.added_mass,
            "difference": difference(estimate.omega, heave.get("omega")),
            "added_mass_difference": difference(estimate.added_mass, heave.get("added_mass")),
            "note": estimate.note,
        }
        for name, estimate in estimates.heave.items()
    }


def _printed(estimates: EstimatesOfFloat) -> dict[str, Any]:
    return {name: {"printed": value.printed, "corrected": value.corrected} for name, value in estimates.printed.items()}


def _high_frequency(solution: TankSolution, index: int) -> dict[str, Any] | None:
    """Added mass of heave and sway in kg/m, inertia of roll in kg·m, coupling of roll in kg."""
    if solution.added_mass is None:
        return None
    turns = solution.tank.floats[index].is_rotation
    units = solution.units.density * solution.units.length ** (2.0 + turns[:, None] + turns)
    matrix = solution.added_mass.block(solution.tank, index) * units
    return {"added_mass": matrix.tolist(), "relative_error": solution.added_mass.error}


def _mode(solution: TankSolution, mode: FloatMode) -> dict[str, Any]:
    """The mode of one motion; its added mass is k/ω² − m, the inertia of the liquid at that frequency."""
    row: dict[str, Any] = {
        "motion": mode.motion,
        "index": None,
        "omega": None,
        "relative_error": None,
        "modal_mass": None,
        "runner_up_modal_mass": None,
        "shared": None,
        "added_mass": None,
        "added_mass_relative_error": None,
        "note": mode.reason,
    }
    if mode.index is None:
        return row
    unit = solution.units.density * solution.units.length ** (4.0 if mode.motion.is_rotation else 2.0)
    eigenvalue = float(solution.modes.eigenvalues[mode.index])
    error = float(solution.relative_errors[mode.index])
    added, added_error = added_mass(mode.stiffness, mode.inertia, eigenvalue, error)
    row.update(
        index=mode.index + 1,
        omega=solution.omega(eigenvalue),
        relative_error=error,
        modal_mass=mode.modal_mass * unit,
        runner_up_modal_mass=mode.runner_up * unit if np.isfinite(mode.runner_up) else None,
        shared=mode.is_shared,
        added_mass=added * unit,
        added_mass_relative_error=added_error,
        note="shared with waves or other bodies: no single mode represents this motion" if mode.is_shared else "",
    )
    return row


def growing_rows(solution: TankSolution) -> list[dict[str, Any]]:
    """The motions of unstable floats, e^{σt}, fastest first."""
    rows = [
        {
            "growth_rate": solution.omega(-mode.eigenvalue),
            "relative_error": float(error),
            "symmetry": solution.field.parts[part].parity,
            "kind": mode_kind(mode, solution.field.bodies, solution.field.surfaces),
        }
        for mode, part, error in zip(
            solution.modes.growing, solution.field.growing_parts, solution.growing_errors, strict=True
        )
    ]
    return sorted(rows, key=lambda row: -row["growth_rate"])
