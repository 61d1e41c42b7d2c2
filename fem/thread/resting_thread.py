"""A thread at rest in space, at given arc lengths, with its estimated errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.profile import ThreadProfile

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class RestingThread:
    """A thread at rest, at given arc lengths ("positions")."""

    positions: Array  # r, m, shape (positions, 3)
    tensions: Array  # T, N, shape (positions,)
    forces: Array  # contact force N, N, shape (positions, 3)
    curvatures: Array  # |r_ss|, 1/m, shape (positions,)
    end_positions: Array  # of A and B, m, shape (2, 3)
    end_tensions: Array  # at A and B, N, shape (2,)
    reactions: Array  # support forces on the thread at A and B, N, shape (2, 3)
    end_moments: Array  # EI κ at A and B, N·m, shape (2,)
    largest_tension: float  # of the whole thread, N
    smallest_tension: float  # of the whole thread, N
    smallest_at: float  # where that is, m along the thread
    lowest_height: float  # z of the lowest point of the whole thread, m
    position_error: float  # estimated, of all positions, m
    tension_error: float  # estimated, of all tensions, N
    reaction_error: float  # estimated, of reactions, N
    moment_error: float  # estimated, of the end moments, N·m
    relative_error: float  # the largest of them, of length, largest force and largest moment
    start: str  # name of the start of Newton's method
    newton_steps: tuple[int, ...]  # on each of the meshes
    failed_starts: tuple[str, ...]  # why the starts before it failed


def resting_thread(found: FoundEquilibrium, frame: Frame, s: Array) -> RestingThread:
    """Return an equilibrium in space."""
    profile, errors = found.solution.profile, found.solution.errors
    ends = profile.nodes[[0, -1]]
    smallest, place = profile.smallest_tension()
    return RestingThread(
        positions=frame.positions_in_space(profile.position(s)),
        tensions=profile.tension_at(s),
        forces=frame.to_space(profile.contact_force(s)),
        curvatures=_curvatures(profile, s),
        end_positions=frame.positions_in_space(profile.position(ends)),
        end_tensions=np.array([profile.tension[0, 0], profile.tension[-1, 1]]),
        reactions=frame.to_space(profile.reactions()),
        end_moments=profile.end_moments(),
        largest_tension=float(np.max(profile.tension)),
        smallest_tension=smallest,
        smallest_at=place,
        lowest_height=float(np.min(frame.positions_in_space(profile.position(_finely(profile)))[:, 2])),
        position_error=errors.position,
        tension_error=errors.tension,
        reaction_error=errors.reaction,
        moment_error=errors.moment,
        relative_error=errors.relative,
        start=found.start,
        newton_steps=found.solution.newton_steps,
        failed_starts=found.failed,
    )


def _finely(profile: ThreadProfile) -> Array:
    """Arc lengths between which a thread is a parabola, for all that is drawn or told of it."""
    return np.linspace(profile.nodes[0], profile.nodes[-1], 1001)


def _curvatures(profile: ThreadProfile, s: Array) -> Array:
    """|r_ss|, of a thread that does not bend by the second derivative of its positions."""
    if profile.curvature_table is not None:
        return np.asarray(np.linalg.norm(profile.curvature_table.at(s), axis=1))
    slope, second = profile.position_table.at(s, 1), profile.position_table.at(s, 2)
    along = np.sum(slope * second, axis=1) / np.sum(slope**2, axis=1)
    return np.asarray(np.linalg.norm(second - along[:, None] * slope, axis=1) / np.sum(slope**2, axis=1))
