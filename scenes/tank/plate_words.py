"""How `check` describes a round plate of the sea."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.tank.body_words import BodyWords
from hydroelastic.scenes.tank.symbols import Group, depth_group, jump_of


@dataclass(frozen=True, kw_only=True)
class PlateWords(BodyWords):
    """A round plate: its equation, its dry modes, its groups."""

    plate: SeaPlate
    symbol = "a"
    name = "plate"

    def condition(self) -> str:
        """Return the boundary condition on the plate, as formulas."""
        jump = jump_of(self.scene, self.level)
        restoring = f" + {jump} g w" if self.plate.hydrostatic else ""
        tension = " − T Δw" if self.plate.tension else ""
        return f"∂ψ/∂z = w, D Δ²w{tension}{restoring} − ω² m w = ω² {jump} ψ; free edges, M_r = V_r = 0"

    def basis(self, *, is_held: bool) -> str:
        """Return a description of its dry modes."""
        shapes = "" if self.plate.rigid else " and elastic shapes free in vacuum"
        return f"w = Σ aᵢ Wᵢ(r) cos nθ: heave of order 0, pitch of order 1{shapes}, order by order"

    def groups(self) -> Iterator[Group]:
        """Yield its dimensionless groups."""
        scene, plate, of_plate = self.scene, self.plate, f"plate {self.index + 1}: "
        below, above = scene.densities_at(self.level)
        weight, jump = (below - above) * scene.tank.gravity, jump_of(scene, self.level)
        if plate.whole_rigidity and not plate.rigid:
            yield (
                f"D/({jump} g a⁴)",
                plate.whole_rigidity / (weight * plate.radius**4),
                of_plate + "bending over gravity",
            )
        if plate.tension:
            yield f"T/({jump} g a²)", plate.tension / (weight * plate.radius**2), of_plate + "tension over gravity"
        yield "m/(ρ a)", plate.whole_mass / (below * plate.radius), of_plate + "its mass over that of ρ a"
        yield from depth_group(scene, "a", plate.radius, of_plate + "depth of the lowest liquid over its radius")
