"""The solution of a scene with open ends: the tables of its analyses, and estimates by older theories."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from hydroelastic.fem.open_water.round_comparison import round_comparisons
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.thin_float_theory import Comparison, thin_float_comparisons
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.infinite_draught import InfiniteDraughtFloat, infinite_draught_float
from hydroelastic.modal.floats.open_float import lone_profile
from hydroelastic.modal.floats.thin_float_radiation import is_deep
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.models.open_analyses import Decay, Resonance
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.tank.check_hints import draughts_left_out


@dataclass(frozen=True, kw_only=True)
class OpenSolution(OpenWaterSolution):
    """The solution of a scene with open ends; tables in the order of the scene's analyses."""

    scene: TankParts

    @cached_property
    def tank(self) -> Tank:
        """The open water, in SI units."""
        return physical_tank(self.scene)

    @cached_property
    def thin_float(self) -> tuple[tuple[Comparison, ...], str]:
        """The thin-float theory beside the solution, and a note."""
        return thin_float_comparisons(self.tank, self)

    @cached_property
    def endless_float(self) -> InfiniteDraughtFloat | None:
        """The float of infinite draught, if the float is one of it with an end."""
        return infinite_draught_comparison(self.scene)

    @cached_property
    def round_body(self) -> tuple[Comparison, ...]:
        """Closed forms and estimates of a lone body of revolution beside the solution."""
        return round_comparisons(self.tank, self)

    @property
    def left_out(self) -> tuple[str, ...]:
        """Messages on what the model leaves out."""
        return tuple(draughts_left_out(self.scene))


def infinite_draught_comparison(scene: TankParts) -> InfiniteDraughtFloat | None:
    """Return the float of infinite draught for a single exponential released in infinitely deep liquids; else
    ``None``."""
    tank = physical_tank(scene)
    profile, layers = lone_profile(tank), two_layers(tank)
    if profile is None or profile.shape != "exponential" or not is_deep(layers):
        return None
    if not any(isinstance(analysis, Decay | Resonance) for analysis in scene.analyses):
        return None
    try:
        return infinite_draught_float(profile, layers)
    except NoEstimateError:
        return None
