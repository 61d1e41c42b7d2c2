"""How `check` describes a beam."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.scenes.models.body_kinds import AnyBeam
from hydroelastic.scenes.tank.body_words import BodyWords
from hydroelastic.scenes.tank.symbols import Group, depth_group, jump_of, potential_of

_ENDS = {"free": "w″ = w‴ = 0 at its ends", "guided": "w′ = w‴ = 0 at its ends"}


@dataclass(frozen=True, kw_only=True)
class BeamWords(BodyWords):
    """A beam: its equation, its dry modes, its groups."""

    beam: AnyBeam
    symbol = "a"
    name = "beam"

    def condition(self) -> str:
        """Return the boundary condition on the beam, as formulas."""
        scene, beam, level = self.scene, self.beam, self.level
        jump = jump_of(scene, level)
        restoring = f" + {jump} g w" if beam.hydrostatic else ""
        if level == "interface":
            slopes, pressure = "∂ψᵤ/∂y = ∂ψₗ/∂y", "(ρₗ ψₗ − ρᵤ ψᵤ)"
        else:
            potential = potential_of(scene, len(scene.layers) - 1)
            slopes, pressure = f"∂{potential}/∂y", f"{jump} {potential}"
        bending = "EI w⁗" if not beam.sections else "(EI w″)″"
        joints = "".join(f"; {what}" for what in _joint_conditions(beam))
        return f"{slopes} = w, {bending}{restoring} − ω² m w = ω² {pressure}; {_ENDS[beam.ends]}{joints}"

    def basis(self, *, is_held: bool) -> str:
        """Return a description of its dry modes."""
        beam = self.beam
        if beam.ends == "guided":
            return "w = Σ aᵢ φᵢ: elastic shapes cos(nπx/L), n ≥ 1; heave is excluded by the volume"
        hinges = ", a turn about each hinge" if beam.hinges else ""
        if is_held:
            return f"w = Σ aᵢ φᵢ: pitch{hinges} and elastic shapes free in vacuum; heave is excluded by the volume"
        return f"w = Σ aᵢ φᵢ: heave, pitch{hinges} and elastic shapes free in vacuum"

    def groups(self) -> Iterator[Group]:
        """Yield its dimensionless groups."""
        scene, beam, level = self.scene, self.beam, self.level
        below, above = scene.densities_at(level)
        weight = (below - above) * scene.tank.gravity
        of_beam = f"beam {self.index + 1}: "
        density = "ρᵤ" if len(scene.layers) == 2 and level == "surface" else "ρ" if len(scene.layers) == 1 else "ρₗ"
        for number, part in enumerate(beam.parts, 1):
            of_part = f"{of_beam}section {number}, " if beam.sections else of_beam
            stiffness = part.flexural_rigidity / (weight * beam.length**4)
            yield f"EI/({jump_of(scene, level)} g l⁴)", stiffness, of_part + "bending over gravity"
            yield (
                f"m/({density} l)",
                part.mass_per_length / (below * beam.length),
                of_part + f"its mass over that of {density} l²",
            )
            if beam.sections:
                yield "lᵢ/l", part.length / beam.length, of_part + "part of the beam"
        for number, joint in enumerate(beam.joints, 1):
            of_joint = f"{of_beam}joint {number}, "
            yield "x/l", joint.at / beam.length, of_joint + "place"
            stiffness = joint.rotational_stiffness / (weight * beam.length**3)
            yield f"k/({jump_of(scene, level)} g l³)", stiffness, of_joint + "its stiffness over gravity"
        if scene.is_open:
            yield from depth_group(scene, "l", beam.length, of_beam + "depth of the lowest liquid over its length")
            return
        yield "l/L", beam.length / scene.tank.length, of_beam + "part of the tank that it covers"
        yield "x₁/L", beam.start / scene.tank.length, of_beam + "left end"


def _joint_conditions(beam: AnyBeam) -> Iterator[str]:
    """Return the conditions at the hinges and at the other joints of a beam."""
    if beam.hinges:
        yield "w″ = 0 at its hinges"
    if len(beam.hinges) < len(beam.joints):
        yield "k Δw′ = EI w″ at its joints"
