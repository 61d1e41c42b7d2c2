"""Results of a scene as one JSON-ready value: numbers with their errors, estimates, cost."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.tank.elastic_tone import added_mass, bending_fraction, mode_kind
from hydroelastic.fem.tank.solve import TankSolution, ToneSolution
from hydroelastic.modal.beam.beam_shapes import first_dry_eigenvalue
from hydroelastic.modal.estimate import Estimate, difference
from hydroelastic.modal.tank_estimates import exact_frequencies
from hydroelastic.output.provenance import Summary, complete_summary
from hydroelastic.physics.dofs import FIRST_ELASTIC
from hydroelastic.scenes.tank.solve import EstimatedTank


def summarize(estimated: EstimatedTank, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        estimated: the solution, and the estimates of the first beam's tone and of floats.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    solution = estimated.tank
    # Floats need more of SciPy, which takes a while to import.
    if solution.tank.rigid:
        from hydroelastic.scenes.tank.float_summary import float_rows, growing_rows
    first = _first_elastic(solution)
    content = {
        "modes": _modes(solution),
        "zero_modes": solution.modes.zero_modes,
        "first_elastic": first[0] if first else None,
        "first_elastic_by_body": first,
        "floats": float_rows(solution, estimated.floats or {}) if solution.tank.rigid else [],
        "growing": growing_rows(solution) if solution.tank.rigid else [],
        "estimates": compared(solution, estimated.beam, first[0] if first else {}),
        "exact": _exact(solution),
        "solver": {
            "attempts": solution.attempts,
            "pairs_asked": solution.resolution.modes + 1,
            "pairs_converged": solution.modes.converged,
            "pairs_kept": len(solution.asked),
            "count_confirmed_by_inertia": solution.counted,
            "largest_residual": max((mode.residual for mode in solution.asked), default=0.0),
            "restarts": solution.modes.iterations,
            "laplace_solutions": solution.modes.solves,
        },
    }
    size = {
        "cells": solution.field.mesh.cell_count,
        "dofs": solution.field.dofs,
        "degree": solution.resolution.degree,
        "surface_unknowns": solution.field.surface_unknowns,
        "halves": solution.field.half,
        "beam_shapes": [solution.resolution.shapes[index] for index in solution.tank.elastic],
    }
    return complete_summary(estimated, content, size, comm, import_seconds)


def _modes(solution: TankSolution) -> list[dict[str, Any]]:
    rows = []
    for index, mode in enumerate(solution.asked):
        omega = solution.omega(mode.eigenvalue)
        rows.append(
            {
                "omega": omega,
                "frequency_hz": solution.units.hertz(omega / solution.units.frequency),
                "relative_error": float(solution.relative_errors[index]),
                "symmetry": solution.field.parity(index),
                "kind": mode_kind(mode, solution.field.bodies, solution.field.surfaces),
                "elastic_energy_fraction": bending_fraction(mode, solution.field.bodies),
                "residual": mode.residual,
            }
        )
    return rows


def _exact(solution: TankSolution) -> list[dict[str, Any]]:
    """The exact frequencies of the requested modes, for scenes that have a closed form."""
    formula, frequencies = exact_frequencies(solution.physical, solution.count)
    rows = []
    for mode, exact in zip(solution.asked, frequencies, strict=False):
        rows.append({"formula": formula, "omega": exact, "difference": solution.omega(mode.eigenvalue) / exact - 1.0})
    return rows


def _first_elastic(solution: TankSolution) -> list[dict[str, Any]]:
    return [_tone(solution, tone) for tone in solution.tones]


def _tone(solution: TankSolution, tone: ToneSolution) -> dict[str, Any]:
    body = tone.body
    beam = solution.tank.beams[body]
    # Dry mode 1 of the body, in units of the tank: EI κ⁴ l, (EI κ⁴ + s) l and m l.
    shapes = solution.field.bodies[body]
    first = shapes.dofs.index(FIRST_ELASTIC)
    found = {
        "body": body + 1,
        "dry_omega": solution.omega(first_dry_eigenvalue(beam)),
        "pressure_release_omega": None,
        "pressure_release_relative_error": None,
        "omega": None,
        "relative_error": None,
        "index": None,
        "participation": None,
        "runner_up": None,
        "shared": None,
        "one_mode": None,
        "first_sharing_mode": None,
        "last_sharing_mode": None,
        "added_mass_per_length": None,
        "added_mass_relative_error": None,
        "note": tone.reason,
    }
    if tone.pressure_release is not None:
        found["pressure_release_omega"] = solution.omega(tone.pressure_release)
        found["pressure_release_relative_error"] = tone.pressure_release_error
    if tone.tone is None:
        return found
    eigenvalue = float(solution.modes.eigenvalues[tone.tone.index])
    error = float(solution.relative_errors[tone.tone.index])
    added, added_error = added_mass(float(shapes.stiffness[first]), float(shapes.mass[first, first]), eigenvalue, error)
    scale = solution.units.mass_per_length / beam.length
    shared = tone.tone.is_shared
    found.update(
        omega=solution.omega(eigenvalue),
        relative_error=error,
        index=tone.tone.index + 1,
        participation=tone.tone.participation,
        runner_up=tone.tone.runner_up,
        shared=shared,
        one_mode=tone.tone.is_of_one_mode,
        first_sharing_mode=tone.tone.sharing[0] + 1,
        last_sharing_mode=tone.tone.sharing[1] + 1,
        added_mass_per_length=added * scale,
        added_mass_relative_error=added_error,
        note="the tone is shared between hybrid modes; see the pressure-release tone" if shared else "",
    )
    return found


def compared(solution: TankSolution, estimates: dict[str, Estimate], first: dict[str, Any]) -> dict[str, Any]:
    """Each estimate, its relative difference from the tone of the first beam, and whether its bound by theory holds."""
    rows = {}
    for name, estimate in estimates.items():
        rows[name] = {
            "omega": estimate.omega,
            "added_mass_per_length": estimate.added_mass_per_length,
            "difference": difference(estimate.omega, first.get("omega")),
            "added_mass_difference": difference(estimate.added_mass_per_length, first.get("added_mass_per_length")),
            "difference_to_pressure_release": difference(estimate.omega, first.get("pressure_release_omega")),
            "bound": estimate.bound,
            "bound_mode": estimate.mode_index,
            "bound_holds": _bound_holds(solution, estimate),
            "note": estimate.note,
        }
    return rows


def _bound_holds(solution: TankSolution, estimate: Estimate) -> bool | None:
    """Whether an upper bound is above the bounded frequency; ``None`` where that was not computed or there is no
    bound."""
    if estimate.omega is None or estimate.mode_index is None:
        return None
    number = estimate.mode_index - 1
    if estimate.bound == "above_mode_index":
        values = solution.modes.eigenvalues
        errors = solution.relative_errors
    elif estimate.bound == "above_pressure_release_tone" and solution.tones:
        values = solution.tones[0].pressure_release_values  # type: ignore[assignment]
        errors = [solution.tones[0].pressure_release_error or 0.0] * len(values)  # type: ignore[assignment]
    else:
        return None
    if number >= len(values) or np.isnan(errors[number]):
        return None
    # The field solution is itself an upper bound: its error is allowed for.
    return bool(estimate.omega >= solution.omega(values[number]) * (1.0 - errors[number] - 1e-9))
