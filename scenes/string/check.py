"""Description of the model and method of the scene of a hanging string, without solving it."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

from hydroelastic.fem.cost import cost
from hydroelastic.output.digits import number
from hydroelastic.output.sections import Row, Section
from hydroelastic.scenes.models.string import StringScene

# Of a field solution, and its steps in the travel time of a wave; measured.
_UNKNOWNS, _STEPS = 300, 100
_MOTIONS = {
    "ramp": "f = Vt",
    "sine": "f = Δ sin ωt",
    "smooth": "f = Δ(1 − e^(−βt))²",
    "step": "f = Δ",
    "table": "f by a table",
}


def check_string(scene: StringScene) -> Iterator[Section]:
    """Yield the equation, its constants, the unknowns, the motion of the upper end and the method."""
    yield Section(title="Equation", lines=tuple(_string(scene)))
    yield Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))
    yield Section(title="What is asked", lines=tuple(_request(scene)))
    yield Section(title="Method", lines=tuple(_method(scene)))


def _unknowns(scene: StringScene) -> Iterator[Row]:
    yield "U", "string", "displacement to the side, small beside the length, so that the equation is linear"
    yield "T: none", "string", "the tension is the weight that hangs below, and known"
    string = scene.string
    ways = []
    if string.physical.damping:
        ways.append("its resistance λ")
    if string.added_mass or string.displaced_mass or string.tip_displaced_mass:
        ways.append("the masses that it adds and displaces")
    why = f"it acts by {' and '.join(ways)}, each by the motion at its place alone" if ways else "nothing resists"
    yield "liquid: none", "around the string", why


def _string(scene: StringScene) -> Iterator[str]:
    string = scene.string
    inertia = "(ρ + m_a)" if string.added_mass else "ρ"
    weight = "(ρ − ρ_d)" if string.displaced_mass else "ρ"
    yield f"{inertia} ∂²U/∂t² = −2λ ∂U/∂t + ∂/∂x(T ∂U/∂x), T = g({weight}x{' + M' if string.tip_mass else ''})."
    if string.tip_mass:
        displaced = f" less {number(string.tip_displaced_mass)} kg displaced" if string.tip_displaced_mass else ""
        yield f"A body of M = {number(string.tip_mass)} kg{displaced} hangs on the free end and moves with it."
    resistance = string.resistance
    drag = number(resistance.bottom)
    drag += "" if resistance.bottom == resistance.top else f" to {number(resistance.top)}"
    whole, damping = string.physical.travel_time, string.physical.damping
    yield f"λ = {drag} kg/(m·s), mean α = {number(damping)} 1/s, αR = {number(damping * whole)}."
    yield f"A wave takes R = {number(whole)} s from end to end; before its front nothing moves."


def _request(scene: StringScene) -> Iterator[str]:
    times = scene.times
    yield f"Upper end: {_MOTIONS[scene.motion.kind]}."
    yield (
        f"{len(scene.positions)} positions, {len(times)} times until {number(times[-1])} s; "
        f"{scene.accuracy.modes} free motions; tolerance {scene.accuracy.tolerance:g} of the largest displacement."
    )


def _method(scene: StringScene) -> Iterator[str]:
    travels = scene.times[-1] / scene.string.physical.travel_time
    steps = 1 if scene.method == "series" else ceil(_STEPS * travels)
    yield str(cost(_UNKNOWNS + len(scene.positions), 1, steps + len(scene.times), "string"))
    if scene.method == "series":
        yield "Series of Bessel functions and damped oscillations; no mesh."
        return
    reasons = []
    if scene.string.tip_mass:
        reasons.append("a body hangs on the end")
    if scene.string.resistance.bottom != scene.string.resistance.top:
        reasons.append("the resistance varies")
    why = f", for {' and '.join(reasons)}" if reasons else ""
    yield (
        f"Field solution{why}: polynomials on elements of equal travel time, collocation at Gauss's points in time; "
        "both are refined until their estimated errors keep the tolerance."
    )
