"""Files for other programs that a scene of open water asks for."""

from __future__ import annotations

from pathlib import Path

from hydroelastic.output.hydrodynamic_files.bemio import write_bemio
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.nemoh import write_nemoh
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import bodies_of_tables
from hydroelastic.scenes.open_water.results import OpenSolution

_NAME = "bodies"


def write_exports(solution: OpenSolution, folder: Path) -> None:
    """Write ``bodies.1`` … and ``bodies.h5``, ``bodies.nc`` and ``nemoh/`` into a new folder, if they are asked for."""
    asked = solution.scene.export
    if asked is None:
        return
    bodies = bodies_of_tables(
        solution.tank, solution.radiation, solution.response, solution.impulse_response, width=asked.width or 1.0
    )
    folder.mkdir()
    for one in asked.formats:
        match one:
            case "wamit":
                write_wamit(bodies, folder, _NAME)
            case "bemio":
                write_bemio(bodies, folder / f"{_NAME}.h5")
            case "nemoh":
                write_nemoh(bodies, folder / "nemoh")
            case "capytaine":
                write_capytaine(bodies, folder / f"{_NAME}.nc")
