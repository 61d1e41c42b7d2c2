"""Records of the golden corpus: what is compared of the results of a case, and what differs between two of them.

    ./hydro python tests/support/corpus_records.py compare BEFORE AFTER

- **Numbers** with an estimated error of their own (``omega`` beside ``relative_error``, columns of CSV, variables of
  ``dataset.nc``, files for other programs) agree within the sum of both errors.
- **Shapes** and other numbers without an error of their own agree within the root of the largest error of the run, of
  their largest value, those of a mode up to its sign; what is sampled on a mesh by its largest value if the mesh
  differs.
- **Modes** that lie closer than their errors agree as the space that they span.
- **Words**, that is names, units, enumerations, and numbers of things and exit codes agree exactly; sentences, seconds,
  sizes, residuals and estimated errors are there in both; pictures are there, and about as large in pixels.
"""

from __future__ import annotations

import csv
import io
import json
import math
import re
import struct
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import xarray
from contract import unpromised

Record: TypeAlias = dict[str, Any]
Array: TypeAlias = np.ndarray

# By the last part of a key, the name of a column or of a variable. What earlier versions had, or what is of the folder.
DROPPED = re.compile(
    r"manifest|printed|constant_corrected|restarts|laplace_solutions|pairs_asked|attempts|halves|beam_shapes|timing"
    r"|^stage$|thinness|_seconds$|sweep.journal|nc: summary$|^summary\.(files|scene_file)$"
)
# Beside what is declared without a promised value: columns of tables, rows of studies, differences of like numbers.
PRESENT = re.compile(
    r"error|residual|difference|note$|reasons?$|warnings?$|unknowns|degree$|layers$|memory|seconds|phase|region"
)
UNPROMISED = unpromised()
FREQUENCIES = re.compile(r"omega|^(mode_)?frequency|frequency_hz|period$|root$")
# What follows from the scene by closed forms or plain quadrature.
CLOSED = re.compile(
    r"summary\.(scene|bodies|thread|string)\b|summary\.floats(\[\d+\])?\.(mass|moment|centre|reference|waterplane|\w*_stiffness)"
    r"|(body|float)_(mass|moment|draught|waterplane|centre|radius|metacentric|reference|\w*stiffness|displaced)"
    r"|inertia_matrix|hydrostatic_stiffness|wave_?(number|length|_elevation)|initial$|: thread_"
)
# Of shapes, whose errors are the roots of those of frequencies.
SHAPES = re.compile(
    r"deflection|elevation|displacement_of|shape|^motion$|(^|_)fraction|participation|runner_up|modal_mass|out_of_plane"
    r"|body_amplitudes|resonance_amplitude|sharing|tail|zero_crossing|encounter_body|encounter_omega|branch_"
)
SIGNED_BY = ("mode", "shape", "growing_mode")
# Dimensions along which the mesh, or the solver, chooses the places.
OF_THE_MESH = re.compile(r"^(point$|node|mode_s|step_end|spectrum_omega|impulse_omega|row)|_row$")
CHOSEN = re.compile(
    r"^summary\.impulse_response\[\d+\]\.(omega|added_mass|radiation_damping)$|^impulse_response_check"
    r"|nc: impulse_(added_mass|radiation_damping)$|^spectrum.csv: omega"
)
"""What there is at a few frequencies that the solver chooses."""
ABSOLUTE = re.compile(
    r"(^|_)(position|tension|reaction|moment|air_gap|drift|absolute|root)_error$|pressure_error|response_absolute"
)
"""Errors in the unit of what they belong to; all others are relative."""
BESIDE = (
    (r"^(mode_)?(omega|frequency_hz)$", "mode_relative_error"),
    (r"^infinite_frequency_added_mass$", "float_high_frequency_relative_error"),
    (r"added_mass|radiation_damping|_force|re_.*force|im_.*force", "radiation_relative_error"),
    (r"^RAO$|(reflection|transmission)_coefficient|partial_waves|_width$", "response_relative_error"),
    (r"^pressure_on_(body_\d+)$", r"pressure_error_on_\1"),
    (r"^near_field_drift$", "response_relative_error"),
    (r"impulse", "impulse_relative_error"),
    (r"^(position|tension|reaction)$|^contact_force$", r"equilibrium_\1_error"),
    (r"^end_(position|tension|moment)s$", r"\1_error"),
    (r"^reactions$", "reaction_error"),
    (r"^(largest|smallest)_tension$", "tension_error"),
    (r"^(displacement|largest_displacement|angle|largest_angle)$", "response_absolute_error"),
)
"""Errors that bear other names than what they belong to."""
NEAR = 1e-8
"""Of the largest value: rounding, also of what is printed of a number in a record."""
OF_CLOSED_FORMS = 1e-6
"""Relative error of what follows from the scene alone: bodies at rest by quadrature of their contours."""
OF_THE_LARGEST = 0.03
"""Smaller motions and forces are compared as if they were as large: their errors are stated relative to the largest."""
MOST = 10
"""Values that a record keeps of an axis."""
NODES = 0.05
"""Of the largest value of a field, which the nodes of another mesh may miss."""
PICTURE_SIZE = 0.2
CURVES = ("response_curve.csv", "spectrum.csv", "branches.csv", "study.csv")
"""Tables whose rows the solver chooses: their largest values are compared."""


def printed(command: str, text: str) -> Record:
    """What `check` and `compare` print: the unknown fields, and tables of older theories."""
    if command == "check":
        numbers = re.findall(r"\bnan\b", text)
        return {"check: fields": _first_column(text, "field"), "check: a number is not known": bool(numbers)}
    found: Record = {}
    headings: list[str] = []
    lines = text.splitlines() if command == "compare" else []
    for before, line in zip(["", *lines], lines, strict=False):
        name, *cells = re.split(r"\s{2,}", line.strip())
        if set(name) == {"─"}:
            headings = re.split(r"\s{2,}", before.strip())
        elif cells and len(cells) + 1 == len(headings):
            # Differences from the field solution are those of small errors.
            kept = [
                _number(cell)
                for heading, cell in zip(headings[1:], cells, strict=True)
                if not re.search("difference|to field|seconds|left out|error", heading)
            ]
            values = np.array([value for value in kept if value is not None])
            found[f"compare: {name}"] = entry(values, 2e-3 * np.abs(values))
    return found


def _first_column(text: str, heading: str) -> list[str]:
    """The first column of the printed table with this heading."""
    names, inside = [], False
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split("[│┃]", line)[1:-1]]
        if line.startswith("┃"):
            inside = cells[0] == heading
        elif line.startswith("│") and inside and cells[0]:
            names.append(cells[0])
    return names


def record_of(folder: Path) -> Record:
    """All that is compared of a result folder."""
    if not folder.is_dir():
        return {}
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    names = [str(path.relative_to(folder)) for path in paths]
    record: Record = {"files": [name for name in names if not DROPPED.search(name)]}
    summary = folder / "summary.json"
    told = json.loads(summary.read_text(encoding="utf-8")) if summary.is_file() else {}
    error = error_of_the_run(told)
    record |= of_tree("summary", told, error, {})
    for name, path in zip(names, paths, strict=True):
        if path.suffix == ".csv":
            record |= of_csv(name, path, error)
        elif path.suffix == ".nc":
            record |= of_dataset(name, path, error)
        elif path.suffix == ".png":
            record[f"{name}: pixels"] = struct.unpack(">II", path.read_bytes()[16:24])
        elif path.suffix == ".h5":
            record |= of_hdf(name, path, error)
        elif path.suffix == ".vtu":
            record |= of_field(name, path, error)
        elif path.parent != folder and path.suffix not in (".gif", ".svg", ".pdf", ".pvd", ".html"):
            record |= of_text(name, path, error)
    return record


def error_of_the_run(told: Any) -> float:
    """The largest relative error that a summary states, or the tolerance asked for where it states none."""
    stated: list[float] = []

    def collect(node: Any, key: str) -> None:
        if isinstance(node, dict):
            for name, inner in node.items():
                collect(inner, name)
        elif isinstance(node, list):
            for inner in node:
                collect(inner, key)
        elif _is_number(node) and key.endswith("relative_error") and 0.0 < node < math.inf:
            stated.append(float(node))

    collect(told, "")
    tolerance = told.get("scene", {}).get("accuracy", {}).get("tolerance", NEAR) if isinstance(told, dict) else NEAR
    return max(stated, default=float(tolerance))


# Records of the files


def entry(values: Array, error: Array | float, dims: tuple[str, ...] = (), groups: Any = None) -> Record:
    """Numbers as a record keeps them: thinned, with their largest error, in the same unit."""
    values, error = np.asarray(values, dtype=float), np.asarray(error, dtype=float)
    if error.ndim not in (0, values.ndim) or (error.size and error.max() == error.min()):
        error = np.asarray(error.max(initial=0.0))
    finite = np.abs(values[np.isfinite(values)])
    kept = np.ix_(*(_thinned(size) for size in values.shape)) if values.ndim else ()
    found: Record = {
        "shape": list(values.shape),
        "largest": _short(float(finite.max(initial=0.0))),
        "values": np.vectorize(_short, otypes=[object])(values[kept]).tolist() if values.size else [],
    }
    places = np.ix_(*(_thinned(size) for size in error.shape)) if error.ndim else ()
    found["error"] = np.vectorize(lambda one: _short(one, 3), otypes=[object])(error[places]).tolist()
    if any(OF_THE_MESH.search(dim) for dim in dims):
        found["of_the_mesh"] = True
    if dims and dims[0] in SIGNED_BY:
        found["signed"] = False
    if groups:
        found["groups"] = groups
    return found


def _thinned(size: int) -> Array:
    return np.unique(np.linspace(0, size - 1, min(size, MOST)).round().astype(int))


def _short(value: float, digits: int = 9) -> float | str:
    return float(f"{value:.{digits}g}") if math.isfinite(value) else str(value)


def name_of(key: str) -> str:
    """The name of a quantity: the last part of its key."""
    return re.split(r"[.: ]+", key)[-1]


def with_error(
    key: str, values: Array, errors: Mapping[str, Array], whole: float, dims: tuple[str, ...], least: float
) -> Array:
    """Absolute errors of values, relative to `least` at least: stated, or the root of that of the run where none is."""
    if CLOSED.search(key) or dims == (name_of(key),):
        return np.asarray(OF_CLOSED_FORMS * np.abs(np.nan_to_num(values, posinf=0.0, neginf=0.0)).max(initial=0.0))
    stated = next((name for name in names_of_errors(name_of(key)) if name in errors), None)
    if SHAPES.search(name_of(key)) or stated is None:
        return np.asarray(math.sqrt(whole) * np.maximum(scales(values, dims), least))
    error = np.abs(np.where(np.isfinite(errors[stated]), errors[stated], whole))
    # Along the leading dimensions of the values, or one for all.
    fits = error.shape == values.shape[: error.ndim]
    spread = error.reshape(error.shape + (1,) * (values.ndim - error.ndim)) if fits else np.max(error, initial=0.0)
    if ABSOLUTE.search(stated):
        return np.asarray(spread)
    relative_to = (
        np.abs(np.nan_to_num(values, posinf=0.0, neginf=0.0))
        if FREQUENCIES.search(name_of(key))
        else scales(values, dims)
    )
    return np.asarray(spread * np.maximum(relative_to, least))


def names_of_errors(name: str) -> Iterator[str]:
    """Names under which the error of a quantity may be stated: its own, those of its first words, that of its table."""
    words = name.split("_")
    if words[-1].isdigit():
        # In the tables of sweeps.
        yield f"relative_error_{words[-1]}"
    for end in range(len(words), 0, -1):
        for kind in ("relative_error", "absolute_error", "error"):
            yield "_".join((*words[:end], kind))
    for pattern, error in BESIDE:
        found = re.search(pattern, name)
        if found:
            yield found.expand(error) if found.groups() and found[1] else error
    yield from ("relative_error", "absolute_error")


def scales(values: Array, dims: tuple[str, ...] = ()) -> Array:
    """What an error is relative to: the largest value, in matrices of motions that of both motions."""
    size = np.abs(np.nan_to_num(values, posinf=0.0, neginf=0.0))
    overall = size.max(initial=0.0)
    motions = tuple(place for place, dim in enumerate(dims) if "dof" in dim)
    if not motions:
        return np.asarray(overall)
    others = tuple(place for place in range(values.ndim) if place not in motions)
    largest = size.max(axis=others, keepdims=True, initial=0.0)
    if len(motions) == 2 and values.shape[motions[0]] == values.shape[motions[1]]:
        own = np.sqrt(np.diagonal(largest, axis1=motions[0], axis2=motions[1]).ravel())
        return np.asarray(np.expand_dims(np.outer(own, own), others))
    return np.asarray(np.maximum(largest, OF_THE_LARGEST * overall))


def numbers(
    key: str,
    values: Array,
    errors: Mapping[str, Array],
    whole: float,
    dims: tuple[str, ...] = (),
    groups: Any = None,
    least: float = 0.0,
) -> Record:
    """The record of numbers under a key, by what it is."""
    if DROPPED.search(key):
        return {}
    if is_present(key):
        return {key: "present"}
    if CHOSEN.search(key) or (dims == (name_of(key),) and OF_THE_MESH.search(dims[0])):
        return {key: "chosen by the solver"}
    if values.dtype.kind in "iub":
        return {key: {"exactly": values.tolist()}} if values.size <= MOST else {key: entry(values, 0.0, dims)}
    if groups and values.ndim == 1 and not FREQUENCIES.search(name_of(key)):
        values = np.where(
            np.isin(np.arange(len(values)), [place for group in groups for place in group]), np.nan, values
        )
    return {
        key: entry(
            values, with_error(key, values, errors, whole, dims, least), dims, groups if values.ndim > 1 else None
        )
    }


def is_present(key: str) -> bool:
    """Whether of a quantity only its presence counts."""
    if key.startswith("summary.scene"):
        return False
    return bool(UNPROMISED.fullmatch(key)) or any(PRESENT.search(part) for part in re.split(r"[.: ]+", key)[1:])


def groups_of(omega: Array, error: Array) -> list[list[int]]:
    """Modes whose frequencies lie closer than their errors, in groups of two and more."""
    groups: list[list[int]] = []
    for place in np.argsort(np.real(omega), kind="stable").tolist():
        near = groups and abs(omega[place] - omega[groups[-1][-1]]) <= 4.0 * (
            error[place] * abs(omega[place])
            + error[groups[-1][-1]] * abs(omega[groups[-1][-1]])
            + NEAR * abs(omega[place])
        )
        if near:
            groups[-1].append(place)
        else:
            groups.append([place])
    return [group for group in groups if len(group) > 1]


def of_tree(key: str, node: Any, whole: float, errors: Mapping[str, Array]) -> Record:
    """The record of JSON: tables in lists are stacked, number by number."""
    if DROPPED.search(key):
        return {}
    if isinstance(node, dict):
        own = {
            name: np.array(value, dtype=float) for name, value in node.items() if "error" in name and _is_array(value)
        }
        found: Record = {}
        for name, inner in node.items():
            found |= of_tree(f"{key}.{name}", inner, whole, {**errors, **own})
        return found
    if isinstance(node, list) and node and all(isinstance(one, dict) for one in node):
        keys = list(node[0])
        if len(node) == 1 or any(list(one) != keys for one in node):
            found = {f"{key}: number": len(node)}
            for place, one in enumerate(node):
                found |= of_tree(f"{key}[{place + 1}]", one, whole, errors)
            return found
        stacked = {name: [one[name] for one in node] for name in keys}
        own = {
            name: np.array([_or_nan(one) for one in values])
            for name, values in stacked.items()
            if "error" in name and all(one is None or _is_number(one) for one in values)
        }
        groups = None
        if "relative_error" in own and all(_is_number(one) for one in stacked.get("omega", [None])):
            groups = groups_of(np.array(stacked["omega"]), own["relative_error"])
        found = {}
        for name, values in stacked.items():
            if all(one is None or _is_number(one) for one in values) and not all(one is None for one in values):
                whole_numbers = all(isinstance(one, int) for one in values)
                column = np.array(values if whole_numbers else [_or_nan(one) for one in values])
                found |= numbers(f"{key}.{name}", column, own, whole, groups=groups)
            elif groups and all(isinstance(one, str) for one in values):
                inside = {place for group in groups for place in group}
                found |= of_tree(
                    f"{key}.{name}", [one for place, one in enumerate(values) if place not in inside], whole, {}
                )
            else:
                found |= of_tree(f"{key}.{name}", values, whole, errors)
        return found
    if _is_array(node):
        flat = node if not isinstance(node, list) else list(_flat(node))
        exact = isinstance(node, int) or (
            isinstance(node, list) and bool(flat) and all(isinstance(one, int) for one in flat)
        )
        return numbers(key, np.array(node, dtype=int if exact else float), errors, whole)
    return {} if DROPPED.search(key) else {key: worded(key, node)}


def worded(key: str, node: Any) -> Any:
    """A word exactly, a sentence by its presence."""
    if is_present(key):
        return "present"
    if isinstance(node, list):
        return [worded(key, one) for one in node]
    return "a sentence" if isinstance(node, str) and node.count(" ") > 3 else node


def of_csv(name: str, path: Path, whole: float) -> Record:
    """The record of a table: its headings, and its columns."""
    headings, *rows = csv.reader(io.StringIO(path.read_text(encoding="utf-8")))
    columns = dict(zip(headings, zip(*rows, strict=True), strict=True)) if rows else {}
    found: Record = {f"{name}: columns": [one for one in headings if not DROPPED.search(one)]}
    values: dict[str, Array] = {}
    for heading, cells in columns.items():
        column = [_number(cell) for cell in cells]
        if None not in column:
            values[heading] = np.array(column, dtype=float)
        elif not DROPPED.search(heading):
            found[f"{name}: {heading}"] = [worded(f"{name}.{heading}", cell) for cell in cells[:MOST]]
    errors = {heading: column for heading, column in values.items() if "error" in heading}
    groups = None
    if path.name == "modes.csv" and {"omega", "relative_error"} <= set(values):
        groups = groups_of(values["omega"], values["relative_error"])
        for heading in ("kind", "symmetry"):
            if groups and isinstance(found.get(f"{name}: {heading}"), list):
                found[f"{name}: {heading}"] = "present"
    for heading, column in values.items():
        if path.name in CURVES:
            largest = np.array(_largest([column]))
            found |= numbers(f"{name}: {heading}: largest", largest, {}, max(whole, NODES**2))
            continue
        # A part of a complex number is compared with the whole number.
        alike = [other for one, other in values.items() if family(one) == family(heading)]
        parts = [values[part + heading[3:]] for part in ("re_", "im_") if heading[:3] in ("re_", "im_")]
        least = max(OF_THE_LARGEST * _largest(alike), _largest(parts))
        found |= numbers(f"{name}: {heading}", column, errors, whole, ("line",), groups, least)
    return found


def family(heading: str) -> str:
    """What columns of real and imaginary parts, and of several motions, have in common."""
    bare = re.sub(r"^(re|im)_", "", heading)
    return re.sub(r"(^|_)(heave|sway|surge|roll|pitch|elastic_\d+|hinge_\d+)(?=_|$)", "", bare)


def _largest(columns: list[Array]) -> float:
    return max((float(np.abs(column[np.isfinite(column)]).max(initial=0.0)) for column in columns), default=0.0)


def of_dataset(name: str, path: Path, whole: float) -> Record:
    """The record of a dataset: names, dimensions and units of its variables, and their values."""
    found: Record = {}
    with xarray.open_dataset(path) as dataset:
        values = {str(key): variable for key, variable in dataset.variables.items() if not DROPPED.search(str(key))}
        errors = {key: variable for key, variable in values.items() if "error" in key and variable.dtype.kind == "f"}
        modes = groups_of_modes(dataset)
        for key, variable in values.items():
            dims = tuple(str(dim) for dim in variable.dims)
            found[f"{name}: {key}: of"] = [*dims, str(variable.attrs.get("units", ""))]
            array = variable.values
            if "complex" in dims:
                # Both parts together: the scale is that of the magnitude.
                place = dims.index("complex")
                dims, array = (*dims[:place], *dims[place + 1 :], "complex"), np.moveaxis(array, place, -1)
            if array.dtype.kind in "OSU":
                words = array.ravel()[:MOST].tolist()
                inside = dims[:1] == ("mode",) and modes.get("mode")
                found |= {
                    f"{name}: {key}": "present" if inside else [worded(f"{name}.{key}", str(one)) for one in words]
                }
                continue
            own = {
                one: error.values if error.dims == dims[: error.ndim] else np.nanmax(error.values, initial=0.0)
                for one, error in errors.items()
            }
            of_the_file = whole if errors else max(whole, 1e-6)
            found |= numbers(f"{name}: {key}", array, own, of_the_file, dims, modes.get(dims[0] if dims else ""))
    return found


def groups_of_modes(dataset: xarray.Dataset) -> dict[str, list[list[int]]]:
    """Groups of modes, and of shapes, of which a mode of multiplicity two has two."""
    error = next((dataset[one] for one in ("relative_error", "mode_relative_error") if one in dataset), None)
    if "omega" not in dataset or error is None or dataset.omega.dims != ("mode",) or error.dims != ("mode",):
        return {}
    omega, errors = dataset.omega.values, error.values
    found = {"mode": groups_of(omega, errors)}
    if "mode_multiplicity" in dataset and "shape" in dataset.dims:
        times = dataset.mode_multiplicity.values
        found["shape"] = groups_of(np.repeat(omega, times), np.repeat(errors, times))
    return found


def of_hdf(name: str, path: Path, whole: float) -> Record:
    """The record of an HDF5 file."""
    import h5py

    found: Record = {}

    def visit(key: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset):
            value = node[()]
            if DROPPED.search(key) or is_present(f"{name}: {key}"):
                return
            if isinstance(value, bytes | str):
                found[f"{name}: {key}"] = worded(key, value.decode() if isinstance(value, bytes) else value)
            elif value.dtype.kind in "fiu":
                array = np.asarray(value, dtype=float)
                found[f"{name}: {key}"] = entry(
                    array, whole * float(np.abs(array[np.isfinite(array)]).max(initial=0.0))
                )

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def of_text(name: str, path: Path, whole: float) -> Record:
    """The record of a text with numbers, line by line: words exactly, numbers by columns of lines of the same kind."""
    words, columns = [], dict[int, list[list[float]]]()
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        cells = re.split(r"[\s,]+", line.strip())
        values = [value for value in map(_number, cells) if value is not None]
        if len(values) == len(cells):
            columns.setdefault(len(values), []).append(values)
        else:
            words.append(" ".join(cell for cell in cells if _number(cell) is None))
    found: Record = {f"{name}: words": words[: 4 * MOST]}
    for width, rows in columns.items():
        table = np.array(rows)
        if path.suffix in (".3", ".4"):
            # The phase of a force follows from its parts, and means nothing where it is zero.
            table = np.delete(table, 4, axis=1)
        elif path.name.endswith("Force.tec"):
            sizes, angles = table[:, 1::2].copy(), table[:, 2::2].copy()
            table[:, 1::2], table[:, 2::2] = sizes * np.cos(angles), sizes * np.sin(angles)
        found[f"{name}: lines of {width}"] = entry(table, whole * np.abs(table).max(axis=0, keepdims=True))
    return found


def of_field(name: str, path: Path, whole: float) -> Record:
    """The record of a field on a mesh: its arrays, and their largest values, which nodes of the mesh may miss."""
    import meshio

    arrays = meshio.read(path).point_data
    found: Record = {f"{name}: arrays": sorted(arrays)}
    # Beside tips and corners the gradient of a potential is as large as the mesh is fine.
    gradients = any("potential" in key for key in arrays)
    for key, values in arrays.items():
        if (gradients and "displacement" in key) or PRESENT.search(key):
            continue
        largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
        found[f"{name}: {key}: largest"] = entry(np.array(largest), max(math.sqrt(whole), NODES) * largest)
    return found


def _flat(node: Any) -> Iterator[Any]:
    for one in node:
        yield from _flat(one) if isinstance(one, list) else (one,)


def _is_array(node: Any) -> bool:
    """Whether it is a number, or a regular array of numbers, of which some may be infinite or missing."""
    if not isinstance(node, list):
        return _is_number(node)
    flat = list(_flat(node))
    if not any(map(_is_number, flat)) or not all(
        _is_number(one) or one in (None, "inf", "-inf", "nan") for one in flat
    ):
        return False
    try:
        np.array(node, dtype=float)
    except ValueError:
        return False
    return True


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else float(value)


def _number(cell: str) -> float | None:
    try:
        return float(cell) if cell else math.nan
    except ValueError:
        return None


# Comparing


def differences(old: Record, new: Record) -> Iterator[str]:
    """What differs between two records, in words; what is new is no difference."""
    for key in old:
        if key not in new:
            yield f"{key} is in the first only"
        elif key == "files" or key.endswith((": columns", ": arrays")):
            if not set(old[key]) <= set(new[key]):
                yield f"{key}: {sorted(set(old[key]) - set(new[key]))} are in the first only"
        elif isinstance(old[key], dict) and isinstance(new[key], dict) and "shape" in old[key] and "shape" in new[key]:
            yield from difference_of_numbers(key, old[key], new[key])
        elif key.endswith(": pixels"):
            ratios = [one / other for one, other in zip(old[key], new[key], strict=True)]
            if any(abs(math.log(ratio)) > PICTURE_SIZE for ratio in ratios):
                yield f"{key}: {old[key]}, then {new[key]}"
        elif _plain(old[key]) != _plain(new[key]):
            yield f"{key}: {_told(old[key])}, then {_told(new[key])}"


def difference_of_numbers(key: str, old: Record, new: Record) -> Iterator[str]:
    """What differs between two arrays by more than both errors."""
    before, after = _values(old["values"]), _values(new["values"])
    errors = [_values(one["error"]) for one in (old, new)]
    scale = max(_values(old["largest"]).item(), _values(new["largest"]).item())
    if old["shape"] != new["shape"]:
        allowed = sum(float(np.max(error, initial=0.0)) for error in errors) + math.sqrt(NEAR) * scale
        if not old.get("of_the_mesh"):
            yield f"{key}: {old['shape']} values, then {new['shape']}"
        elif abs(old["largest"] - new["largest"]) > allowed:
            yield f"{key}: at most {old['largest']:.6g}, then {new['largest']:.6g}"
        return
    same = np.isfinite(before) == np.isfinite(after)
    if not same.all() or not np.array_equal(before[~np.isfinite(before)], after[~np.isfinite(after)], equal_nan=True):
        yield f"{key}: other values are infinite or unknown"
        return
    before, after = np.nan_to_num(before, posinf=0.0, neginf=0.0), np.nan_to_num(after, posinf=0.0, neginf=0.0)
    allowed_each = np.broadcast_to(sum(errors[1:], errors[0]), before.shape) + 2.0 * NEAR * scale
    if "signed" in old and before.ndim > 1:
        after = _like(before, after, old.get("groups") or new.get("groups") or [])
    excess = np.abs(after - before) - allowed_each
    if excess.size and excess.max() > 0.0:
        worst = np.unravel_index(int(excess.argmax()), excess.shape)
        yield (
            f"{key}{list(map(int, worst)) if worst else ''}: {before[worst]:.9g}, then {after[worst]:.9g}; "
            f"allowed is a difference of {allowed_each[worst]:.1e}"
        )


def _like(before: Array, after: Array, groups: list[list[int]]) -> Array:
    """Shapes with the signs of others, and those of a group as they are in the space of the others."""
    found = np.array(after)
    flat, other = before.reshape(len(before), -1), after.reshape(len(after), -1)
    for place in range(len(before)):
        if np.abs(flat[place] + other[place]).max(initial=0.0) < np.abs(flat[place] - other[place]).max(initial=0.0):
            found[place] = -after[place]
    for group in (group for group in groups if max(group) < len(before)):
        mixed = np.linalg.lstsq(other[group].T, flat[group].T, rcond=None)[0]
        found[group] = (mixed.T @ other[group]).reshape(found[group].shape)
    return found


def _values(given: Any) -> Array:
    return np.array(given, dtype=float)


def _plain(value: Any) -> Any:
    return json.loads(json.dumps(value))


def _told(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) < 200 else f"{text[:200]} …"


def read_record(folder: Path) -> Record:
    """The record of a case, which is made of its results where it was not yet; empty without them."""
    path = folder / "record.json"
    if not path.is_file() and (folder / "case.json").is_file():
        done = json.loads((folder / "case.json").read_text(encoding="utf-8"))
        record = {"exit code": done["exit code"], **record_of(folder / "results")}
        record |= printed(done["command"], done["output"])
        path.write_text(json.dumps(record, ensure_ascii=False, indent=0), encoding="utf-8")
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def compare(before: Path, after: Path) -> int:
    """Print all that differs between two corpora by more than the stated errors, and return how much that is."""
    names = sorted({path.parent.name for folder in (before, after) for path in folder.glob("*/case.json")})
    count = 0
    for name in names:
        records = read_record(before / name), read_record(after / name)
        for difference in differences(*records) if all(records) else ("it is in one of both only",):
            print(f"{name}: {difference}")
            count += 1
    print(f"{len(names)} cases, {count} differences")
    return count


def make_reference(folder: Path, reference: Path) -> None:
    """Write the records of a corpus into the folder of references, a file for each case."""
    for case in sorted(path.parent for path in folder.glob("*/case.json")):
        # The matrices of summaries and tables are those of the datasets, and the scene is given.
        kept = {key: value for key, value in read_record(case).items() if not _is_repeated(key, value)}
        text = json.dumps(kept, ensure_ascii=False, separators=(",", ":"))
        lines = re.sub(r',("(?:summary|dataset|export|fields|\w+\.csv))', r",\n\1", text)
        (reference / f"{case.name}.json").write_text(lines + "\n", encoding="utf-8")
    print(f"{sum(path.stat().st_size for path in reference.iterdir())} bytes in {reference}")


def _is_repeated(key: str, value: Any) -> bool:
    matrix = isinstance(value, dict) and len(value.get("shape", ())) > 1
    column = isinstance(value, dict) and key.startswith("radiation.csv: ")
    return key.startswith("summary.scene.") or (key.startswith("summary.") and matrix) or column


if __name__ == "__main__":
    if sys.argv[1] == "compare":
        raise SystemExit(1 if compare(Path(sys.argv[2]), Path(sys.argv[3])) else 0)
    make_reference(Path(sys.argv[2]), Path(sys.argv[3]))
