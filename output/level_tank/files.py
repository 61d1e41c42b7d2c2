"""Mode shapes of a tank in three dimensions as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from mpi4py import MPI

from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.level_tank.quantities import MODES
from hydroelastic.output.level_tank.sample import SampledModes, SampledTank
from hydroelastic.output.vtu import write_index, write_vtu
from hydroelastic.physics.volume_tank import VolumeTank


def write_level_tank(tank: SampledTank, folder: Path) -> None:
    """Write ``modes.csv`` and ``fields/`` into an existing folder; SI units."""
    write_modes(tank, folder)
    (folder / "fields").mkdir()
    write_surface(tank.sample, folder / "fields" / "surface.vtu")
    if not in_parts(tank):
        write_volume(tank.sample, folder / "fields" / "volume.vtu")


def in_parts(tank: SampledTank) -> bool:
    """Whether each process has a part of the volume."""
    return isinstance(tank.tank.tank, VolumeTank) and MPI.COMM_WORLD.size > 1


def write_parts(tank: SampledTank, folder: Path) -> None:
    """Write ``fields/volume.pvtu`` and the part of each process, ``fields/volume/0000.vtu`` (collective)."""
    comm, sample, parts = MPI.COMM_WORLD, tank.sample, folder / "fields" / "volume"
    problem = None
    try:
        parts.mkdir(exist_ok=True)
        write_volume(sample, parts / f"{comm.rank:04d}.vtu")
    except OSError as error:
        problem = error
    for one in comm.allgather(problem):
        if one is not None:
            raise one
    if comm.rank == 0:
        write_index(
            folder / "fields" / "volume.pvtu",
            [f"volume/{rank:04d}.vtu" for rank in range(comm.size)],
            [f"potential_{name}" for name in sample.names],
        )


def write_modes(tank: SampledTank, folder: Path) -> None:
    """Write ``modes.csv`` into an existing folder; SI units."""
    modes = tank.summary[MODES]
    columns = {part.key: ["" if mode[part] is None else mode[part] for mode in modes] for part in MODES.quantities}
    write_csv(folder / "modes.csv", {"mode": np.arange(1, len(modes) + 1), **columns})


def write_surface(sample: SampledModes, file: Path) -> None:
    """Write the still surface with the displacement of plates and water in each mode, for ParaView's Warp By Vector."""
    upwards = np.zeros((len(sample.points), 3))
    data = {}
    for name, elevation in zip(sample.names, sample.elevations, strict=True):
        upwards[:, 2] = elevation
        data[f"displacement_{name}"] = upwards.copy()
    points = np.column_stack([sample.points, np.zeros(len(sample.points))])
    cells = [("triangle", sample.triangles)]
    write_vtu(file, points, cells, data, {"plate": sample.plate_of_triangles})


def write_volume(sample: SampledModes, file: Path) -> None:
    """Write ψ of each mode in the liquid."""
    data = {f"potential_{name}": potential for name, potential in zip(sample.names, sample.potentials, strict=True)}
    write_vtu(file, sample.volume_points, [sample.volume_cells], data)
