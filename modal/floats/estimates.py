"""All older estimates of the heave of a float, side by side."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box import float_mode
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.rigid_limits import section_heave_added_mass
from hydroelastic.modal.floats.thin_float import thin_float_added_mass
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class FloatEstimate:
    """One estimate of the heave of a float; none of them bounds an exact frequency."""

    omega: float | None  # angular frequency, rad/s, or ``None`` where the method has no meaning
    added_mass: float | None  # c/ω² − m, kg/m, c the hydrostatic stiffness without walls, or ``None``
    note: str  # what the method neglects, or why there is no number

    def __post_init__(self) -> None:
        for name in ("omega", "added_mass"):
            value = getattr(self, name)
            if value is not None and not math.isfinite(value):
                raise ValueError(f"{name} is {value}; leave it None where it has no meaning")


def all_float_estimates(body: FloatInTank) -> dict[str, FloatEstimate]:
    """Return every estimate of the heave of a float by its name; a method without meaning says so in its note.

    Returns:
        ``hydrostatic`` (no added mass), ``high_frequency`` (exact added mass of the section without waves and walls),
        ``thin_float`` (the thin-float theory without walls), ``thin_float_box`` (thin boundary, walls, waves).
    """
    methods: dict[str, Callable[[FloatInTank], FloatEstimate]] = {
        "hydrostatic": _hydrostatic,
        "high_frequency": _high_frequency,
        "thin_float": _thin_float,
        "thin_float_box": _thin_float_box,
    }
    return {name: _guarded(name, method, body) for name, method in methods.items()}


def _guarded(name: str, method: Callable[[FloatInTank], FloatEstimate], body: FloatInTank) -> FloatEstimate:
    try:
        return method(body)
    except NoEstimateError as reason:
        return FloatEstimate(omega=None, added_mass=None, note=f"Method {name}. No value: {reason}.")


def _hydrostatic(body: FloatInTank) -> FloatEstimate:
    return _from_added_mass(body, 0.0, "Hydrostatic stiffness and the float's own mass: neglects the liquids' inertia.")


def _high_frequency(body: FloatInTank) -> FloatEstimate:
    layers = body.layers
    added_mass = section_heave_added_mass(body.section(), layers.density_below, layers.density_above)
    return _from_added_mass(
        body, added_mass, "Exact section in unbounded liquids, frequency far above the waves: neglects waves and walls."
    )


def _thin_float(body: FloatInTank) -> FloatEstimate:
    return _from_added_mass(
        body,
        _thin_added_mass(body),
        "Thin float in unbounded liquids, frequency far above the waves: neglects the float's thickness, waves and "
        "walls.",
    )


def _thin_float_box(body: FloatInTank) -> FloatEstimate:
    mode = float_mode(body)
    return FloatEstimate(
        omega=mode.omega,
        added_mass=body.stiffness / mode.omega**2 - body.mass,
        note=f"Thin float between walls, with waves; symmetric mode {mode.index}, which holds "
        f"{100 * mode.participation:.0f} % of the heave: neglects the float's thickness. The mean level beside the "
        "float rises as it sinks, which stiffens it and counts here as less added mass.",
    )


def _thin_added_mass(body: FloatInTank) -> float:
    return thin_float_added_mass(body.section(), body.layers.density_below, body.layers.density_above)


def _from_added_mass(body: FloatInTank, added_mass: float, note: str) -> FloatEstimate:
    return FloatEstimate(omega=math.sqrt(body.stiffness / (body.mass + added_mass)), added_mass=added_mass, note=note)


def float_estimates(tank: Tank) -> dict[int, dict[str, FloatEstimate]]:
    """Estimates of heave, by name, of every float that heaves at the lowest level, as if alone, by its index."""
    if len(tank.layers) == 1 and tank.top != "free":
        # The theories of one liquid know its free surface only.
        return {}
    layers, lowest = two_layers(tank), tank.levels[0].name
    return {
        index: all_float_estimates(_float_in_tank(tank, layers, body))
        for index, body in tank.floats.items()
        if "heave" in body.motions and body.level == lowest
    }


def _float_in_tank(tank: Tank, layers: TwoLayers, body: RigidFloat) -> FloatInTank:
    rest = body.hydrostatics
    return FloatInTank(
        layers=layers,
        tank_length=tank.length,
        position=0.5 * sum(rest.waterplane),
        mass=rest.mass,
        stiffness=float(body.stiffness[0, 0]),
        profile=body.hull.profile if rest.reference_level == rest.level else None,
    )
