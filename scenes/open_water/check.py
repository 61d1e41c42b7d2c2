"""Description of the analyses of open water and of the outgoing waves, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, isfinite, log10, pi, sqrt

from hydroelastic.fem.cost import cost
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.high_frequency import highest_meshed_frequency
from hydroelastic.fem.open_water.low_frequency import lowest_meshed_frequency
from hydroelastic.fem.open_water.model_building import first_size
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.output.open_water.tables import infinite_draught_message
from hydroelastic.output.sections import Section
from hydroelastic.scenes.errors import cannot_be_meshed
from hydroelastic.scenes.models.open_analyses import (
    Analysis,
    Decay,
    ImpulseResponse,
    Motion,
    Radiation,
    Resonance,
    Response,
)
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.sea_states import Spectrum
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.models.time_analyses import Release
from hydroelastic.scenes.open_water.results import infinite_draught_comparison
from hydroelastic.scenes.tank.check import modelled_tank

# Lowest frequency of a search for resonances over the highest, roughly.
_LOWEST_TONE = 0.1
# Solutions at other frequencies for each analysis, the least and for each digit of the tolerance; measured.
_LEAST_SOLUTIONS, _SOLUTIONS_OF_A_DIGIT = 14.0, 2.5


def check_open(scene: TankParts) -> Iterator[Section]:
    """Yield the description of open water, the analyses, their cost and the outgoing waves; one mesh is made."""
    waves = Section(title="Outgoing waves", lines=tuple(open_waves(scene)))
    return modelled_tank(scene, requests=open_requests(scene), scale=waves)


def open_requests(scene: TankParts) -> Iterator[str]:
    """Yield a line for each analysis of a scene with open ends."""
    yield f"Open water, to a relative error of {scene.accuracy.tolerance:g}:"
    for number, analysis in enumerate(scene.analyses, 1):
        yield f"  {number}. {_request(scene, analysis)}"
    yield from _sizes(scene)
    infinite = infinite_draught_comparison(scene)
    if infinite is not None:
        yield infinite_draught_message(infinite)


def _sizes(scene: TankParts) -> Iterator[str]:
    """Yield the size of the first mesh of the analyses over the frequency, which is made, and the cost of all."""
    tolerance, water = scene.accuracy.tolerance, physical_tank(scene)
    water = water.of_order(min(water.orders))
    bands = [band for one in scene.analyses if (band := getattr(one.request, "band", None)) is not None]
    bands += [
        (_LOWEST_TONE * one.below, one.below) for one in scene.analyses if isinstance(one, Resonance) and one.below
    ]
    # Whether there is a mesh does not depend on the frequency.
    asked = bands or [2 * (sqrt(water.gravity / (scene.stretch[1] - scene.stretch[0])),)]
    band = Band(lowest=min(low for low, _ in asked), highest=max(high for _, high in asked))
    orders = 1
    if scene.is_revolved and any(isinstance(one, Response | Spectrum) for one in scene.analyses):
        radius = max(right for _, right in (body.waterplane for body in water.bodies))
        orders = ceil(band.wavenumbers(water)[1] * radius) + 2
    timed = [one.request for one in scene.analyses if isinstance(one, Decay | Motion | ImpulseResponse)]
    latest = max((time for request in timed for time in request.times), default=0.0)
    try:
        cells, degree, unknowns = first_size(water, tolerance, band)
        if bands:
            each = f", in each of about {orders} azimuthal orders" if orders > 1 else ""
            yield (
                f"First mesh, for frequencies from {band.lowest:.4g} to {band.highest:.4g} rad/s: degree {degree}, "
                f"{cells} triangles, {unknowns} unknowns of ψ{each}."
            )
        if latest:
            at_rest = [body.hydrostatics for body in water.floats.values()]
            fastest = max((sqrt(0.5 * one.heave_stiffness / one.mass) for one in at_rest), default=band.highest)
            lowest = min(band.lowest, lowest_meshed_frequency(water, latest))
            band = Band(lowest=lowest, highest=highest_meshed_frequency(fastest, tolerance))
            _, degree, unknowns = first_size(water, tolerance, band)
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    solutions = len(scene.analyses) * (_LEAST_SOLUTIONS - _SOLUTIONS_OF_A_DIGIT * log10(tolerance))
    # Most orders need fewer solutions than the first ones.
    solutions *= 0.3 + 0.7 / orders
    yield str(cost(unknowns, degree, solutions, "sea", parts=orders))


def _request(scene: TankParts, analysis: Analysis) -> str:
    if isinstance(analysis, Radiation):
        shapes = f"; of beams in heave, pitch and {analysis.elastic_modes} elastic shapes" if scene.beams else ""
        if scene.plates:
            shapes = f"; of plates in heave, pitch and the {analysis.elastic_modes} lowest elastic shapes of all orders"
        return (
            f"radiation: added mass, radiation damping and excitation forces at {_span(analysis.omega, 'frequency')} "
            f"rad/s{shapes}"
        )
    if isinstance(analysis, Response):
        waves = "scattered waves" if scene.is_revolved else "reflection and transmission"
        return (
            f"response: motions, {waves} in waves from the {analysis.waves_from} at "
            f"{_span(analysis.omega, 'frequency')} rad/s"
        )
    if isinstance(analysis, Decay):
        return f"decay: {_release(analysis.body, analysis.displacement)}; {_span(analysis.times, 'time')} s"
    if isinstance(analysis, ImpulseResponse):
        return f"impulse response: of the radiated waves at {_span(analysis.times, 'time')} s"
    if isinstance(analysis, Motion):
        start = "from rest" if analysis.displacement is None else _release(analysis.body or 1, analysis.displacement)
        waves = "still water" if analysis.is_in_still_water else f"{analysis.words}, from the {analysis.waves_from}"
        return f"motion: {start} in {waves}; {_span(analysis.times, 'time')} s"
    if isinstance(analysis, Spectrum):
        return (
            f"spectrum: statistics of the responses in {analysis.duration:g} s of irregular waves from the "
            f"{analysis.waves_from}, {analysis.words}"
        )
    return _resonances(scene, analysis)


def _release(body: int, start: Release) -> str:
    units = {"roll": "rad", "pitch": "rad"}
    motions = " and ".join(
        f"{value:g} {units.get(name, 'm')} in {name}" for name, value in start.amounts.items() if value
    )
    return f"float {body} is released at {motions}"


def _resonances(scene: TankParts, analysis: Resonance) -> str:
    which = f"at most {analysis.count} with Re ω below {analysis.below:g} rad/s" if analysis.below else "the lowest"
    how_many = "" if analysis.below else f" {analysis.count}"
    unasked = (scene.beams or scene.plates) and not analysis.below
    short = "; elastic tones among waves far shorter than the bodies only with below" if unasked else ""
    return f"resonance: {which}{how_many}, with −Im ω up to {analysis.largest_damping:g} Re ω{short}"


def _span(values: tuple[float, ...], what: str) -> str:
    if len(values) == 1:
        return f"one {what}, {values[0]:g}"
    plural = {"frequency": "frequencies", "time": "times"}[what]
    return f"{len(values)} {plural} from {min(values):g} to {max(values):g}"


def open_waves(scene: TankParts) -> Iterator[str]:
    """Yield the lengths of the outgoing waves, m, at the lowest and the highest requested frequency."""
    asked = [
        omega
        for analysis in scene.analyses
        if isinstance(analysis, Radiation | Response)
        for omega in analysis.omega
        if omega > 0.0 and isfinite(omega)
    ]
    layers = two_layers(physical_tank(scene))
    for omega in sorted({min(asked), max(asked)}) if asked else ():
        lengths = [f"{wave.branch} {2.0 * pi / wave.wavenumber:.4g} m" for wave in travelling_waves(layers, omega)]
        yield f"Lengths of outgoing waves at {omega:g} rad/s: {', '.join(lengths)}."
    if scene.kind == "tank":
        yield "The length of the tank is that of the drawn region: results do not depend on it."
