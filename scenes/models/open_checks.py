"""Checks of scenes with open ends, and of keys that are reserved for them."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, inf, isclose, isinf, sqrt

from pydantic_core import InitErrorDetails

from hydroelastic.fem.open_water.region import MOST_DAMPING_ANYWHERE
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.scenes.models.body_kinds import AnyFloat, name_of_body
from hydroelastic.scenes.models.limits import is_at_most, is_within, shown_most, shown_range
from hydroelastic.scenes.models.open_analyses import Decay, Motion, Resonance, Response
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.revolved_floats import SOLID_SHAPES, RevolvedFloat
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.sea_states import Spectrum
from hydroelastic.scenes.models.tank_parts import TankParts

SLOWEST, FASTEST = 1e-6, 1e3
"""Frequencies in √(g/length), with the length that is drawn, between which waves can be meshed beside bodies."""

MOST_WAVES_AROUND = 75.0
"""Largest k R of the waves that solids of revolution scatter, with the R of their largest waterplane: about as many
azimuthal orders are solved, each with matrices of its own: 50 take minutes and gigabytes."""

_DEEPEST = 1e8  # over the extent of bodies


def closed_tanks_have_no_open_water_keys(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield keys of a closed tank that are reserved for open water."""
    if scene.is_open:
        return
    for index, liquid in enumerate(scene.liquid):
        if isinf(liquid.depth):
            yield problem_at(
                ("liquid", index, "depth"),
                liquid.depth,
                "a tank with walls is not infinitely deep",
                allowed="a finite depth",
                remedy='Outgoing waves need ends = "open" in [tank]',
            )
    if scene.analysis:
        yield problem_at(
            ("analysis",),
            None,
            "a tank with walls has modes, and no other analysis",
            remedy='Leave it out, or set ends = "open" in [tank]',
        )


def open_water_is_complete(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield what a scene of open water is missing, and keys that have no effect there."""
    if not scene.is_open:
        return
    if not scene.body:
        yield problem_at(
            ("body",), None, "open water without a body does not oscillate by itself", remedy="Add a [[body]]"
        )
    if scene.mesh is not None:
        yield problem_at(
            ("mesh", "file"),
            str(scene.mesh.file),
            "a user mesh has no absorbing layer for open water",
            remedy="Leave [mesh] out",
        )
    if len(scene.layers) == 1 and scene.top != "free":
        yield problem_at(
            (scene.kind, "top"),
            scene.top,
            "without a free surface or an interface there are no waves",
            allowed='"free"',
            remedy="Add a second [[liquid]]"
            if scene.kind == "sea"
            else 'Set ends = "walls", or add a second [[liquid]]',
        )
    # A default that is written out, as in summaries, is accepted.
    if scene.accuracy.modes != type(scene.accuracy).model_fields["modes"].default:
        yield problem_at(
            ("accuracy", "modes"),
            scene.accuracy.modes,
            "open water has no modes, so this has no effect",
            remedy='Leave it out; the number of resonances is "count" of an [[analysis]]',
        )
    yield from _nothing_lies_above_an_infinite_liquid(scene)


def frequencies_and_times_can_be_resolved(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield analyses whose wavelengths are too long or too short relative to the drawn length."""
    unit = sqrt(scene.tank.gravity / scene.tank.length)
    slowest, fastest = SLOWEST * unit, FASTEST * unit
    for index, analysis in enumerate(scene.analysis if scene.is_open else ()):
        for key, values in (
            ("omega", getattr(analysis, "omega", ())),
            ("waves", [wave.omega for wave in analysis.request.waves] if isinstance(analysis, Motion) else ()),
            ("below", [value for value in [getattr(analysis, "below", None)] if value is not None]),
        ):
            wrong = [value for value in values if value not in (0.0, inf) and not is_within(value, slowest, fastest)]
            if wrong:
                yield problem_at(
                    ("analysis", index, key),
                    wrong[0],
                    f"its waves are too long or too short relative to {_drawn(scene)} for one mesh to resolve both",
                    allowed=f"{shown_range(slowest, fastest)} rad/s",
                )
        late = [time for time in getattr(analysis, "times", ()) if not is_at_most(time, 1.0 / slowest)]
        if late:
            yield problem_at(
                ("analysis", index, "times"),
                late[0],
                f"the waves at such late times are too long relative to {_drawn(scene)}",
                allowed=f"0 to {shown_most(1.0 / slowest)} s",
            )


def azimuthal_orders_can_be_solved(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield analyses of scattered waves that need too many azimuthal orders of solids of revolution."""
    scattered = [(index, one) for index, one in enumerate(scene.analysis) if isinstance(one, Response | Spectrum)]
    if not scene.is_revolved or not scattered:
        return
    water = physical_tank(scene)
    layers, radius = two_layers(water), max(right for _, right in (body.waterplane for body in water.bodies))

    def around(omega: float) -> float:
        return radius * max(wave.wavenumber for wave in travelling_waves(layers, omega))

    for index, analysis in scattered:
        highest = analysis.request.band[1]
        if around(highest) <= MOST_WAVES_AROUND:
            continue
        low, high = 0.0, highest
        while high - low > 1e-4 * highest:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if around(middle) <= MOST_WAVES_AROUND else (low, middle)
        is_response = isinstance(analysis, Response)
        yield problem_at(
            ("analysis", index, "omega" if is_response else "highest_omega"),
            highest,
            f"waves so much shorter than the radius of {radius:g} m, k R = {around(highest):.3g}, are scattered in "
            f"about {ceil(around(highest))} azimuthal orders, too many to be solved",
            allowed=f"at most {low:.4g} rad/s, where k R = {MOST_WAVES_AROUND:g}",
            remedy="Leave out the higher frequencies" if is_response else "Give a lower highest_omega",
        )


def _drawn(scene: TankParts) -> str:
    return "the bodies" if scene.kind == "sea" else "the drawn length"


def resonance_regions_are_covered_by_theory(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield resonance analyses beyond the sector to which the waves of finite depth are continued analytically."""
    finite = [layer.depth for layer in scene.layers if not isinf(layer.depth)]
    for index, analysis in enumerate(scene.analysis if scene.is_open and finite else ()):
        if isinstance(analysis, Resonance) and analysis.largest_damping > MOST_DAMPING_ANYWHERE:
            yield problem_at(
                ("analysis", index, "largest_damping"),
                analysis.largest_damping,
                "such strongly damped resonances are computed in infinite depths only, and one here is finite",
                allowed=f"at most {MOST_DAMPING_ANYWHERE:g}",
                remedy=f"Ask for at most {MOST_DAMPING_ANYWHERE:g}, or make each depth inf",
            )


def _nothing_lies_above_an_infinite_liquid(scene: TankParts) -> Iterator[InitErrorDetails]:
    if len(scene.layers) < 2 or not isinf(scene.layers[1].depth):
        return
    if scene.tank.top != "free":
        yield problem_at(
            (scene.kind, "top"),
            scene.tank.top,
            "the upper liquid is infinitely deep, so this has no effect",
            remedy="Leave it out, or give the upper liquid a finite depth",
        )
    for index, body in enumerate(scene.body):
        if body.at == "surface":
            yield problem_at(
                ("body", index, "at"),
                body.at,
                "the upper liquid is infinitely deep, so it has no surface",
                allowed='"interface"',
            )


def bodies_are_all_sections_or_all_solids(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield sections, per metre of width, beside solids of revolution, and what only sections have."""
    for index, body in enumerate(scene.body if scene.is_revolved else ()):
        if not isinstance(body, RevolvedFloat | SeaPlate):
            what = ("kind", body.kind) if body.kind != "float" else ("shape", body.shape)
            yield problem_at(
                ("body", index, what[0]),
                what[1],
                "it is a section, per metre of width, and other bodies of the scene are solids of revolution",
                allowed=", ".join(f'"{shape}"' for shape in SOLID_SHAPES) + " beside these",
                remedy="Put sections and solids into scenes of their own",
            )
    for index, analysis in enumerate(scene.analysis if scene.is_revolved else ()):
        if isinstance(analysis, Resonance) and analysis.largest_damping > MOST_DAMPING_ANYWHERE:
            yield problem_at(
                ("analysis", index, "largest_damping"),
                analysis.largest_damping,
                "such strongly damped resonances are computed for sections only",
                allowed=f"at most {MOST_DAMPING_ANYWHERE:g}",
            )


def plan_views_are_of_waves_solved_for(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield frequencies of fields about solids, of which the waves that come are drawn in plan, that do not exist."""
    for index, analysis in enumerate(scene.analysis if scene.is_revolved else ()):
        asked = getattr(analysis, "fields_at", ())
        if isinstance(analysis, Response) and len(scene.liquid) == 1 and analysis.waves_from == "left":
            for omega in asked:
                if not any(isclose(omega, one) for one in analysis.omega):
                    yield problem_at(
                        ("analysis", index, "fields_at"),
                        omega,
                        "the response is not solved for there",
                        allowed="the frequencies of omega",
                    )
        elif asked:
            yield problem_at(
                ("analysis", index, "fields_at"),
                list(asked),
                "of solids of revolution only the response to waves from the left in one liquid is drawn, in plan",
                remedy="Leave it out",
            )


def open_water_beams_have_free_ends(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield beams with guided ends, which need walls."""
    for index, beam in scene.beams:
        if scene.is_open and beam.ends == "guided":
            yield problem_at(
                ("body", index, "ends"),
                beam.ends,
                "ends are guided by walls, and open water has none",
                allowed='"free"',
            )


def decaying_bodies_are_floats(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield releases of bodies that are not floats, or in motions that the float does not have."""
    for index, analysis in enumerate(scene.analysis):
        released = analysis.displacement if isinstance(analysis, Decay | Motion) else None
        if not isinstance(analysis, Decay | Motion) or released is None:
            continue
        which = analysis.body or 1
        numbers = [str(number + 1) for number, _ in scene.floats]
        body = scene.body[which - 1] if which <= len(scene.body) else None
        if not isinstance(body, AnyFloat):
            other = f"it is a {name_of_body(body)}, and only floats are released" if body is not None else None
            yield problem_at(
                ("analysis", index, "body"),
                which,
                other or "there is no body of that number",
                allowed=" or ".join(numbers) if numbers else "none: this scene has no float",
            )
            continue
        for motion, value in released.amounts.items():
            if value != 0.0 and motion not in body.motions:
                yield problem_at(
                    ("analysis", index, "displacement", motion),
                    value,
                    f"[[body]] number {which} does not move so: its motions are {', '.join(body.motions)}",
                    remedy=f'Add "{motion}" to its motions, or release it from another displacement',
                )


def drag_is_heeded(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield analyses whose motion has no known amplitude, on which quadratic damping depends."""
    if not any(any(one.quadratic_damping) for one in scene.attachment):
        return
    for index, analysis in enumerate(scene.analyses):
        if isinstance(analysis, Response) and analysis.wave_amplitude is None:
            yield problem_at(
                ("analysis", index, "wave_amplitude"),
                None,
                "it is missing, and quadratic damping depends on it",
                allowed="the amplitude of the waves, m",
            )
        elif isinstance(analysis, Decay | Resonance):
            yield problem_at(
                ("analysis", index, "kind") if scene.analysis else ("analysis",),
                analysis.kind,
                "a free motion with quadratic damping is not a sum of exponentials",
                remedy='Leave out quadratic_damping, or ask for kind = "motion" with a displacement',
            )


def depths_can_be_meshed(scene: TankParts, extent: float) -> Iterator[InitErrorDetails]:
    """Yield finite depths beside which double precision has no places for cells of bodies of an extent, m."""
    deepest = _DEEPEST * extent
    for index, layer in enumerate(scene.layers):
        if layer.depth < inf and not is_at_most(layer.depth, deepest):
            yield problem_at(
                ("liquid", index, "depth"),
                layer.depth,
                "the layer is too deep to mesh beside the bodies",
                allowed=f"at most {shown_most(deepest)} m, or inf",
            )


def length_scale_of_bodies(scene: TankParts) -> float:
    """Return the length to which sizes of bodies are relative, m: of the tank, or of the extent of bodies.

    Floats count by their position.
    """
    if not scene.is_open:
        return scene.tank.length
    return max(body.end for body in scene.body) - min(body.start for body in scene.body)
