"""The result of a sweep: a dataset, a table, pictures, files."""

from __future__ import annotations

import io
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from mpi4py import MPI

from hydroelastic.output.plots import DEFAULT_PICTURES, PictureOptions
from hydroelastic.scenes.progress import progress
from hydroelastic.scenes.read import Scene
from hydroelastic.scenes.sweep.axes import Vary, grid_from_values
from hydroelastic.scenes.sweep.branches import branch_rows, encounter_rows
from hydroelastic.scenes.sweep.contents import SweepContents
from hydroelastic.scenes.sweep.dataset import as_dataset, sweep_attributes
from hydroelastic.scenes.sweep.figure import draw_sweep
from hydroelastic.scenes.sweep.files import write_sweep
from hydroelastic.scenes.sweep.run import SweepOptions, solve_sweep

if TYPE_CHECKING:
    import xarray
    from PIL.Image import Image


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sweep(SweepContents):
    """A scene solved for many values of its keys."""

    def __repr__(self) -> str:
        keys = " × ".join(axis.key for axis in self.solved.grid.axes)
        title = self.solved.scene.title or "Untitled scene"
        return f"<Sweep of {title!r} over {keys}, {len(self.solved.points)} points: {self.status}>"

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """The content of ``dataset.nc``: all quantities with the varied keys as dimensions, NaN of failed points."""
        return as_dataset(self.variables, sweep_attributes(self.solved))

    @cached_property
    def table(self) -> Any:
        """The content of ``sweep.csv`` as a data frame of pandas, one row for each point."""
        return _frame(self.columns)

    @cached_property
    def branches(self) -> Any:
        """The content of ``branches.csv``: ω and participations of each followed mode at each point, those that were
        added for following them among them."""
        return _frame(branch_rows(self.solved))

    @cached_property
    def encounters(self) -> Any:
        """The content of ``encounters.csv``: where followed modes cross, veer, or could not be followed."""
        return _frame(encounter_rows(self.solved))

    def plot(self, *show: str) -> Image:
        """Return the picture of the sweep, or of some quantities; notebooks show it.

        Args:
            show: names of quantities, the columns of `table`.

        Raises:
            SceneError: if there is no such quantity, or it cannot be drawn.
        """
        from PIL import Image

        with TemporaryDirectory() as folder:
            draw_sweep(self, Path(folder), DEFAULT_PICTURES, show)
            return Image.open(io.BytesIO((Path(folder) / "sweep.png").read_bytes()))

    def save(
        self, folder: str | Path, *, show: Iterable[str] = (), images: PictureOptions | None = DEFAULT_PICTURES
    ) -> None:
        """Write the result folder of the command sweep, whole or not at all, on the first process.

        Args:
            folder: the folder; files of an earlier result are replaced, all else is kept.
            show: names of quantities to draw.
            images: how to draw; ``None`` draws nothing.

        Raises:
            SceneError: if the folder cannot be written, or a quantity cannot be drawn.
        """
        write_sweep(self, Path(folder), tuple(show), images)


def sweep(
    scene: Scene | str | Path,
    vary: Vary,
    *,
    jobs: int = 1,
    estimates: bool = False,
    follow: bool = True,
    refinements: int | None = None,
    out: str | Path | None = None,
    report: bool = False,
) -> Sweep:
    """Solve a scene for all combinations of some values of its keys; writes nothing without ``out`` (collective).

    In a script, a sweep with several jobs is called below ``if __name__ == "__main__":``.

    Args:
        scene: the scene, or the name or file of one.
        vary: values by dotted key, entries numbered from 1: ``{"body.1.start": numpy.linspace(0, 6, 25)}``.
        jobs: number of processes.
        estimates: whether to make the estimates of older theories at each point too.
        follow: whether to follow the modes of closed tanks along the first key.
        refinements: largest number of points that are added for that; by default four for each of the grid.
        out: folder for the journal, from which an interrupted sweep goes on; ``Sweep.save(out)`` writes the results.
        report: whether the number of points solved is shown, on a terminal or below the cell of a notebook.

    Raises:
        SceneError: if no point has a valid scene, or the folder cannot be written.
    """
    options = SweepOptions(jobs=jobs, estimates=estimates, follow=follow, refinements=refinements)
    folder = None if out is None else Path(out)
    grid = grid_from_values(vary)
    with progress(", ".join(axis.key for axis in grid.axes), shown=report and MPI.COMM_WORLD.rank == 0) as told:
        return Sweep(solved=solve_sweep(scene, grid, options=options, out=folder, report=told))


def _frame(content: Any) -> Any:
    # It comes with xarray, and takes a while to import.
    import pandas

    return pandas.DataFrame(content)
