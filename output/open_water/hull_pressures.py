"""Quantities of the pressure along the hulls of floats in waves, each declared once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.open_water.results import Complexes, Floats, HullPressure, ResponseTable
from hydroelastic.output.open_water.declarations import CREST, joined_array, own_array
from hydroelastic.output.quantities import Group, Quantity

# Angles from 0 to π, at steps of fifteen degrees.
_AZIMUTHS = 13


@dataclass(frozen=True, kw_only=True)
class Pressure:
    """The pressure along a hull in waves: `number` of the body, from 1, and `HullPressure` with the waves."""

    number: int
    omega: Floats
    waves: tuple[str, ...]
    x: Floats
    y: Floats
    pressure: Complexes
    pressure_error: Floats
    partial: Complexes | None

    @property
    def azimuths(self) -> Floats | None:
        """Angles θ about the axis of a solid, rad, at which pressures are told."""
        return None if self.partial is None else np.linspace(0.0, np.pi, _AZIMUTHS, dtype=np.float64)

    @property
    def around(self) -> Complexes | None:
        """Σ pₙ cos nθ, shape (frequencies, waves, azimuths, half of the points)."""
        if self.partial is None or self.azimuths is None:
            return None
        cosines = np.cos(np.outer(self.azimuths, np.arange(self.partial.shape[2])))
        return np.asarray(cosines @ self.partial)


def pressure_along(table: ResponseTable, hull: HullPressure) -> Pressure:
    """Return the pressure along a hull in the waves of a table."""
    x, y = hull.points.T
    return Pressure(
        number=hull.body + 1,
        omega=table.omega,
        waves=table.waves,
        x=x,
        y=y,
        pressure=hull.pressure,
        pressure_error=hull.pressure_error,
        partial=hull.partial_pressures,
    )


# fmt: off
# A table: as many arguments on a line as fit.
ALONG_HULL = "point_on_body_{.number}"
_AROUND, _HALF = "azimuth_on_body_{.number}", "point_on_half_of_body_{.number}"
HULLS = Group("hulls", "the pressure along the hull of each float", (
    HULL_BODY := Quantity("body", "number of the body", "1", value=lambda it: it.number, variable="", column="body"),
    HULL_X := own_array("x", "x of points along the hull of body {.number}", ALONG_HULL, lambda it: it.x, unit="m",
        variable="x_of_points_on_body_{.number}", column="x"),
    HULL_Y := own_array("y", "y of points along the hull of body {.number}", ALONG_HULL, lambda it: it.y, unit="m",
        variable="y_of_points_on_body_{.number}", column="y"),
    PRESSURE := own_array("pressure",
        "pressure along the hull of body {.number}, by all waves, at points that do not move",
        f"omega wave {ALONG_HULL}", lambda it: it.pressure, order=f"omega wave_direction wave {ALONG_HULL}",
        unit="Pa/m", variable="pressure_on_body_{.number}", column="pressure", phase=CREST),
    joined_array("pressure_error", "its estimated error anywhere", "omega wave", "omega wave_direction wave",
        unit="Pa/m", variable="pressure_error_on_body_{.number}", printed=False, column="", contract=False),
    own_array("azimuths", "angle about the axis of body {.number} from the direction +x", _AROUND,
        lambda it: it.azimuths, unit="rad", variable=_AROUND, column="", note="`null` of sections"),
    own_array("partial_pressures", "p_n of the pressure sum p_n cos(n theta) of body {.number} about its axis",
        f"omega wave azimuthal_order {_HALF}", lambda it: it.partial,
        order=f"omega wave_direction wave azimuthal_order {_HALF}", unit="Pa/m",
        variable="partial_pressure_on_body_{.number}", column="", phase=CREST,
        note="at the points of x ≥ 0, the second half of all; `null` of sections"),
    own_array("pressures_around", "pressure on body {.number} at azimuths about its axis",
        f"omega wave {_AROUND} {_HALF}", lambda it: it.around, order=f"omega wave_direction wave {_AROUND} {_HALF}",
        unit="Pa/m", variable="pressure_around_body_{.number}", column="", phase=CREST,
        note="at the same points; `null` of sections"),
), record=lambda table: list(table.pressures), dimension="hull", note="if `hull_pressures`")
# fmt: on
