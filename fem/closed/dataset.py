"""The Dataset of a closed section, in SI units per metre of width.

Dimensions: `mode`, all modes that were solved for, ascending, of which the first `attrs["asked"]` were asked for;
`growing_mode`; `cause` of errors; `body_dof`, unknowns of all bodies; `share`, what has potential energy: these, then
the surfaces; `elastic_body`; `released_mode`, with ψ = 0 on the free surface; `float_mode`, the restored motions of
floats; `influenced_dof` and `radiating_dof`, the motions of floats.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from hydroelastic.fem.closed.discretization import MOST_MODES_TO_TONE
from hydroelastic.fem.closed.section import CAUSES
from hydroelastic.fem.closed.tones import added_mass_of, first_elastic, mode_kinds
from hydroelastic.fem.kept_tolerance import excess
from hydroelastic.modal.beam.beam_shapes import first_dry_eigenvalue
from hydroelastic.physics.dofs import dof_names
from hydroelastic.physics.rigid_motions import mode_count

if TYPE_CHECKING:
    from hydroelastic.fem.closed.section import SectionSolution


def section_dataset(solution: SectionSolution) -> xr.Dataset:
    """Collect all results of a section."""
    found, growing = solution.found, solution.found.modes.growing
    data = xr.Dataset(
        {**_of_modes(solution, slice(growing, None), ""), **_of_modes(solution, slice(0, growing), "growing_")},
        coords={
            "cause": list(CAUSES),
            "body_dof": [str(dof) for dof in dof_names(body.dofs for body in found.section.bodies)],
        },
    )
    if solution.tank.elastic:
        data = data.merge(_tones(solution))
    if solution.tank.rigid:
        data = data.merge(_floats(solution))
    section, modes = found.section, found.modes
    pencils = [part.pencil for part in modes.parts.values()]
    reasons = list(reasons_of(solution))
    return data.assign_attrs(
        status="unconverged" if reasons else "ok",
        reasons=reasons,
        asked=min(solution.count, len(found.values)),
        tolerance=solution.tolerance,
        zero_modes=modes.zero_modes,
        counted=int(solution.counted),
        degree=section.discretization.degree,
        geometry_degree=section.mesh_degree,
        cells=section.mesh.cell_count,
        halves=int(section.half),
        unknowns=sum(pencil.liquid.size + pencil.size for pencil in pencils),
        surface_unknowns=sum(pencil.size for pencil in pencils),
        dry_modes=[section.discretization.dry_modes[index] for index in solution.tank.elastic],
        processes=section.comm.size,
        seconds=sum(solution.seconds.values()),
    )


def reasons_of(solution: SectionSolution) -> Iterator[str]:
    """Why the tolerance is not kept, or something is missing; nothing where all is well."""
    found, tolerance, estimated = solution.found, solution.tolerance, "has an estimated error"
    growing = found.modes.growing
    own = found.total[growing:]
    asked = min(solution.count, len(own))
    # Mode numbers start at one; the zero is for a tank without modes.
    errors = np.append(0.0, own[:asked])
    number = int(np.argmax(np.nan_to_num(errors, nan=np.inf)))
    yield from excess(
        f"mode {number} has an estimated relative error",
        errors[number],
        tolerance,
        rounding=found.causes["rounding"],
    )
    rates = found.total[:growing].max(initial=0.0)
    yield from excess("a growth rate has an estimated relative error", rates, tolerance)
    there = mode_count(solution.tank)
    if asked < min(solution.count, np.inf if there is None else there - growing):
        yield f"{asked} of {solution.count} modes exceed the rounding of the lowest"
    if not solution.counted:
        yield "an independent count of the modes by inertia disagrees: a mode may be missing"
    for number, body in enumerate(solution.tank.elastic):
        beam = f"of {'plate' if solution.tank.geometry.is_revolved else 'beam'} {body + 1}"
        if number < len(found.tones) and found.tones[number].certain:
            yield from excess(f"the first elastic tone {beam} {estimated}", own[found.tones[number].index], tolerance)
        released = solution.limit.tone(number) if solution.limit is not None else None
        if released is not None:
            yield from excess(f"the pressure-release tone {beam} {estimated}", released[1], tolerance)
    for mode in found.float_modes:
        if mode.index is not None:
            yield from excess(
                f"the {mode.motion} mode of float {mode.body + 1} {estimated}", own[mode.index], tolerance
            )
    if solution.limit is not None and solution.limit.added_mass is not None:
        yield from excess(
            f"the added mass at infinite frequency {estimated}", solution.limit.added_mass_error, tolerance
        )


def _of_modes(solution: SectionSolution, which: slice, prefix: str) -> dict[str, tuple]:
    found, growing = solution.found, prefix != ""
    values = np.abs(found.modes.values[which])
    mode = f"{prefix}mode"
    symmetry = np.array([str(key or "") for key, _ in found.modes.origins[which]])
    energies = found.energies[which]
    bending = np.concatenate([np.empty(0), *(body.bending for body in found.section.bodies)])
    strain = found.amplitudes[which] ** 2 @ bending / found.modes.values[which]
    residuals = found.modes.of_parts({key: part.residuals for key, part in found.modes.parts.items()})[which]
    omega = "growth_rate" if growing else "omega"
    # Modes that were solved for beside others are not refined for.
    errors = np.where(np.isin(np.arange(len(found.total)), found.judged), found.total, np.nan)[which]
    return {
        omega: (mode, np.sqrt(values) * solution.physical.units.frequency, {"units": "1/s" if growing else "rad/s"}),
        f"{prefix}relative_error": (mode, errors),
        f"{prefix}error": (("cause", mode), found.errors[:, which]),
        f"{prefix}symmetry": (mode, symmetry),
        f"{prefix}kind": (mode, np.array(mode_kinds(energies, found.section.bodies, found.surfaces), dtype=str)),
        f"{prefix}elastic_energy_fraction": (mode, strain),
        f"{prefix}residual": (mode, residuals),
        f"{prefix}amplitude": ((mode, "body_dof"), found.amplitudes[which]),
        f"{prefix}energy": ((mode, "share"), energies),
    }


def _tones(solution: SectionSolution) -> xr.Dataset:
    found, units = solution.found, solution.physical.units
    rows = []
    for number, (body, reached) in enumerate(zip(solution.tank.elastic, solution.sought.reaches_tones, strict=True)):
        tone = found.tones[number] if number < len(found.tones) else None
        beam = solution.tank.beams[body]
        row: dict[str, object] = {
            "body": body + 1,
            "dry_omega": np.sqrt(first_dry_eigenvalue(beam)) * units.frequency,
            "note": "",
        }
        released = solution.limit.tone(number) if solution.limit is not None else None
        if released is not None:
            row["pressure_release_omega"] = np.sqrt(released[0]) * units.frequency
            row["pressure_release_relative_error"] = released[1]
        if tone is not None and tone.certain:
            value = found.values[tone.index]
            error = found.total[found.modes.growing + tone.index]
            own = found.section.bodies[body]
            first, _ = first_elastic(found.section.bodies, body)
            added, added_error = added_mass_of(own.stiffness[first], own.mass[first, first], value, error)
            row |= {
                "omega": np.sqrt(value) * units.frequency,
                "relative_error": error,
                "index": tone.index + 1,
                "participation": tone.participation,
                "runner_up": tone.runner_up,
                "shared": tone.is_shared,
                "one_mode": tone.is_of_one_mode,
                "first_sharing_mode": tone.sharing[0] + 1,
                "last_sharing_mode": tone.sharing[1] + 1,
                "added_mass_per_length": added * units.mass_per_length / beam.length,
                "added_mass_relative_error": added_error,
            }
            if tone.is_shared:
                row["note"] = "the tone is shared between hybrid modes; see the pressure-release tone"
        else:
            row["note"] = (
                f"its energy is spread over modes beyond the first {len(found.values)}"
                if reached
                else f"more than {MOST_MODES_TO_TONE} modes lie below it, and it was not searched for"
            ) + "; see the pressure-release tone" * (released is not None)
        rows.append(row)
    data = _table(rows, "elastic_body", "first_elastic_")
    limit = solution.limit
    if limit is not None and limit.modes is not None:
        data["released_omega"] = (
            "released_mode",
            np.sqrt(limit.modes.values) * units.frequency,
            {"units": "rad/s"},
        )
        data["released_relative_error"] = ("released_mode", limit.modes.total[limit.modes.modes.growing :])
    return data


def _floats(solution: SectionSolution) -> xr.Dataset:
    found, units = solution.found, solution.physical.units
    rows = []
    for mode in found.float_modes:
        row: dict[str, object] = {"body": mode.body + 1, "motion": str(mode.motion), "note": mode.reason}
        if mode.index is not None:
            unit = units.density * units.length ** (4.0 if mode.motion.is_rotation else 2.0)
            value = float(found.values[mode.index])
            error = float(found.total[found.modes.growing + mode.index])
            added, added_error = added_mass_of(mode.stiffness, mode.inertia, value, error)
            row |= {
                "index": mode.index + 1,
                "omega": np.sqrt(value) * units.frequency,
                "relative_error": error,
                "modal_mass": mode.modal_mass * unit,
                "runner_up_modal_mass": mode.runner_up * unit if np.isfinite(mode.runner_up) else np.nan,
                "shared": mode.is_shared,
                "added_mass": added * unit,
                "added_mass_relative_error": added_error,
            }
            if mode.is_shared:
                row["note"] = "shared with waves or other bodies: no single mode represents this motion"
        rows.append(row)
    data = _table(rows, "float_mode", "float_mode_") if rows else xr.Dataset()
    limit = solution.limit
    if limit is not None and limit.added_mass is not None:
        bodies = [() if body.is_elastic else body.rigid_motions for body in solution.tank.bodies]
        names = [dof.capitalised for dof in dof_names(bodies)]
        turns = np.array([float(dof.is_rotation) for own in bodies for dof in own])
        masses = units.density * units.length ** (2.0 + turns[:, None] + turns)
        both = ("influenced_dof", "radiating_dof")
        data = data.assign_coords(influenced_dof=names, radiating_dof=names)
        data["infinite_frequency_added_mass"] = (both, limit.added_mass * masses)
        data["infinite_frequency_added_mass_relative_error"] = limit.added_mass_error
    return data


def _table(rows: list[dict[str, object]], dimension: str, prefix: str) -> xr.Dataset:
    """Rows as variables along a dimension; what a row does not have is ``None``."""
    names = dict.fromkeys(name for row in rows for name in row)
    columns = {name: np.array([row.get(name) for row in rows]) for name in names}
    return xr.Dataset({prefix + name: (dimension, column) for name, column in columns.items()})
