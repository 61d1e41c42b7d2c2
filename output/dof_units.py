"""Units of what belongs to the motions of bodies, per metre of width."""

from __future__ import annotations

# Without an angle among the motions, and with one.
MOTION_UNITS = ("m", "m, of roll rad")
INERTIA_UNITS = ("kg/m", "kg/m, with a roll kg, of rolls kg m")
STIFFNESS_UNITS = ("N/m^2", "N/m^2, with a roll N/m, of rolls N")
