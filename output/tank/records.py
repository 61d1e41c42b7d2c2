"""Values of the quantities of a closed tank by key, in SI units, from the Dataset of its solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from hydroelastic.fem.closed.section import SectionSolution
from hydroelastic.modal.estimate import Estimate, difference
from hydroelastic.modal.tank_estimates import exact_frequencies
from hydroelastic.output.quantities import Values

if TYPE_CHECKING:
    from hydroelastic.modal.floats.estimates import FloatEstimate


def rows(data: xr.Dataset, dimension: str, prefix: str = "") -> list[Values]:
    """The variables along one dimension as records, without the prefix of their names; NaN is ``None``."""
    own = {
        str(name).removeprefix(prefix): variable.values.tolist()
        for name, variable in data.data_vars.items()
        if variable.dims == (dimension,) and str(name).startswith(prefix)
    }
    return [
        {name: None if value != value else value for name, value in zip(own, row, strict=True)}
        for row in zip(*own.values(), strict=True)
    ]


def natural_modes(data: xr.Dataset) -> list[Values]:
    """Return the modes asked for."""
    return [
        row | {"frequency_hz": row["omega"] / (2.0 * np.pi), "symmetry": row["symmetry"] or None}
        for row in rows(data, "mode")[: data.attrs["asked"]]
    ]


def growing_motions(data: xr.Dataset) -> list[Values]:
    """Return the motions of unstable floats, e^{σt}, fastest first."""
    found = rows(data, "growing_mode", "growing_")
    rates = rows(data, "growing_mode")
    return [
        row | {"growth_rate": rate["growth_rate"], "symmetry": row["symmetry"] or None}
        for row, rate in zip(found, rates, strict=True)
    ]


def float_values(solution: SectionSolution, index: int, estimates: dict[str, FloatEstimate] | None) -> Values:
    """Return hydrostatics, added mass and modes of a float, its estimates beside its mode of heave."""
    data, body = solution.dataset, solution.physical.floats[index]
    modes = [mode for mode in rows(data, "float_mode", "float_mode_") if mode["body"] == index + 1]
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


def _high_frequency(solution: SectionSolution, index: int) -> Values | None:
    data = solution.dataset
    if "infinite_frequency_added_mass" not in data:
        return None
    counts = [len(solution.physical.floats[other].motions) for other in solution.tank.rigid]
    place = solution.tank.rigid.index(index)
    own = slice(sum(counts[:place]), sum(counts[: place + 1]))
    return {
        "added_mass": data.infinite_frequency_added_mass.values[own, own],
        "relative_error": float(data.infinite_frequency_added_mass_relative_error),
    }


def compared(data: xr.Dataset, estimates: dict[str, Estimate]) -> dict[str, Values]:
    """Return each estimate beside the first elastic tone of the first beam, by name."""
    first: Values = next(iter(rows(data, "elastic_body", "first_elastic_")), {})
    return {
        name: {
            **vars(estimate),
            "difference": difference(estimate.omega, first.get("omega")),
            "added_mass_difference": difference(estimate.added_mass_per_length, first.get("added_mass_per_length")),
            "difference_to_pressure_release": difference(estimate.omega, first.get("pressure_release_omega")),
            "bound_mode": estimate.mode_index,
            "bound_holds": _bound_holds(data, estimate),
        }
        for name, estimate in estimates.items()
    }


def _bound_holds(data: xr.Dataset, estimate: Estimate) -> bool | None:
    """Whether an upper bound is above the bounded frequency; ``None`` if unknown or without a bound."""
    places = {"above_mode_index": "", "above_pressure_release_tone": "released_"}
    prefix = places.get(estimate.bound)
    if estimate.omega is None or estimate.mode_index is None or prefix is None or f"{prefix}omega" not in data:
        return None
    values, errors = data[f"{prefix}omega"].values, data[f"{prefix}relative_error"].values
    number = estimate.mode_index - 1
    if number >= len(values) or np.isnan(errors[number]):
        return None
    # The field solution is itself an upper bound: its error is allowed for.
    return bool(estimate.omega >= values[number] * (1.0 - errors[number] - 1e-9))


def exact_modes(solution: SectionSolution) -> list[Values]:
    """Return the exact frequencies of the modes asked for, of tanks that have a closed form."""
    formula, frequencies = exact_frequencies(solution.physical, solution.count)
    found: list[Any] = solution.dataset.omega.values[: solution.dataset.attrs["asked"]].tolist()
    return [
        {"formula": formula, "omega": exact, "difference": omega / exact - 1.0}
        for omega, exact in zip(found, frequencies, strict=False)
    ]
