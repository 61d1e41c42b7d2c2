"""Limitations of animations of a thread: too few times, or no analysis with a motion."""

from __future__ import annotations

from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

_ENOUGH_TIMES = 24


def animation_notes(solution: ThreadSolutionOfScene) -> tuple[str, ...]:
    """Return notes with the key to set: a motion is known at the output times alone."""
    oscillating = any(len(modes.oscillating.values) for modes in solution.modes)
    if not (solution.motions or oscillating):
        return ('nothing of this scene is animated: ask for an [[analysis]] with kind = "modes" or "motion"',)
    return tuple(
        f"the animation of motion {number} has {len(motion.times)} pages only, one for each of its times: give the "
        f'[[analysis]] key "times" {_ENOUGH_TIMES} or more'
        for number, motion in enumerate(solution.motions, 1)
        if len(motion.times) < _ENOUGH_TIMES
    )
