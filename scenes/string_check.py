"""What the scene of a hanging string will be modelled as, said before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console
from rich.text import Text

from hydroelastic.scenes.digits import number
from hydroelastic.scenes.model_string import StringScene

_MOTIONS = {
    "ramp": "f = Vt",
    "sine": "f = Δ sin ωt",
    "smooth": "f = Δ(1 − e^(−βt))²",
    "step": "f = Δ",
    "table": "f by a table",
}


def print_string_check(scene: StringScene, console: Console) -> None:
    """Print the equation, its constants, the motion of the upper end and the method.

    Args:
        scene: a validated scene; nothing is solved.
        console: where to print.
    """
    console.print(Text(scene.title or "Untitled scene", style="bold"))
    for line in (*_string(scene), *_request(scene), *_method(scene)):
        console.print(Text(line))


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
    drag += "" if resistance.is_uniform else f" to {number(resistance.top)}"
    whole = string.travel_time
    yield f"λ = {drag} kg/(m·s), mean α = {number(string.damping)} 1/s, αR = {number(string.damping * whole)}."
    yield f"A wave takes R = {number(whole)} s from end to end; before its front nothing moves."


def _request(scene: StringScene) -> Iterator[str]:
    times = scene.times
    yield f"Upper end: {_MOTIONS[scene.motion.kind]}."
    yield (
        f"{len(scene.positions)} positions, {len(times)} times until {number(times[-1])} s; "
        f"{scene.accuracy.modes} free motions; tolerance {scene.accuracy.tolerance:g} of the largest displacement."
    )


def _method(scene: StringScene) -> Iterator[str]:
    if scene.method == "series":
        yield "Series of Bessel functions and damped oscillations; no mesh."
        return
    reasons = []
    if scene.string.tip_mass:
        reasons.append("a body hangs on the end")
    if not scene.string.resistance.is_uniform:
        reasons.append("the resistance varies")
    why = f", for {' and '.join(reasons)}" if reasons else ""
    yield (
        f"Field solution{why}: polynomials on elements of equal travel time, collocation at Gauss's points in time; "
        "both are refined until their estimated errors keep the tolerance."
    )
