"""Tanks that are hard to solve, as data: what is hard about each, what protects the answer, and how it is checked.

All start from the base tank of docs/theory_aquarium.md: L = 10 m, H = 5 m, a beam of 4 m in the middle. Lengths in the
texts are in L or in l, EI' = EI/(ρgl⁴) and m' = m/(ρl). Their frequencies are in
`reference/hard_cases.json`, made by `reference/make_hard_cases.py`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import hydroelastic as he

TOLERANCES = (1e-4, 1e-6, 1e-8)
"""What is asked of each case."""

LENGTH, DEPTH, DENSITY, GRAVITY = 10.0, 5.0, 1000.0, 9.81


@dataclass(frozen=True, kw_only=True)
class HardCase:
    """One hard case.

    Attributes:
        name: how it is called in tests and tables.
        hard: what is hard about it.
        protects: what in the method deals with that.
        scene: the tank, and how many modes are asked for; the tolerance is one of `TOLERANCES`.
        fast: the tolerances at which it is cheap enough for each run of the tests.
        may_refuse: the tolerances that may be missed, if the solution says so.
        hidden_tone: the tolerances at which rounding may hide the pressure-release tone, which is then left out.
        tone_within: among how many modes the first elastic tone of the first beam lies, where one mode clearly is it
            and must be found as such; 0 where the energy is shared, or the tone is far above.
    """

    name: str
    hard: str
    protects: str
    scene: he.TankScene
    fast: tuple[float, ...] = (1e-6,)
    may_refuse: tuple[float, ...] = ()
    hidden_tone: tuple[float, ...] = ()
    tone_within: int = 0

    def asked(self, tolerance: float) -> he.TankScene:
        """The scene with a tolerance."""
        accuracy = he.Accuracy(tolerance=tolerance, modes=self.scene.accuracy.modes)
        return self.scene.model_copy(update={"accuracy": accuracy})


def beam(
    start: float = 3.0, length: float = 4.0, *, rigidity: float = 2e-3, mass: float = 0.0125, **changes: Any
) -> he.Beam:
    """A beam by its groups EI' and m', in the liquid of the base tank."""
    given = {
        "start": start,
        "length": length,
        "flexural_rigidity": rigidity * DENSITY * GRAVITY * length**4,
        "mass_per_length": mass * DENSITY * length,
        "hydrostatic": True,
    }
    return he.Beam(**(given | changes))


def tank(*beams: he.Beam, modes: int = 8, length: float = LENGTH, depth: float = DEPTH, **changes: Any) -> he.TankScene:
    """A tank of the base liquid with beams."""
    return he.TankScene(
        tank=he.Tank(**({"length": length, "gravity": GRAVITY} | changes)),
        liquid=(he.Liquid(density=DENSITY, depth=depth),),
        body=beams,
        accuracy=he.Accuracy(tolerance=1e-6, modes=modes),
    )


CROSSING_RIGIDITY = 0.000335659601163
"""EI' at which the second symmetric and the first antisymmetric mode of the base tank with s = 0 cross, to 4e-14."""

GRADED_RINGS = "rings of triangles around every tip, of sizes that follow from the shortest piece of the top"

CASES: tuple[HardCase, ...] = (
    *(
        HardCase(
            name=f"tip_{gap:.0e}_from_the_wall",
            hard=f"a slit of water {gap:g} L wide between a tip and the wall: a third length beside L and l",
            protects=GRADED_RINGS,
            scene=tank(beam(start=LENGTH * gap)),
        )
        for gap in (1e-2, 1e-4, 1e-6)
    ),
    HardCase(
        name="tip_at_the_wall",
        hard="the limit of the slit: water and its two corners vanish, and the beam's end slides along the wall",
        protects="a segment that is not there is not meshed; the corner of beam and wall is graded",
        scene=tank(beam(start=0.0)),
    ),
    HardCase(
        name="tip_1e-09_from_the_wall",
        hard="a gap that decimal input cannot tell from none",
        protects="ends within 1e-9 L of a wall are laid at the wall",
        scene=tank(beam(start=1e-9 * LENGTH)),
    ),
    HardCase(
        name="tip_just_off_the_wall",
        hard="the narrowest slit that is still taken as water, 2e-9 L",
        protects=GRADED_RINGS,
        scene=tank(beam(start=2e-9 * LENGTH)),
    ),
    *(
        HardCase(
            name=f"covered_but_{gap:.0e}",
            hard=f"slits of {gap:g} L at both walls: heave has to lift their water by a multiple of its own height",
            protects="the volume constraint is exact; " + GRADED_RINGS,
            scene=tank(beam(start=gap * LENGTH, length=(1.0 - 2.0 * gap) * LENGTH, rigidity=1e-4)),
            tone_within=8,
        )
        for gap in (1e-3, 1e-5)
    ),
    *(
        HardCase(
            name=f"soft_{lengths}_lengths",
            hard=f"a beam of {lengths} characteristic lengths (EI/ρg)^¼: flexural-gravity waves, layers at the tips",
            protects="as many dry modes as the shortest wave under the beam needs, and a tail for the layers",
            scene=tank(beam(rigidity=float(lengths) ** -4), modes=12),
        )
        for lengths in (40, 160)
    ),
    *(
        HardCase(
            name=f"stiff_{exponent}",
            hard=f"EI' = 1e{exponent}: bending and gravity lie {exponent} decades apart in one matrix",
            protects="shapes are scaled by their stiffness: what does not bend drops out without rounding",
            scene=tank(beam(rigidity=0.999 * 10.0**exponent, mass=0.5)),
            # λ of the tone is 2e9 or 2e18 times that of pitch, beside which rounding leaves 1e-15.
            hidden_tone=(1e-8,),
        )
        for exponent in (6, 15)
    ),
    HardCase(
        name="massless",
        hard="m' = 1e-8: all inertia is the liquid's, and dry frequencies lie at infinity",
        protects="1/λ is sought, with stiffness as the norm: mass may be zero",
        scene=tank(beam(mass=1e-8, hydrostatic=False)),
        tone_within=8,
    ),
    HardCase(
        name="heavy",
        hard="m' = 1000: the beam's modes lie 30 times below the lowest wave",
        protects="dry modes of the beam are exact; 1/λ is sought, so that the lowest converge first",
        scene=tank(beam(mass=1e3), modes=6),
        tone_within=6,
    ),
    HardCase(
        name="depth_1e-3",
        hard="H/L = 1e-3: a layer with boundary layers of its depth at the tips, in a tank 1000 times longer",
        protects="cells follow the layer; " + GRADED_RINGS,
        scene=tank(beam(), depth=1e-3 * LENGTH),
    ),
    HardCase(
        name="depth_20",
        hard="H/L = 20: nothing moves in nearly all of the tank",
        protects="cells grow with the depth",
        scene=tank(beam(), depth=20.0 * LENGTH),
    ),
    HardCase(
        name="beam_0.005",
        hard="l/L = 0.005: the beam is a point for the waves",
        protects=GRADED_RINGS,
        scene=tank(beam(start=4.0, length=0.05)),
    ),
    HardCase(
        name="tone_above_40_waves",
        hard="47 modes of sloshing lie below the first elastic tone",
        protects="enough modes are solved for to reach the tone, and the participations tell it from its neighbours",
        scene=tank(beam(rigidity=2.0, mass=10.0), modes=4),
        tone_within=60,
    ),
    HardCase(
        name="crossing",
        hard="a symmetric and an antisymmetric mode at the same frequency to 1e-9",
        protects="a tank that is its own mirror image is solved as two halves, in which the two modes never meet",
        scene=tank(beam(rigidity=CROSSING_RIGIDITY, hydrostatic=False)),
    ),
    HardCase(
        name="avoided_crossing",
        hard="the same tank with its beam 1e-7 L off the centre: the two modes mix, 3e-7 apart",
        protects="modes converge as a subspace, and their number is counted in a gap between other modes",
        scene=tank(beam(start=3.0 + 1e-6, rigidity=CROSSING_RIGIDITY, hydrostatic=False)),
    ),
    HardCase(
        name="heavy_twins",
        hard="two equal beams, m' = 1e8: one triple and several double eigenvalues, equal to 1e-8 and less",
        protects="the Krylov space holds more vectors than modes asked for; inertia counts each of a pair",
        scene=tank(beam(1.0, 2.0, mass=1e8), beam(7.0, 2.0, mass=1e8)),
    ),
    HardCase(
        name="twins_in_a_lid",
        hard="two equal beams in a rigid lid over shallow liquid: they feel each other by their volumes alone",
        protects="the volume constraint is exact",
        scene=tank(beam(1.0, 2.0), beam(7.0, 2.0), depth=0.5, top="rigid", modes=7),
    ),
    HardCase(
        name="twins_close",
        hard="two equal beams with 0.002 L of water between them",
        protects=GRADED_RINGS,
        scene=tank(beam(2.0, 2.99), beam(5.01, 2.99)),
    ),
    HardCase(
        name="twins_without_restoring",
        hard="three motions with λ = 0: two pitches, and heave against heave",
        protects="all rigid motions without restoring that displace no volume are condensed and counted",
        scene=tank(beam(1.0, 3.0, hydrostatic=False), beam(6.0, 3.0, hydrostatic=False)),
    ),
    HardCase(
        name="three_beams",
        hard="three beams of different length, stiffness and mass, one at the wall, one without restoring",
        protects="each beam has its own dry modes and resolution",
        scene=tank(
            beam(0.0, 2.0, rigidity=1e-4),
            beam(2.5, 3.0, rigidity=1.0, mass=1.0, hydrostatic=False),
            beam(6.5, 1.0, rigidity=1e-2, mass=0.1),
        ),
    ),
    HardCase(
        name="unlike_beams",
        hard="a stiff and light beam beside a soft and heavy one: λ of their tones lie 20 decades apart",
        protects="shapes are scaled by their stiffness; what rounding hides is not looked for",
        scene=tank(
            beam(2.5, 1.2, rigidity=3.5e7, mass=1e-6, hydrostatic=False),
            beam(6.8, 1.0, rigidity=4e-9, mass=6e8),
            modes=4,
        ),
    ),
    HardCase(
        name="fifty_modes",
        hard="50 modes: short waves on the water and under the beam",
        protects="elements hold no more of the shortest wave than their degree resolves; dry modes follow it too",
        scene=tank(beam(), modes=50),
    ),
    HardCase(
        name="pitch_without_restoring",
        hard="one motion with λ = 0 beside a heave that the volume holds back",
        protects="what has no stiffness is condensed through the kinetic energy, and counted",
        scene=tank(beam(hydrostatic=False)),
        tone_within=8,
    ),
    HardCase(
        name="waves_below_the_tones",
        hard="λl/g ≫ 1 for all bending (g → 0): ψ = 0 on the water in the limit, r^½ at the tips",
        protects=GRADED_RINGS,
        scene=tank(beam(rigidity=1e9, hydrostatic=False), modes=12),
    ),
    HardCase(
        name="waves_above_the_tones",
        hard="λl/g ≪ 1 for the lowest tones (g → ∞): the water is a lid in the limit",
        protects="1/λ is sought in the norm of K, in which stiff water hardly moves",
        scene=tank(beam(rigidity=1e-10, hydrostatic=False)),
        tone_within=8,
    ),
    HardCase(
        name="full_cover",
        hard="no free water at all: heave is forbidden, and a soft cover carries waves over the whole tank",
        protects="the volume constraint is a projection in the norm of K",
        scene=tank(beam(0.0, LENGTH, rigidity=1e-6)),
        tone_within=8,
    ),
    HardCase(
        name="sixty_sloshing_modes",
        hard="60 modes without a beam",
        protects="elements follow the shortest wave",
        scene=tank(modes=60),
    ),
    HardCase(
        name="forty_guided_modes",
        hard="40 modes of a cover between guiding walls: λ grows like the fourth power",
        protects="dry modes, a cosine each",
        scene=tank(beam(0.0, LENGTH, rigidity=1e-4, ends="guided"), modes=40),
    ),
)
