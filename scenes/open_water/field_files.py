"""Fields of open water as files for ParaView."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.fem.open_water.field_samples import SampledField
from hydroelastic.output.vtu import write_vtu
from hydroelastic.scenes.tank.body_file import displacement_of, write_bodies


def write_fields(fields: tuple[SampledField, ...], folder: Path) -> None:
    """Write each field into a new folder: real parts, imaginary parts, magnitudes; for ParaView.

    ``<name>.vtu`` is of the liquids, ``<name>_bodies.vtu`` of surfaces, beams and floats.
    """
    if fields:
        folder.mkdir()
    for field in fields:
        _write_field(field, folder)
        _write_bodies(field, folder)


def _write_field(field: SampledField, folder: Path) -> None:
    moved = np.column_stack([field.displacement, np.zeros(len(field.displacement))])
    data = _parts("potential", field.potential) | _parts("pressure", field.pressure) | _parts("displacement", moved)
    points = np.column_stack([field.points, np.zeros(len(field.points))])
    file = folder / f"{field.name}.vtu"
    write_vtu(file, points, [("triangle", field.triangles)], data, {"liquid": field.liquid})


def _write_bodies(field: SampledField, folder: Path) -> None:
    surfaces, floats = field.picture.surfaces, field.picture.floats
    moved = displacement_of(surfaces, floats)
    write_bodies(folder / f"{field.name}_bodies.vtu", surfaces, floats, _parts("displacement", moved))


def _parts(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Real part, imaginary part and magnitude, since ParaView has no complex numbers."""
    size = np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    return {f"{name}_real": values.real, f"{name}_imaginary": values.imag, f"{name}_magnitude": size}
