"""Comparison of the thin-float theory with the field solution of a float in open water."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.open_water.results import DecayTable, RadiationTable, ResonanceTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.open_float import OpenFloatEstimate, lone_profile, open_float_estimate, released_float
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.profiles import Profile
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """A value by the theory and by the field solution."""

    quantity: str  # what it is, with its unit
    theory: float  # its value by the thin-float theory
    field: float  # its value by the field solution
    # relative difference of the theory from the field; of a curve the largest over all frequencies or times, with the
    # values there
    difference: float


def thin_float_comparisons(tank: Tank, solution: OpenWaterSolution) -> tuple[tuple[Comparison, ...], str]:
    """Compare the thin-float theory with the heave of a single float."""
    profile, layers = lone_profile(tank), two_layers(tank)
    if profile is None:
        return (), ""
    rows: list[Comparison] = []
    try:
        estimate = open_float_estimate(profile, layers, [])
        for resonance in solution.resonance:
            rows += _resonance(resonance, estimate)
        for radiation in solution.radiation:
            rows += _radiation(radiation, profile, layers)
        for decay in solution.decay:
            rows += _decay(decay, profile, layers)
    except NoEstimateError as reason:
        return (), f"The thin-float theory has no value: {reason}."
    return tuple(rows), estimate.note


def _resonance(table: ResonanceTable, estimate: OpenFloatEstimate) -> list[Comparison]:
    heaves = [omega for omega, label in zip(table.omega, table.labels, strict=True) if label == "heave"]
    if estimate.resonance is None or not heaves:
        return []
    expected = estimate.resonance
    found = min(heaves, key=lambda omega: abs(omega - expected))
    return [
        compared("Re ω of the resonance, rad/s", expected.real, found.real),
        compared("γ = −Im ω, 1/s", -expected.imag, -found.imag),
    ]


def _radiation(table: RadiationTable, profile: Profile, layers: TwoLayers) -> list[Comparison]:
    places = np.flatnonzero(np.isfinite(table.omega) & (table.omega > 0.0))
    if not len(places):
        return []
    heave = table.dofs.index("heave")
    theory = open_float_estimate(profile, layers, table.omega[places]).radiation
    rows = []
    for name, unit, values, field in (
        ("a", "kg/m", theory.added_mass, table.added_mass),
        ("b", "kg/(m s)", theory.damping, table.radiation_damping),
    ):
        own = field[places, heave, heave]
        # Added mass has zeros, and damping decays to zero: differences are relative to the largest value.
        differences = np.abs(values - own) / np.abs(own).max()
        worst = int(np.argmax(differences))
        rows.append(
            Comparison(
                quantity=f"{name} at {table.omega[places[worst]]:.4g} rad/s, {unit}",
                theory=float(values[worst]),
                field=float(own[worst]),
                difference=float((values[worst] - own[worst]) / np.abs(own).max()),
            )
        )
    return rows


def _decay(table: DecayTable, profile: Profile, layers: TwoLayers) -> list[Comparison]:
    heave = table.dofs.index("heave")
    if not table.initial[heave]:
        return []
    theory = table.initial[heave] * released_float(profile, layers, table.times).heave
    own = table.displacement[:, heave]
    worst = int(np.argmax(np.abs(theory - own)))
    return [
        Comparison(
            quantity=f"heave {table.times[worst]:.4g} s after release, m",
            theory=float(theory[worst]),
            field=float(own[worst]),
            difference=float((theory[worst] - own[worst]) / table.initial[heave]),
        )
    ]


def compared(quantity: str, theory: float, field: float) -> Comparison:
    """Return a value by the theory beside that of the field solution."""
    return Comparison(
        quantity=quantity, theory=float(theory), field=float(field), difference=float((theory - field) / field)
    )
