"""The motion of a string as it is drawn: at places and times of its own where a scene asks for few of them."""

from __future__ import annotations

import numpy as np

from hydroelastic.scenes.models.string import DEFAULT_POSITIONS, DEFAULT_TIMES
from hydroelastic.scenes.string.results import Floats, StringSolution

# From so many times on a motion is smooth as it is; from so many places on a shape is.
_ENOUGH_TIMES = 61
_ENOUGH_POSITIONS = 61


def as_drawn(solution: StringSolution) -> StringSolution:
    """Return the same motion with more places and times between the asked ones, which are among them.

    A series is summed once more. A field solution would take its whole time again: it is drawn as it is.

    Args:
        solution: as the scene asks for it.
    """
    scene = solution.scene
    few_positions = len(solution.positions) < _ENOUGH_POSITIONS
    few_times = len(solution.times) < _ENOUGH_TIMES
    if scene.method != "series" or not (few_positions or few_times):
        return solution
    from hydroelastic.scenes.string.series import solve_series

    grid: dict[str, tuple[float, ...]] = {}
    if few_positions:
        own = scene.string.length * np.linspace(0.0, 1.0, DEFAULT_POSITIONS) ** 2
        grid["positions"] = tuple(map(float, np.union1d(solution.positions, own)))
    if few_times:
        own = np.linspace(0.0, solution.times[-1], DEFAULT_TIMES)
        grid["times"] = tuple(map(float, np.union1d(solution.times, own)))
    output = scene.output.model_copy(update=grid)
    return solve_series(scene.model_copy(update={"output": output}))


def columns_of(solution: StringSolution, times: Floats) -> list[int]:
    """Return the columns of a solution that are nearest to times, each once and in their order."""
    return sorted({int(np.argmin(np.abs(solution.times - time))) for time in times})


def jumps_in_animation(solution: StringSolution) -> tuple[str, ...]:
    """Say what an animation lacks, and which key gives it."""
    if solution.times[-1] == 0.0:
        return ('the string is not animated: give [output] key "times" times after 0',)
    if solution.scene.method != "series" and len(solution.times) < _ENOUGH_TIMES:
        return (
            f"the animation has {len(solution.times)} pages only, one for each time of the field solution: give "
            f'[output] key "times" {_ENOUGH_TIMES} or more',
        )
    return ()
