"""What a sweep holds, as variables and as columns: the content of its files and pictures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from hydroelastic.output.variables import Variable
from hydroelastic.scenes.sweep.dataset import sweep_variables
from hydroelastic.scenes.sweep.quantities import columns, quantities
from hydroelastic.scenes.sweep.run import SolvedSweep


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class SweepContents:
    """The quantities of a sweep.

    Attributes:
        solved: all points.
    """

    solved: SolvedSweep

    @property
    def status(self) -> str:
        """The status of the sweep: "ok", "unconverged" or "failed"."""
        return self.solved.status

    @cached_property
    def quantities(self) -> list[Variable]:
        """All quantities, with the dimension "point"."""
        points = self.solved.points
        return quantities([one.summary for one in points], [one.arrays for one in points], self.solved.kind)

    @cached_property
    def variables(self) -> list[Variable]:
        """The content of ``dataset.nc``."""
        return sweep_variables(self.solved, self.quantities)

    @cached_property
    def columns(self) -> dict[str, Any]:
        """The columns of `table`."""
        grid, points = self.solved.grid, self.solved.points
        rows = grid.points
        return (
            {axis.key: [row[axis.key] for row in rows] for axis in grid.axes}
            | {"status": [point.status for point in points], "reason": ["; ".join(point.reasons) for point in points]}
            | columns(self.quantities)
        )
