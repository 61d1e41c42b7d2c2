"""Results of a scene with open ends as one JSON-ready value: tables with their errors, and their cost."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any

from mpi4py import MPI

from hydroelastic.fem.open_water.results import DIRECTIONS, DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.open_water.thin_float_theory import thin_float_comparisons
from hydroelastic.output.json_values import json_ready
from hydroelastic.output.provenance import Summary, complete_summary
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.open_water.estimates import infinite_draught_comparison
from hydroelastic.scenes.open_water.results import OpenSolution, region_words


def summarize_open(solution: OpenSolution, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene with open ends (collective: peak memory is summed over processes).

    Complex numbers are pairs [real part, imaginary part], infinity is the text "inf", a value that was not computed is
    null.

    Args:
        solution: the solution.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    comparisons, note = thin_float_comparisons(physical_tank(solution.scene), solution)
    infinite = infinite_draught_comparison(solution.scene)
    content = {
        "radiation": [_written(table) | {"wave_direction": list(DIRECTIONS)} for table in solution.radiation],
        "response": [_written(table) for table in solution.response],
        "resonance": [_written(table) for table in solution.resonance],
        "decay": [_written(table) for table in solution.decay],
        "estimates": {
            "thin_float": {"rows": [json_ready(asdict(row)) for row in comparisons], "note": note},
            "endless_float": json_ready(asdict(infinite)) if infinite else None,
        },
    }
    return complete_summary(solution, content, solution.size, comm, import_seconds)


def _written(table: RadiationTable | ResponseTable | ResonanceTable | DecayTable) -> dict[str, Any]:
    """A table by the names of its fields; `body` counts from 1, as in all output."""
    row = {field.name: getattr(table, field.name) for field in fields(table)}
    if isinstance(table, ResponseTable):
        row["plates"] = [
            {"body": plate.body + 1, "positions": plate.positions, "deflection": plate.deflection}
            for plate in table.plates
        ]
        row["missed_peaks"] = [asdict(peak) for peak in table.missed_peaks]
    if isinstance(table, ResonanceTable):
        row["region"] = region_words(table.region)
    return {name: json_ready(value) for name, value in row.items()}
