"""The motion of a string for pictures, with additional positions and times where a scene has few."""

from __future__ import annotations

import numpy as np

from hydroelastic.modal.string.solution import Floats, StringSolution
from hydroelastic.scenes.models.string_parts import DEFAULT_POSITIONS, DEFAULT_TIMES
from hydroelastic.scenes.string.results import StringResult
from hydroelastic.scenes.string.solve import solve_series

# Numbers of times and of positions from which a motion and a shape are drawn smooth.
_ENOUGH_TIMES = 61
_ENOUGH_POSITIONS = 61
# Positions and times at which the fronts of a step are lines and no stairs.
_OF_FRONTS = (301, 801)


def drawn_solution(result: StringResult) -> StringSolution:
    """Return the same motion at more positions and times, including the requested ones.

    A series is summed again. A field solution is drawn as it is, since computing it again is expensive.
    """
    scene, solution = result.scene, result.solution
    few_positions = len(solution.positions) < _ENOUGH_POSITIONS
    few_times = len(solution.times) < _ENOUGH_TIMES
    jumps = scene.motion.kind == "step" and solution.times[-1] > 0.0
    if scene.method != "series" or not (few_positions or few_times or jumps):
        return solution
    positions, times = solution.positions, solution.times
    heights, instants = _OF_FRONTS if jumps else (DEFAULT_POSITIONS, DEFAULT_TIMES)
    if few_positions or jumps:
        positions = np.union1d(positions, scene.string.length * np.linspace(0.0, 1.0, heights) ** 2)
    if few_times or jumps:
        times = np.union1d(times, np.linspace(0.0, times[-1], instants))
    return solve_series(scene, positions, times)


def columns_of(solution: StringSolution, times: Floats) -> list[int]:
    """Return the columns of a solution that are nearest to times, each once and in their order."""
    return sorted({int(np.argmin(np.abs(solution.times - time))) for time in times})


def animation_notes(result: StringResult) -> tuple[str, ...]:
    """Return why there is no animation, or only a coarse one, and the key to set."""
    solution = result.solution
    if solution.times[-1] == 0.0:
        return ('the string is not animated: give [output] key "times" times after 0',)
    if result.scene.method != "series" and len(solution.times) < _ENOUGH_TIMES:
        return (
            f"the animation has {len(solution.times)} pages only, one for each time of the field solution: give "
            f'[output] key "times" {_ENOUGH_TIMES} or more',
        )
    return ()
