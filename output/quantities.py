"""Quantities of a solution, each declared once. Every file and table of numbers is made from the declarations.

A kind of scene declares a tree: groups of quantities, each with a function that takes its value from a record of the
solution. `Group.evaluated` gives the values as nested dictionaries and lists, which are ``summary.json``;
`output.variables` makes labelled arrays of them, `output.quantity_tables` printed tables and the reference of all keys.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from typing import Any, TypeAlias

from hydroelastic.output.digits import number, per_cent, with_certain_digits
from hydroelastic.output.json_values import json_ready

Values: TypeAlias = dict[str, Any]
"""Values of a group by key, as in ``summary.json``."""


@dataclass(frozen=True)
class Quantity:
    """One quantity.

    Attributes:
        key: in ``summary.json`` and, behind the prefix of its group, in ``dataset.nc``.
        meaning: what it is, a phrase: the long name in ``dataset.nc``, the heading in tables.
        unit: in names of UDUNITS, "1" of a number without dimension; ``None`` of texts, truth values and numbers
            whose unit differs between entries.
        symbol: in formulas.
        short: heading of its column; by default the symbol, or without one the meaning.
        value: returns the value of a record: a number, text, truth value, list, array, or a dictionary by labels of
            its first dimension; by default the record's attribute of the name `key`.
        error: key of its estimated error in the same group: relative if that has the unit "1", else absolute.
        shown: format of a printed value, as ".1e", or "%" of a relative difference; by default the digits that are
            certain by the error.
        digits: most digits printed.
        printed: whether it is in printed tables.
        note: for the reference of keys: when it is missing, what belongs to it.
        dimensions: of an array or of lists within lists.
        variable: name in ``dataset.nc``, if it is not the key behind the prefix; "" where other arrays contain it.
        in_summary: whether it is in ``summary.json``; if not, it is an array of ``dataset.nc`` alone.
        joined: dimensions in ``dataset.nc`` of an array that the records of a list have together, see
            `output.joined_variables`; along those that `dimensions` lacks it has one place. This name, and the names of
            its dimensions, may contain attributes of the record in braces, as "deflection_of_body_{.number}".
        of_roll: units of the entries that belong to one rotation, and to two, where they differ from `unit`.
        phase: what its phase is relative to, for ``dataset.nc``.
        is_coordinate: whether it tells places of other arrays without being one of their dimensions.
        column: name of its columns in CSV files, if it is not the key, before the labels of its further dimensions.
        contract: whether its value is promised; where it depends on the mesh or the machine only its presence is.
    """

    key: str
    meaning: str
    unit: str | None = None
    symbol: str = ""
    _: KW_ONLY
    short: str = ""
    value: Callable[[Any], Any] | None = None
    error: str = ""
    shown: str = ""
    digits: int = 13
    printed: bool = True
    note: str = ""
    dimensions: tuple[str, ...] = ()
    variable: str | None = None
    in_summary: bool = True
    joined: tuple[str, ...] | None = None
    of_roll: tuple[str, ...] = ()
    phase: str = ""
    is_coordinate: bool = False
    column: str | None = None
    contract: bool = True

    def of(self, record: Any) -> Any:
        """Return the value of a record."""
        return _taken(self.key, self.value, record)

    def name_behind(self, prefix: str) -> str:
        """Return the name of its variable; "" where other arrays contain it."""
        return f"{prefix}_{self.key}".lstrip("_") if self.variable is None else self.variable

    @property
    def unit_with_rolls(self) -> str | None:
        """The unit, and those of entries that belong to rotations."""
        return None if self.unit is None else _with_rolls(self.unit, *self.of_roll)

    @property
    def unit_text(self) -> str:
        """The unit as people write it, as "N·s²/m³"; "" without one."""
        return "" if self.unit in (None, "1") else _with_rolls(*map(_as_written, (self.unit, *self.of_roll)))

    def of_rotations(self, count: int) -> Quantity:
        """Return the quantity with the unit of entries that belong to a number of rotations."""
        return replace(self, unit=(self.unit, *self.of_roll)[count], of_roll=()) if self.of_roll else self

    @property
    def label(self) -> str:
        """Meaning, symbol and unit, as "natural frequency k, rad/s"."""
        return ", ".join(filter(None, (f"{self.meaning} {self.symbol}".rstrip(), self.unit_text)))

    @property
    def heading(self) -> str:
        """Heading of a column, with the unit."""
        return ", ".join(filter(None, (self.short or self.symbol or self.meaning, self.unit_text)))

    def cell(self, values: Mapping[str, Any], group: Group) -> str:
        """Return the value as it is printed, the entries of a list one after the other."""
        value = values[self.key]
        if isinstance(value, list):
            between = "; " if any(isinstance(entry, list) for entry in value) else ", "
            return between.join(self.cell({**values, self.key: entry}, group) for entry in value)
        if value is None or isinstance(value, str):
            return value or "–"
        if isinstance(value, bool):
            return "yes" if value else "no"
        if self.shown:
            return per_cent(value) if self.shown == "%" else format(value, self.shown)
        if isinstance(value, int):
            return str(value)
        error = values[self.error] if self.error else None
        if value == 0.0 or error is None or isinstance(error, str):
            return number(value)
        if group[self.error].unit != "1":
            if abs(value) <= error:
                return "0"
            error /= abs(value)
        return with_certain_digits(value, max(error, 10.0**-self.digits))


@dataclass(frozen=True)
class Group:
    """Quantities of one record of a solution, or of each record of a list.

    Attributes:
        key: in ``summary.json``; "" of the whole.
        meaning: what its record is.
        parts: quantities and groups.
        record: returns the record, or the records, of the record of the group around it: by default its attribute of
            the name `key`. ``None`` where there is no such record: then the value of the group is null.
        dimension: along which a list of records, or a dictionary of records by labels, lies in ``dataset.nc``; "" of
            a single record.
        prefix: of the names of its variables in ``dataset.nc``; by default its key behind the prefix around it.
        note: for the reference of keys.
        contract: whether the values within are promised, unless a quantity says otherwise.
    """

    key: str
    meaning: str
    parts: tuple[Quantity | Group, ...]
    _: KW_ONLY
    record: Callable[[Any], Any] | None = None
    dimension: str = ""
    prefix: str | None = None
    note: str = ""
    contract: bool = True

    def __getitem__(self, key: str) -> Any:
        """Return the part of a key."""
        for part in self.parts:
            if part.key == key:
                return part
        raise KeyError(key)

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """The quantities within, without groups."""
        return tuple(part for part in self.parts if isinstance(part, Quantity))

    @property
    def arrays(self) -> tuple[Quantity, ...]:
        """The quantities that are in ``dataset.nc`` alone, of each record apart."""
        return tuple(part for part in self.quantities if not part.in_summary and part.joined is None)

    @property
    def groups(self) -> tuple[Group, ...]:
        """The groups within."""
        return tuple(part for part in self.parts if isinstance(part, Group))

    def with_nulls(self, values: Values) -> Values:
        """Return values by key; those that are missing are ``None``."""
        return {part.key: values.get(part.key) for part in self.parts}

    def name_behind(self, prefix: str) -> str:
        """Return the prefix of its variables, from that of the group around it."""
        return f"{prefix}_{self.key}".lstrip("_") if self.prefix is None else self.prefix

    def of(self, record: Any) -> Any:
        """Return the record or records of the group, from the record of the group around it."""
        return _taken(self.key, self.record, record)

    def records(self, record: Any) -> Sequence[Any]:
        """Return all records of the group, as a list, from the record of the group around it."""
        found = self.of(record)
        if self.dimension and isinstance(found, Mapping):
            found = found.values()
        return () if found is None else tuple(found) if self.dimension else (found,)

    def evaluated(self, record: Any) -> Values:
        """Return the values of the quantities in ``summary.json``, by key."""
        is_mapping = isinstance(record, Mapping)
        return {
            key: ready(_taken(key, function, record))
            for key, function, ready in self._in_summary
            if not is_mapping or function is not None or key in record
        }

    @cached_property
    def _in_summary(self) -> tuple[tuple[str, Callable[[Any], Any] | None, Callable[[Any], Any]], ...]:
        """Key, function and conversion to types of JSON of each part: a sweep asks for tens of thousands of values."""
        return tuple(
            (part.key, part.record, part._found) if isinstance(part, Group) else (part.key, part.value, json_ready)
            for part in self.parts
            if isinstance(part, Group) or part.in_summary
        )

    def _found(self, found: Any) -> Any:
        if found is None:
            return None
        if self.dimension and isinstance(found, Mapping):
            return {label: self.evaluated(one) for label, one in found.items()}
        return [self.evaluated(one) for one in found] if self.dimension else self.evaluated(found)

    def places(
        self, place: str = "", prefix: str = "", dimensions: tuple[str, ...] = ()
    ) -> Iterator[tuple[str, str, tuple[str, ...], Quantity | Group]]:
        """Yield each part within with its place."""
        for part in self.parts if self.contract else [replace(part, contract=False) for part in self.parts]:
            inner, name = f"{place}.{part.key}".lstrip("."), part.name_behind(prefix)
            if isinstance(part, Group):
                along = (*dimensions, part.dimension) if part.dimension else dimensions
                yield inner, name, along, part
                yield from part.places(inner, name, along)
            elif part.joined is not None:
                yield inner, part.variable or part.key, part.joined, part
            elif part.in_summary:
                yield inner, name, (*dimensions, *part.dimensions), part
            else:
                yield inner, part.variable or part.key, part.dimensions, part


def array(
    key: str,
    meaning: str,
    unit: str | None,
    dimensions: str,
    value: Callable[[Any], Any] | None = None,
    **further: Any,
) -> Quantity:
    """Return an array of ``dataset.nc`` alone."""
    return Quantity(key, meaning, unit, value=value, dimensions=tuple(dimensions.split()), in_summary=False, **further)


def _taken(key: str, function: Callable[[Any], Any] | None, record: Any) -> Any:
    if function is not None:
        return function(record)
    return record[key] if isinstance(record, Mapping) else getattr(record, key)


def _with_rolls(unit: str, *of_roll: str) -> str:
    match of_roll:
        case (one,):
            return f"{unit}, of roll {one}"
        case (one, two):
            return f"{unit}, with a roll {one}, of rolls {two}"
    return unit


def _as_written(unit: str) -> str:
    written = unit.replace("degree", "degrees").replace("^2", "²").replace("^3", "³")
    # With words between units a space separates these.
    return written if "," in written or " and " in written else written.replace(" ", "·")
