"""Fields of open water that are written and drawn, a few for each analysis.

Forces and motions need a basin close around the bodies; a picture shows the whole length of the scene. Each field is
therefore solved for once more, in a basin of that length, to the accuracy of a picture. The frequencies are those of
the tables:

    radiation    for each motion of a body, where its damping is largest, or as asked
    response     where the motion of a body is largest, for the incident wave that causes it, or as asked
    resonance    each of the resonances of lowest |ω|
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from math import log

import numpy as np

from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.incident_waves import Plane
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.region import MOST_DAMPING_ANYWHERE
from hydroelastic.fem.open_water.resonance import ANGLE
from hydroelastic.fem.open_water.resonance_search import Eigenpair, ResonanceSearch
from hydroelastic.fem.open_water.results import RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.solver_error import EigenSolverError

# Motions and resonances of one analysis that are shown.
_MOST_FIELDS = 4
# Largest extent of a picture to each side of the bodies, in radians of the shortest wave.
_RADIANS = 75.0
# Largest factor by which waves of a resonance grow outwards in a picture.
_GROWTH = 12.0
# Largest relative difference of λ from that of the table.
_SAME = 1e-2


@dataclass(frozen=True, kw_only=True)
class OpenField:
    """A motion e^{−iωt} of open water, distributed over the processes, in units of the basin."""

    name: str  # name of its files
    title: str  # one line of text
    amplitude: str  # scale of the motion, as text
    model: OpenModel  # the problem
    squared: complex
    potential: np.ndarray  # ψ of the radiated and scattered waves, complex, own free unknowns, shape (free unknowns,)
    bodies: np.ndarray  # body unknowns, complex, shape (body unknowns,)
    metres: float  # displacement in m per dimensionless displacement
    incident: tuple[Plane, complex] | None = None  # the incident wave and its amplitude c, which are part of the field


def open_fields(problem: OpenWaterProblem, solution: OpenWaterSolution) -> Iterator[tuple[str, Iterator[OpenField]]]:
    """Yield each analysis by its name with its fields, which are solved for one after the other (collective)."""
    for number, radiation in enumerate(solution.radiation, 1):
        yield f"radiation {number}", _radiated(problem, radiation, number)
    for number, response in enumerate(solution.response, 1):
        yield f"response {number}", _responding(problem, response, number)
    for number, resonance in enumerate(solution.resonance, 1):
        yield f"resonance {number}", _resonant(problem, resonance, number)


def _model(
    problem: OpenWaterProblem,
    lowest: float,
    highest: float,
    *,
    motions: int,
    radians: float = _RADIANS,
    angle: float | None = None,
) -> OpenModel:
    """Model of the length of a picture, for a range of |ω|; beams have at least ``motions`` dry modes (collective)."""
    rough, band = problem.rough(), Band(lowest=lowest, highest=highest)
    resolution = first_resolution(rough.tank, rough.tolerance, band, drawn=radians)
    shapes = tuple(max(count, motions) if count else 0 for count in resolution.shapes)
    resolution = replace(resolution, shapes=shapes)
    return open_model(rough, band, resolution, angle=angle, drawn=radians)


def _radiated(problem: OpenWaterProblem, table: RadiationTable, number: int) -> Iterator[OpenField]:
    """Motions of 1 m or 1 rad at the frequencies of largest damping, or at those asked for."""
    waves = np.isfinite(table.omega) & (table.omega > 0.0)
    damping = np.where(waves[:, None], np.diagonal(table.radiation_damping, axis1=1, axis2=2), 0.0)
    shown = [place for place in range(len(table.dofs)) if damping[:, place].max(initial=0.0) > 0.0][:_MOST_FIELDS]
    if not shown:
        return
    peaks = [(place, (float(table.omega[np.argmax(damping[:, place])]),)) for place in shown]
    asked = [(place, table.fields_at or own) for place, own in peaks]
    known = [omega for _, omegas in asked for omega in omegas]
    model = _model(problem, min(known), max(known), motions=max(shown) + 1)
    solver, why = OpenSolver(model), "" if table.fields_at else _why("damping is largest", table)
    radiation = cache(solver.radiation)
    for place, omegas in asked:
        dof = table.dofs[place]
        # Beams have more shapes here than the table may report.
        own = model.scale.dofs.index(dof)
        bodies = np.linalg.inv(model.scale.turn)[:, own].astype(complex)
        for number_of_field, omega in enumerate(omegas, 1):
            squared = model.squared_frequency(omega)
            yield OpenField(
                name=f"radiation_{number}_{dof.replace(' ', '_')}"
                + (f"_{number_of_field:03d}" if len(omegas) > 1 else ""),
                title=f"Radiation by {dof.words} at ω = {omega:.5g} rad/s, T = {2.0 * np.pi / omega:.4g} s{why}",
                amplitude=_unit_motion(model, own),
                model=model,
                squared=squared,
                potential=bodies @ radiation(squared),
                bodies=bodies,
                metres=_metres(model, own),
            )


def _responding(problem: OpenWaterProblem, table: ResponseTable, number: int) -> Iterator[OpenField]:
    """Incident waves with the motions and scattered waves that they cause, per metre of incident elevation."""
    row, wave = _largest_response(problem.tank.length, table)
    omegas = table.fields_at or (float(table.omega[row]),)
    model = _model(problem, min(omegas), max(omegas), motions=0)
    solver = OpenSolver(model)
    solver.elevation = table.wave_amplitude
    for place, omega in enumerate(omegas, 1):
        name = f"response_{number}" + (f"_{place:03d}" if len(omegas) > 1 else "")
        yield _in_waves(solver, table, omega, wave, name)


def _in_waves(solver: OpenSolver, table: ResponseTable, omega: float, wave: int, name: str) -> OpenField:
    model, count = solver.model, len(table.waves)
    place = wave + (0 if table.waves_from == "left" else count)
    found = solver.response(omega, [place])
    incidence, drags = found.incidence, model.outside.drag
    # The crest of the incident wave passes x = 0 of the scene at t = 0.
    unit = 1.0 / (incidence.elevations[place] * np.exp(1j * incidence.phases_at_origin(model.basin)[place]))
    kind = f"{table.waves[wave]} waves" if count > 1 else "waves"
    why = "" if table.fields_at else _why("motion is largest", table)
    return OpenField(
        name=name,
        title=f"Response to {kind} from the {table.waves_from} at ω = {omega:.5g} rad/s, "
        f"T = {2.0 * np.pi / omega:.4g} s{why}",
        amplitude="incident wave of 1 m" + (f", damped as in one of {table.wave_amplitude:g} m" if len(drags) else ""),
        model=model,
        squared=found.squared,
        potential=unit * found.scattered[0],
        bodies=unit * found.motions[0],
        metres=1.0,
        incident=(plane, complex(unit)) if isinstance(plane := incidence.planes[place], Plane) else None,
    )


def _largest_response(length: float, table: ResponseTable) -> tuple[int, int]:
    """Indices of the frequency and the wave of the largest motion of a body; rotations count with an arm of half the
    length."""
    arms = np.array([0.5 * length if dof.is_rotation else 1.0 for dof in table.dofs])
    sizes = (np.abs(table.amplitudes) * arms).max(axis=2)
    row, wave = np.unravel_index(int(np.argmax(sizes)), sizes.shape)
    return int(row), int(wave)


def _resonant(problem: OpenWaterProblem, table: ResonanceTable, number: int) -> Iterator[OpenField]:
    """The resonances of lowest |ω|, each with its dominant motion of 1 m or 1 rad; without those that are not found
    again, or are so strongly damped that their waves grow too much outwards."""
    places = [place for place, omega in enumerate(table.omega) if -omega.imag <= MOST_DAMPING_ANYWHERE * omega.real]
    shown = {place: complex(table.omega[place]) for place in places[:_MOST_FIELDS]}
    if not shown:
        return
    omegas = list(shown.values())
    sizes = [abs(omega) for omega in omegas]
    motions = 1 + max(table.dofs.index(table.labels[place]) for place in shown)
    # k ~ ω²: Im k/Re k is twice Im ω/Re ω.
    fastest = max(-2.0 * omega.imag / omega.real for omega in omegas)
    radians = min(_RADIANS, log(_GROWTH) / fastest)
    model = _model(problem, min(sizes), max(sizes), motions=motions, radians=radians, angle=ANGLE)
    search = ResonanceSearch(model.pencil, model.stiffness, model.mass, model.outside.damping)
    for place, omega in shown.items():
        label = table.labels[place]
        pair = _found_again(search, model.squared_frequency(omega))
        if pair is None:
            continue
        own = model.scale.dofs.index(label)
        unit = 1.0 / (model.scale.turn @ pair.bodies)[own]
        yield OpenField(
            name=f"resonance_{number}_{place + 1:03d}",
            title=f"Resonance {place + 1}: ω = {omega.real:.5g} − {-omega.imag:.3g}i rad/s, "
            f"T = {2.0 * np.pi / omega.real:.4g} s, {label.words}",
            amplitude=_unit_motion(model, own),
            model=model,
            squared=pair.eigenvalue,
            potential=unit * pair.potential,
            bodies=unit * pair.bodies,
            metres=_metres(model, own),
        )


def _found_again(search: ResonanceSearch, squared: complex) -> Eigenpair | None:
    """The resonance of a λ in another basin (collective)."""
    try:
        pair = search.refined(squared)
    except EigenSolverError:
        return None
    return pair if abs(pair.eigenvalue / squared - 1.0) <= _SAME else None


def _why(reason: str, table: RadiationTable | ResponseTable) -> str:
    return f", where {reason}" if len(table.omega) > 1 else ""


def _metres(model: OpenModel, motion: int) -> float:
    """Metres per dimensionless displacement, for a motion of 1 m or 1 rad."""
    return float(model.basin.units.length / model.scale.lengths[motion])


def _unit_motion(model: OpenModel, motion: int) -> str:
    name = model.scale.dofs[motion]
    return f"{name.words} of 1 {'rad' if name.is_rotation else 'm'}"
