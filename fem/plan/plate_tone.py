"""The first elastic tone of a plate on a plan, and its companion with ψ = 0 on the water.

It is the mode with the largest part of the plate's softest dry mode, in that shape's symmetry class. If it is not
among the modes that were asked for, more of this class are solved, until no higher one can have a larger part.

With ψ = 0 on the water ψ ~ r^{1/2} at the edges, and the error falls like the thickness of the innermost layer: from
two numbers of layers follows the limit, and from a third one its error. Tones of one class are found together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, inf, pi

import numpy as np

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.closed.tones import ElasticTone, elastic_tone
from hydroelastic.fem.level_bed.solution import PlateTone
from hydroelastic.fem.mode_set import ModeSet
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import ClassModes, SymmetryClass
from hydroelastic.fem.plan.plan import PlanModel, PlanResolution, plan_resolution
from hydroelastic.fem.plan.polynomials import water_wavenumber
from hydroelastic.fem.plan.released import released_tones
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import FIRST_ELASTIC, body_name
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.plate import Plate

# More modes of one class up to the tone are not searched.
_MOST_MODES = 120
_ROUNDS = 3
# Of successive layers at an edge.
_RATIO = 0.2
# The tone with ψ = 0 is computed to this at most and at least.
_RELEASED_FINEST, _RELEASED_COARSEST = 1e-5, 1e-3
# The three resolutions show the difference of the limits of the first two and of the last two, which are closer to each
# other than to the truth where the series of powers of the thickness has not yet begun.
_SAFETY = 2.0
# Both limits may by chance be closer to each other than to the truth: the error is at least this part of the distance
# from the last value; measured 0.07 of a soft rectangle.
_OF_LIMIT = 0.1


@dataclass(frozen=True, kw_only=True)
class _Found:
    """Tones of one class at one resolution, with λ and the errors by cause, shape (causes, tones)."""

    tones: list[ElasticTone]
    eigenvalues: FloatArray
    errors: FloatArray

    @property
    def relative_errors(self) -> FloatArray:
        """Of their frequencies."""
        return np.asarray(self.errors.sum(axis=0))


def class_tones(
    model: PlanModel, found: ClassModes, errors: np.ndarray, tolerance: float, *, has_water: bool
) -> list[PlateTone]:
    """Return the first elastic tones of all elastic plates (collective)."""
    dry = _dry_tones(model.tank, found)
    if has_water:
        for number in sorted({number for number, _, _ in dry}):
            own = [at for at, (other, _, _) in enumerate(dry) if other == number]
            released = _released(model, found.classes[number].parity, [dry[at][2] for at in own], tolerance)
            for at, tone in zip(own, released, strict=True):
                dry[at] = (*dry[at][:2], tone)
    tones = [_listed(found, errors, number, place, tone) for number, place, tone in dry]
    for number in sorted({number for number, _, _ in dry}):
        own = [at for at, (other, _, _) in enumerate(dry) if other == number and tones[at] is None]
        sought = _sought(model, found.classes[number], [dry[at][1:] for at in own], tolerance)
        for at, tone in zip(own, sought, strict=True):
            tones[at] = tone
    return [tone for tone in tones if tone is not None]


def listed_tones(
    tank: LevelTank, found: ClassModes, errors: np.ndarray, _tolerance: float, *, has_water: bool
) -> list[PlateTone]:
    """Return the first elastic tones that are among the modes that were solved; see `class_tones`."""
    return [
        _listed(found, errors, number, place, tone)
        or replace(tone, reason="it may lie above the modes that were solved; ask for more modes")
        for number, place, tone in _dry_tones(tank, found)
    ]


def _dry_tones(tank: LevelTank, found: ClassModes) -> list[tuple[int, int, PlateTone]]:
    """Of each elastic plate the class of its softest dry mode, its place in it, and what is known of the tone dry."""
    tones = []
    for plate in (index for index, one in enumerate(tank.plates) if one.is_elastic):
        number, place, first = _softest(found, plate)
        one = found.classes[number]
        body = one.pencil.bodies[place]
        stiffness, mass = float(body.stiffness[first]), float(body.mass[first, first])
        tone = PlateTone(
            plate=plate,
            order=None,
            dry=stiffness / mass if mass else inf,
            squares=_squares(body, first, tank.plates[plate]),
            stiffness=stiffness,
            mass=mass,
            symmetry=one.label,
        )
        tones.append((number, place, tone))
    return tones


def _listed(found: ClassModes, errors: np.ndarray, number: int, place: int, tone: PlateTone) -> PlateTone | None:
    """The tone among the modes that were asked for; ``None`` if it is not certain to be there."""
    one = found.classes[number]
    if not len(one.modes.eigenvalues):
        return None
    known = _guess(one.modes, one.pencil, place, tone)
    index = (number, known.index)
    if not known.certain or index not in found.origins:
        return None
    return replace(
        tone,
        tone=known,
        eigenvalue=float(one.modes.eigenvalues[known.index]),
        relative_error=float(errors[found.origins.index(index)]),
    )


def _squares(body: Body, first: int, plate: Plate) -> float:
    """∫W² of a shape, from its mass or its hydrostatic stiffness; else that of a mean square of 1."""
    if plate.mass_per_area:
        return float(body.mass[first, first]) / plate.mass_per_area
    if plate.hydrostatic:
        return float(body.stiffness[first] - body.bending_stiffness[first])
    return plate.outline.area


def _softest(found: ClassModes, plate: int) -> tuple[int, int, int]:
    """The class of a plate's softest elastic dry mode, the place of the plate in it, and that of the mode."""
    candidates = [
        (float(body.bending_stiffness[body.dofs.index(FIRST_ELASTIC)]), number, place, body.dofs.index(FIRST_ELASTIC))
        for number, one in enumerate(found.classes)
        for place, body in enumerate(one.pencil.bodies)
        if body.surface == body_name(plate + 1) and FIRST_ELASTIC in body.dofs
    ]
    return min(candidates)[1:]


def _sought(
    model: PlanModel, one: SymmetryClass, wanted: list[tuple[int, PlateTone]], tolerance: float
) -> list[PlateTone]:
    """Tones of plates at some places of a class among more of its modes."""
    area = model.tank.plan.area / 2.0 ** sum(own is not None for own in one.parity)
    count = len(one.modes.eigenvalues)
    for _, tone in wanted:
        if tone.pressure_release is not None:
            # Weyl's law for water; waves in stiff plates are fewer.
            wavenumber = water_wavenumber(model.tank, tone.pressure_release)
            count = max(count, ceil(1.1 * area * wavenumber**2 / (4.0 * pi)) + 6)
    found: dict[int, PlateTone] = {}
    left = dict(wanted)
    while left and count <= _MOST_MODES:
        modes = solve_modes(one.pencil, count, shapes=0, tolerance=1e-8)
        guesses = {place: _guess(modes, one.pencil, place, tone) for place, tone in left.items()}
        certain = {place: left.pop(place) for place, guess in guesses.items() if guess.certain}
        if certain:
            highest = max(float(modes.eigenvalues[guesses[place].index]) for place in certain)
            found |= _resolved(model, one, certain, highest, count, tolerance)
        if len(modes.eigenvalues) < count:
            break
        count = ceil(1.6 * count)
    reason = f"it lies above more than {_MOST_MODES} modes of its symmetry, or is spread over them"
    for place, tone in left.items():
        further = "" if tone.pressure_release is None else "; see the pressure-release tone"
        found[place] = replace(tone, reason=reason + further)
    return [found[place] for place, _ in wanted]


def _guess(modes: ModeSet, pencil: CoupledPencil, place: int, tone: PlateTone) -> ElasticTone:
    values, amplitudes = modes.eigenvalues, modes.elastic_amplitudes
    return elastic_tone(values, amplitudes, pencil.bodies, place, released=tone.pressure_release)


def _resolved(
    model: PlanModel,
    one: SymmetryClass,
    wanted: dict[int, PlateTone],
    highest: float,
    count: int,
    tolerance: float,
) -> dict[int, PlateTone]:
    """Tones of plates by their places, all up to a λ, to the tolerance."""

    def solve(resolution: PlanResolution) -> _Found:
        pencil, plates = model.problem(resolution, one.parity)
        assert pencil is not None
        modes: ModeSet = solve_modes(pencil, count, shapes=0, tolerance=max(1e-3 * tolerance, 1e-12))
        found = [_guess(modes, pencil, place, tone) for place, tone in wanted.items()]
        again = replace(one, pencil=pencil, modes=modes)
        errors = model.errors(resolution, again, plates, [modes.completed(tone.index) for tone in found])
        return _Found(tones=found, eigenvalues=modes.eigenvalues[[tone.index for tone in found]], errors=errors)

    best = adaptive_solve(
        plan_resolution(model.tank, tolerance, highest),
        solve,
        lambda found: ErrorEstimate(discretization=float(found.relative_errors.max())),
        lambda resolution, found: resolution.refined(found.errors, tolerance),
        tolerance,
        rounds=_ROUNDS,
    ).solution
    known = zip(best.tones, map(float, best.eigenvalues), map(float, best.relative_errors), strict=True)
    return {
        place: replace(tone, tone=own, eigenvalue=value, relative_error=error)
        for (place, tone), (own, value, error) in zip(wanted.items(), known, strict=True)
    }


def _released(model: PlanModel, parity: ClassParity, tones: list[PlateTone], tolerance: float) -> list[PlateTone]:
    """Tones of one class with λ of each with ψ = 0 on the water, and the relative error of its frequency."""
    aim = min(max(tolerance, _RELEASED_FINEST), _RELEASED_COARSEST)
    highest = max(tone.stiffness / (tone.mass + tone.squares) for tone in tones)
    start = plan_resolution(model.tank, aim, highest, released=True)
    values, residuals = [], []
    for more in range(3):
        # The last one has a degree more, so that the error by the degree is seen too.
        resolution = replace(start, layers=start.layers + more, degree=start.degree + int(more == 2))
        problem = model.released(resolution, parity)
        surfaces = [body.surface for body in problem.bodies]
        found = released_tones(problem, [surfaces.index(body_name(tone.plate + 1)) for tone in tones])
        values.append(found.eigenvalues)
        residuals.append(found.errors)
    limits, errors = released_limits(values, start.degree)
    errors += np.max(residuals, axis=0)
    return [
        replace(tone, pressure_release=float(limit), pressure_release_error=float(error))
        for tone, limit, error in zip(tones, limits, errors, strict=True)
    ]


def released_limits(values: Sequence[FloatArray], degree: int) -> tuple[FloatArray, FloatArray]:
    """Return the limit of λ for thin layers, and the relative error of its root.

    Of ψ ~ r^{1/2} the innermost cell of the thickness h and the degree p lacks an energy in proportion to h/p² (I.
    Babuška and M. Suri, SIAM J. Numer. Anal. 24 (1987) 750).
    """
    thicker, thinner, last = values
    ratios = _RATIO, _RATIO * (degree / (degree + 1)) ** 2
    first, limits = (
        after - (before - after) * ratio / (1.0 - ratio)
        for before, after, ratio in zip((thicker, thinner), (thinner, last), ratios, strict=True)
    )
    apart = np.maximum(np.abs(first / limits - 1.0), _OF_LIMIT * np.abs(last / limits - 1.0))
    return limits, _SAFETY * 0.5 * apart
