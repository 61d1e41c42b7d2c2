"""How `check` describes a float."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.scenes.models.body_kinds import AnyFloat
from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.tank.body_words import BodyWords
from hydroelastic.scenes.tank.symbols import Group, depth_group, jump_of, potential_of


@dataclass(frozen=True, kw_only=True)
class FloatWords(BodyWords):
    """Description of a float: its boundary condition, motions, dimensionless groups and hydrostatics."""

    body: AnyFloat
    symbol = "s"
    name = "float"

    def condition(self) -> str:
        """Return the boundary condition on its contour, as formulas."""
        scene, body, level = self.scene, self.body, self.level
        layers = (1, 0) if level == "interface" else (len(scene.layers) - 1,)
        normal, across = (
            " = ".join(f"∂{potential_of(scene, layer)}/∂{direction}" for layer in layers) for direction in ("n", "x")
        )
        if body.boundary == "thin":
            what = (
                "∓ω′(y) s on the right and left"
                if body.motions == ("heave",)
                else "the displacement of the contour, on both sides"
            )
            return f"{across} = {what} of x = {body.position:g} m; s: {', '.join(body.motions)}"
        part = "" if level == "interface" else " below the level"
        return f"{normal} = n · s on its contour{part}; s: {', '.join(body.motions)}"

    def basis(self, *, is_held: bool) -> str:
        """Return a description of its motions."""
        body = self.body
        about = dict.fromkeys(("roll", "pitch"), " about its centre of mass")
        motions = ", ".join(motion + about.get(motion, "") for motion in body.motions)
        held = "; heave is excluded by the volume" if "heave" in body.motions and is_held else ""
        return f"rigid motions: {motions}{held}"

    def groups(self) -> Iterator[Group]:
        """Yield its dimensionless groups."""
        scene, body = self.scene, self.body
        placed = placed_float(scene, self.index)
        left, right, low, high = placed.hull.bounds
        below, _ = scene.densities_at(self.level)
        of_float = f"float {self.index + 1}: "
        if body.half_width is not None and body.half_height is not None:
            names = ("R/T", "radius over draught") if scene.is_revolved else ("b/h", "half width over half height")
            yield names[0], body.half_width / body.half_height, of_float + names[1]
        else:
            yield "b/h", (right - left) / (high - low), of_float + "width over height"
        breadth = placed.hydrostatics.waterplane[1] - placed.hydrostatics.waterplane[0]
        if scene.is_open:
            yield from depth_group(scene, "B", breadth, of_float + "depth of the lowest liquid over its waterplane")
        else:
            yield "B/L", breadth / scene.tank.length, of_float + "part of the tank that its waterplane covers"
        area = sum(placed.hydrostatics.areas)
        density = jump_of(scene, "surface") if self.level == "surface" else "ρₗ"
        yield (
            f"m/({density} A)",
            placed.hydrostatics.mass / (below * area),
            of_float + "its mean density over that below it",
        )
        if not scene.is_open:
            yield "x₀/L", body.position / scene.tank.length, of_float + "position"

    def at_rest(self) -> dict[str, str]:
        """Return the hydrostatics of a section, by quantity and unit."""
        placed = placed_float(self.scene, self.index)
        rest = placed.hydrostatics
        _, _, low, high = placed.hull.bounds
        left, right = rest.waterplane
        displaced = [
            density * area for density, area in zip(self.scene.densities_at(self.level), rest.areas, strict=True)
        ]
        force = self.body.vertical_force
        return {
            "mass, kg/m": f"{rest.mass:.6g}",
            **({} if force is None else {"vertical force of moorings, N/m": f"{force:.6g}"}),
            "displaced below + above, kg/m": f"{displaced[0]:.6g} + {displaced[1]:.6g}",
            "reference level above the still level, m": f"{rest.reference_level - rest.level:.6g}",
            "draught, height above the level, m": f"{rest.level - low:.6g}, {high - rest.level:.6g}",
            "waterplane, m": f"{left:.6g} to {right:.6g}",
            "centre of mass x, y, m": f"{rest.centre_of_mass[0]:.6g}, {rest.centre_of_mass[1]:.6g}",
            "radius of gyration, m": f"{rest.radius_of_gyration:.6g}",
            "c33 heave, N/m²": f"{rest.heave_stiffness:.6g}",
            "c35 heave and roll, N/m": f"{rest.coupling_stiffness:.6g}",
            "c55 roll, N": f"{rest.roll_stiffness:.6g}",
            "at rest": _stability(self.body, placed.roll_stiffness),
        }


def _stability(body: AnyFloat, stiffness: float) -> str:
    if stiffness > 0.0:
        return "stable"
    found = "neutral" if stiffness == 0.0 else "unstable"
    return f"{found} in roll" if "roll" in body.motions else f"stable; {found} if it could roll"
