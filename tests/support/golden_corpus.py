"""The golden corpus: what users receive for some eighty commands, made of any commit, and compared within its errors.

    ./hydro python tests/support/golden_corpus.py make FOLDER [--commit COMMIT] [--subset] [NAME ...]
    ./hydro python tests/support/golden_corpus.py compare BEFORE AFTER
    ./hydro python tests/support/golden_corpus.py reference      # the subset again, into tests/reference/corpus/

The cases are in ``corpus_cases.toml``: those of this working copy, whichever commit is run. Each leaves its results and
``record.json``, which holds all that is compared:

- **numbers** with an estimated error of their own (``omega`` beside ``relative_error``, columns of CSV, variables of
  ``dataset.nc``, files for other programs) within the sum of both errors;
- **shapes** and other numbers without an error of their own within the root of the largest error of the run, of their
  largest value, those of a mode up to its sign; what is sampled on the mesh by its largest value, if the mesh differs;
- **modes** that lie closer than their errors as the space that they span;
- **words**: names, units, enumerations, numbers of things and exit codes exactly; sentences, seconds, sizes, residuals
  and estimated errors by their presence; pictures by theirs and their size in pixels.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import click
import numpy as np
import xarray

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "tests" / "reference" / "corpus"
CASES: dict[str, dict[str, Any]] = tomllib.loads((ROOT / "tests/support/corpus_cases.toml").read_text(encoding="utf-8"))
SUBSET = tuple(name for name, case in CASES.items() if case.get("subset"))

Record: TypeAlias = dict[str, Any]
Array: TypeAlias = np.ndarray

# By the last part of a key, the name of a column or of a variable. Not promised: the engine's own, or dropped.
DROPPED = re.compile(
    r"manifest|printed|constant_corrected|restarts|laplace_solutions|pairs_|attempts|halves|(beam|plate)_shapes|timing"
    r"|^stage$|version|package|memory|thinness|seconds|sweep.journal|nc: summary$"
)
PRESENT = re.compile(
    r"^size|\bsize\b|^solver|\bsolver\b|residual|error|difference|iterations|factorizations|newton|failed_start|start$"
    r"|steps$|nodes$|note$|reasons?$|warnings?$|region|counted|count_method|unknowns|cells|degree$|phase"
)
FREQUENCIES = re.compile(r"omega|frequency|period$|root$")
# What follows from the scene by closed forms or plain quadrature.
CLOSED = re.compile(
    r"summary\.(scene|bodies|thread|string)\b|summary\.floats(\[\d+\])?\.(mass|moment|centre|reference|waterplane|\w*_stiffness)"
    r"|(body|float)_(mass|moment|draught|waterplane|centre|radius|metacentric|reference|\w*stiffness|displaced)"
    r"|inertia_matrix|hydrostatic_stiffness|wave_?(number|length|_elevation|_spectrum)|initial$|: thread_"
)
# Of shapes, whose errors are the roots of those of frequencies.
SHAPES = re.compile(
    r"deflection|elevation|displacement_of|shape|^motion$|fraction|participation|runner_up|modal_mass|out_of_plane"
    r"|body_amplitudes|resonance_amplitude|sharing|tail"
)
SIGNED_BY = ("mode", "shape", "growing_mode")
# Dimensions along which the mesh, or the solver, chooses the places.
OF_THE_MESH = re.compile(r"^(point|position|node|mode_s|step_end|spectrum_omega|curve_omega|row|shape_s)|_row$")
ABSOLUTE = re.compile(
    r"(^|_)(position|tension|reaction|moment|air_gap|drift|absolute|root)_error$|pressure_error|response_absolute"
)
"""Errors in the unit of what they belong to; all others are relative."""
BESIDE = (
    (r"^(mode_)?(omega|frequency_hz)$", "mode_relative_error"),
    (r"added_mass|radiation_damping|_force|re_.*force|im_.*force", "radiation_relative_error"),
    (r"^RAO$|(reflection|transmission)_coefficient|partial_waves|_width$", "response_relative_error"),
    (r"^pressure_on_(body_\d+)$", r"pressure_error_on_\1"),
    (r"^near_field_drift$", "drift_error"),
    (r"impulse", "impulse_relative_error"),
    (r"^(position|tension|reaction)$|^contact_force$", r"equilibrium_\1_error"),
    (r"^end_(position|tension|moment)s$", r"\1_error"),
    (r"^reactions$", "reaction_error"),
    (r"^(largest|smallest)_tension$", "tension_error"),
    (r"^(displacement|largest_displacement|angle|largest_angle)$", "response_absolute_error"),
)
"""Errors that bear other names than what they belong to."""
NEAR = 1e-9
"""Of the largest value: rounding, also of what is printed of a number in a record."""
MOST = 24
"""Values that a record keeps of an axis."""
NODES = 0.05
"""Of the largest value of a field, which the nodes of another mesh may miss."""
PICTURE_SIZE = 0.2
CURVES = ("response_curve.csv", "radiation_curve.csv")
"""Tables whose rows the solver chooses."""


# Making


def run_case(name: str, folder: Path, program: Iterable[str]) -> Record:
    """Run the command of a case, and return its record, which is written beside the results."""
    case = CASES[name]
    folder.mkdir(parents=True, exist_ok=True)
    scene = ROOT / "scenes" / f"{case['scene']}.toml"
    if "\n" in case["scene"]:
        scene = folder / "scene.toml"
        scene.write_text(case["scene"], encoding="utf-8")
    command, *options = shlex.split(case.get("command", "run --no-images --quiet"))
    options += [part for change in case.get("set", ()) for part in ("--set", change)]
    if command not in ("check", "compare"):
        options += ["--out", str(folder / "results")]
    wide = {**os.environ, "COLUMNS": "200", "NO_COLOR": "1"}
    done = subprocess.run(
        [*program, command, str(scene), *options], capture_output=True, text=True, env=wide, cwd=folder, check=False
    )
    record = {"exit code": done.returncode, **record_of(folder / "results"), **printed(command, done.stdout)}
    (folder / "output.txt").write_text(done.stdout + done.stderr, encoding="utf-8")
    (folder / "record.json").write_text(json.dumps(record, ensure_ascii=False, indent=0), encoding="utf-8")
    return record


def printed(command: str, text: str) -> Record:
    """What `check` and `compare` print: fields and sizes, or tables."""
    if command == "check":
        rows = [[cell.strip() for cell in line.strip("│").split("│")] for line in text.splitlines() if line[:1] == "│"]
        numbers = [float(word) for word in re.findall(r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?\b|\bnan\b|\binf\b", text)]
        names = [row[0] for row in rows if row[0]]
        return {"check: names": names, "check: a number is NaN": any(map(math.isnan, numbers))}
    found: Record = {}
    for line in text.splitlines() if command == "compare" else ():
        name, *cells = re.split(r"\s{2,}", line.strip())
        values = [_number(cell) for cell in cells]
        if cells and None not in values[:1]:
            kept = np.array([value for value in values if value is not None])
            found[f"compare: {name}"] = entry(kept, 2e-3 * np.abs(kept))
    return found


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
    values, error = np.asarray(values, dtype=float), np.broadcast_to(np.asarray(error, dtype=float), np.shape(values))
    finite = np.abs(values[np.isfinite(values)])
    kept = np.ix_(*(_thinned(size) for size in values.shape)) if values.ndim else ()
    found: Record = {
        "shape": list(values.shape),
        "largest": _short(float(finite.max(initial=0.0))),
        "values": np.vectorize(_short, otypes=[object])(values[kept]).tolist() if values.size else [],
    }
    uniform = error.size == 0 or float(error.max()) == float(error.min())
    found["error"] = (
        _short(float(error.max(initial=0.0)), 3)
        if uniform
        else np.vectorize(lambda x: _short(x, 3), otypes=[object])(error[kept]).tolist()
    )
    if any(OF_THE_MESH.search(dim) for dim in dims):
        found["of_the_mesh"] = True
    if dims and dims[0] in SIGNED_BY:
        found["signed"] = False
    if groups:
        found["groups"] = groups
    return found


def _thinned(size: int) -> Array:
    return np.unique(np.linspace(0, size - 1, min(size, MOST)).round().astype(int))


def _short(value: float, digits: int = 10) -> float | str:
    return float(f"{value:.{digits}g}") if math.isfinite(value) else str(value)


def name_of(key: str) -> str:
    """The name of a quantity: the last part of its key."""
    return re.split(r"[.: ]+", key)[-1]


def with_error(key: str, values: Array, errors: Mapping[str, Array], whole: float, dims: tuple[str, ...] = ()) -> Array:
    """Absolute errors of values: stated beside them, or the root of that of the run where none is."""
    if CLOSED.search(key) or dims == (name_of(key),):
        return np.asarray(
            math.sqrt(NEAR) * 1e-2 * np.abs(np.nan_to_num(values, posinf=0.0, neginf=0.0)).max(initial=0.0)
        )
    stated = next((name for name in names_of_errors(name_of(key)) if name in errors), None)
    if SHAPES.search(name_of(key)) or stated is None:
        return np.asarray(math.sqrt(whole) * scales(values, dims))
    error = np.abs(np.where(np.isfinite(errors[stated]), errors[stated], whole))
    # Along the leading dimensions of the values, or one for all.
    fits = error.shape == values.shape[: error.ndim]
    spread = error.reshape(error.shape + (1,) * (values.ndim - error.ndim)) if fits else np.max(error, initial=0.0)
    if ABSOLUTE.search(stated):
        return np.asarray(spread)
    return np.asarray(spread * (np.abs(np.nan_to_num(values)) if FREQUENCIES.search(key) else scales(values, dims)))


def names_of_errors(name: str) -> Iterator[str]:
    """Names under which the error of a quantity may be stated: its own, those of its first words, that of its table."""
    words = name.split("_")
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
    # What a symmetry makes zero is compared with a thousandth of the rest.
    return np.asarray(np.maximum(largest, 1e-3 * overall))


def numbers(
    key: str, values: Array, errors: Mapping[str, Array], whole: float, dims: tuple[str, ...] = (), groups: Any = None
) -> Record:
    """The record of numbers under a key, by what it is."""
    if DROPPED.search(key):
        return {}
    if is_present(key):
        return {key: "present"}
    if values.dtype.kind in "iub":
        return {key: {"exactly": values.tolist()}} if values.size <= MOST else {key: entry(values, 0.0, dims)}
    if groups and values.ndim == 1 and not FREQUENCIES.search(name_of(key)):
        values = np.where(
            np.isin(np.arange(len(values)), [place for group in groups for place in group]), np.nan, values
        )
    return {key: entry(values, with_error(key, values, errors, whole, dims), dims, groups if values.ndim > 1 else None)}


def is_present(key: str) -> bool:
    """Whether of a quantity only its presence counts."""
    return not key.startswith("summary.scene") and any(PRESENT.search(part) for part in re.split(r"[.: ]+", key)[1:])


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
        chosen = ("row",) if path.name in CURVES or path.name == "study.csv" else ("line",)
        found |= numbers(f"{name}: {heading}", column, errors, whole, chosen, groups)
    return found


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
            own = {one: error.values for one, error in errors.items() if error.dims == variable.dims[: error.ndim]}
            if "complex" in dims:
                own = {one: error.values for one, error in errors.items() if error.dims == dims[: error.ndim]}
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
            if DROPPED.search(key):
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
        if gradients and "displacement" in key:
            continue
        largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
        found[f"{name}: {key}: largest"] = entry(np.array(largest), max(math.sqrt(whole), NODES) * largest)
    return found


def _flat(node: Any) -> Iterator[Any]:
    for one in node:
        yield from _flat(one) if isinstance(one, list) else (one,)


def _is_array(node: Any) -> bool:
    if not isinstance(node, list):
        return _is_number(node)
    if not node or not all(_is_number(one) for one in _flat(node)):
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


# Commands


@click.group()
def main() -> None:
    """Make golden corpora and compare them."""


@main.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.argument("names", nargs=-1, type=click.Choice(list(CASES)))
@click.option("--commit", help="Commit or tag whose program is run; the working copy by default.")
@click.option("--subset", is_flag=True, help="Run those cases only that the default tests run.")
def make(folder: Path, names: tuple[str, ...], commit: str | None, subset: bool) -> None:
    """Run all cases, or those named, and write results and records below FOLDER."""
    with tempfile.TemporaryDirectory() as temporary:
        tree = ROOT if commit is None else Path(temporary) / "tree"
        if commit is not None:
            _extract(commit, tree)
        for name in names or (SUBSET if subset else CASES):
            record = run_case(name, folder.resolve() / name, [str(tree / "hydro")])
            click.echo(f"{name}: exit code {record['exit code']}")


def _extract(commit: str, tree: Path) -> None:
    tree.mkdir()
    archive = subprocess.run(["git", "-C", str(ROOT), "archive", commit], capture_output=True, check=True).stdout
    subprocess.run(["tar", "-x", "-C", str(tree)], input=archive, check=True)


@main.command()
@click.argument("before", type=click.Path(path_type=Path, exists=True))
@click.argument("after", type=click.Path(path_type=Path, exists=True))
def compare(before: Path, after: Path) -> None:
    """Print all that differs by more than the stated errors; exit code 1 if there is anything."""
    names = sorted({path.parent.name for path in (*before.glob("*/record.json"), *after.glob("*/record.json"))})
    count = 0
    for name in names:
        for difference in differences(read_record(before / name), read_record(after / name)):
            click.echo(f"{name}: {difference}")
            count += 1
    click.echo(f"{len(names)} cases, {count} differences")
    raise SystemExit(1 if count else 0)


def read_record(folder: Path) -> Record:
    """The record of a case; empty where it was not made."""
    path = folder / "record.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


@main.command()
def reference() -> None:
    """Make the records of the subset anew, which the default tests compare with."""
    REFERENCE.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        for name in SUBSET:
            record = run_case(name, Path(temporary) / name, [str(ROOT / "hydro")])
            text = json.dumps(record, ensure_ascii=False, separators=(",", ":")).replace('"summary.', '\n"summary.')
            (REFERENCE / f"{name}.json").write_text(text + "\n", encoding="utf-8")
    size = sum(path.stat().st_size for path in REFERENCE.iterdir())
    click.echo(f"{len(SUBSET)} records, {size} bytes")


if __name__ == "__main__":
    main()
