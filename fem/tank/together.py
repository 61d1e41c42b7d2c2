"""First attempts at tanks that share a liquid, made together.

What is done for each of many small problems takes as long as its calls: in stacked arrays there is one call for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.bodies.registry import toned_bodies
from hydroelastic.fem.dense_modes import DenseSolution
from hydroelastic.fem.inertia import shared_counts
from hydroelastic.fem.shared_answer import SharedAnswer
from hydroelastic.fem.shared_modes import LiquidErrors, solved_together
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.fem.tank.elastic_tone import participations
from hydroelastic.fem.tank.field_solution import (
    FieldSolution,
    Origin,
    PartPencils,
    counted_below,
    counts_agree,
    share_of_modes,
    solve_parts,
)
from hydroelastic.fem.tank.liquids import FirstAttempt, SharedLiquids
from hydroelastic.fem.tank.released_beam import released_modes
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank


def attempt_together(liquids: SharedLiquids, tanks: Sequence[Tank], *, tolerance: float, modes: int) -> None:
    """Make the first attempts at some tanks, with which `solve_tank` then goes on; earlier ones are forgotten.

    Where one of them fails, none is made: `solve_tank` then makes each, and tells which it was.

    Args:
        liquids: of all of them.
        tanks: in SI units.
        tolerance: as that of `solve_tank`.
        modes: the same.
    """
    watch = Stopwatch()
    liquids.begun.clear()
    with watch.stage("plan"):
        attempts = [liquids.first_attempt(tank, tolerance, modes) for tank in tanks]
    try:
        made = _made(liquids, attempts, modes, watch)
    except (EigenSolverError, np.linalg.LinAlgError):
        return
    seconds = {stage: value / len(tanks) for stage, value in watch.seconds.items()}
    for tank, attempt in zip(tanks, made, strict=True):
        liquids.begun[tank, tolerance, modes] = replace(attempt, seconds=seconds)


def _made(liquids: SharedLiquids, attempts: list[FirstAttempt], modes: int, watch: Stopwatch) -> list[FirstAttempt]:
    """The attempts, with what can be made of all of them at once."""
    with watch.stage("pressure release"):
        tanks, count = [attempt.tank for attempt in attempts], liquids.of_limit.shapes[0]
        released = zip(tanks, released_modes(tanks, count), strict=True)
        liquids.released_modes = {(tank, count): found for tank, found in released}
    with watch.stage("assemble"):
        problems = [_problems(liquids, attempt) for attempt in attempts]
    if not all(isinstance(one.answer, SharedAnswer) for _, pencils in problems for one in pencils.values()):
        return attempts
    with watch.stage("solve"):
        fields = _fields(attempts, problems)
    with watch.stage("count"):
        counted = _counted(fields)
    with watch.stage("errors"):
        _estimate(fields, [_asked(tank, field, modes) for tank, field in zip(tanks, fields, strict=True)])
    return [
        replace(attempt, field=field, counted=confirmed)
        for attempt, field, confirmed in zip(attempts, fields, counted, strict=True)
    ]


def _problems(liquids: SharedLiquids, attempt: FirstAttempt) -> tuple[TankMesh, PartPencils]:
    mesh = liquids.mesh(MPI.COMM_WORLD, attempt.tank, attempt.resolution, half=attempt.half)
    degree, shapes = attempt.resolution.degree, attempt.resolution.shapes
    return mesh, liquids.pencils(mesh, attempt.tank, degree, shapes, half=attempt.half)


def _fields(attempts: list[FirstAttempt], problems: list[tuple[TankMesh, PartPencils]]) -> list[FieldSolution]:
    """The modes of all, those with one basis for the surfaces at once."""
    counts = [attempt.resolution.modes + 1 for attempt in attempts]
    alike: dict[object, list[tuple[int, Parity | None, int]]] = {}
    for place, ((_, pencils), count) in enumerate(zip(problems, counts, strict=True)):
        share = share_of_modes(len(pencils), count)
        for parity, pencil in pencils.items():
            assert isinstance(pencil.answer, SharedAnswer)
            key = (id(pencil.answer.projection(share)), *pencil.free_rigid)
            alike.setdefault(key, []).append((place, parity, share))
    known: list[dict[Parity | None, DenseSolution]] = [{} for _ in problems]
    for group in alike.values():
        together = [problems[place][1][parity] for place, parity, _ in group]
        answer = together[0].answer
        assert isinstance(answer, SharedAnswer)
        found = solved_together(together, answer, max(share for _, _, share in group))
        for (place, parity, _), solution in zip(group, found, strict=True):
            known[place][parity] = solution
    return [
        solve_parts(mesh, attempt.tank, attempt.resolution.shapes, pencils, count, of_parts)
        for attempt, (mesh, pencils), count, of_parts in zip(attempts, problems, counts, known, strict=True)
    ]


def _by_answer(fields: Sequence[FieldSolution]) -> list[tuple[SharedAnswer, list[tuple[int, int]]]]:
    """The answers of the liquid, each with the places of fields and of their parts that have it."""
    found: dict[int, tuple[SharedAnswer, list[tuple[int, int]]]] = {}
    for place, field in enumerate(fields):
        for number, part in enumerate(field.parts):
            answer = part.pencil.answer
            assert isinstance(answer, SharedAnswer)
            found.setdefault(id(answer), (answer, []))[1].append((place, number))
    return list(found.values())


def _counted(fields: list[FieldSolution]) -> list[bool | None]:
    """Whether the inertia confirms the number of modes; ``None`` where that remains to be asked."""
    shifts = [counted_below(field.modes.eigenvalues) for field in fields]
    counts: dict[tuple[int, int], int | None] = {}
    for answer, places in _by_answer(fields):
        pencils = [fields[place].parts[number].pencil for place, number in places]
        counts |= zip(places, shared_counts(pencils, answer, [shifts[place] for place, _ in places]), strict=True)
    confirmed: list[bool | None] = []
    for place, field in enumerate(fields):
        below = [counts[place, number] for number in range(len(field.parts))]
        known = [count for count in below if count is not None]
        confirmed.append(counts_agree(field, shifts[place], known) if len(known) == len(below) else None)
    return confirmed


def _asked(tank: Tank, field: FieldSolution, modes: int) -> list[Origin]:
    """The modes asked for, and those of the first elastic tones."""
    tones = [int(np.argmax(participations(field.modes, field.bodies, body))) for body in toned_bodies(tank)]
    lowest = range(min(modes, len(field.origins)))
    return [field.origins[index] for index in sorted({*lowest, *tones})]


def _estimate(fields: list[FieldSolution], asked: list[list[Origin]]) -> None:
    """Estimate the errors of some modes of each."""
    for _, places in _by_answer(fields):
        LiquidErrors.estimate_together(
            (errors, [index for part, index in asked[place] if part == number])
            for place, number in places
            if isinstance(errors := fields[place].parts[number].modes.liquid_errors, LiquidErrors)
        )
