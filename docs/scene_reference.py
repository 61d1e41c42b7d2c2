"""Write the reference of all keys of scenes, `docs/reference/*.md`, from the models that scenes are read with.

Run it after a change of a model: ./hydro python docs/scene_reference.py
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, Discriminator, Tag
from pydantic.fields import FieldInfo

from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.round_tank import CanalScene, RoundTankScene
from hydroelastic.scenes.models.scene_model import LARGEST, SMALLEST
from hydroelastic.scenes.models.values import OR_SWEEP, Sweep
from hydroelastic.scenes.read import SCENE_MODELS

FOLDER = Path(__file__).parent / "reference"
PAGES = {**SCENE_MODELS, "level_tank": LevelTankScene, "round_tank": RoundTankScene, "canal": CanalScene}
"""The model of each page; a tank in three dimensions has the kind of one in two."""
TITLES = {
    "tank": "Keys of a tank or of open water",
    "sea": "Keys of bodies in the sea",
    "level_tank": "Keys of a tank in three dimensions",
    "round_tank": "Keys of a tank of revolution with floats or a shaped bed",
    "canal": "Keys of a tank of one section over a finite width",
    "string": "Keys of a hanging string",
    "thread": "Keys of a flexible thread",
    "roll": "Keys of a ship on a swell",
}
GUIDES = {
    "tank": "scenes.md",
    "sea": "scenes.md",
    "level_tank": "scenes_three_dimensions.md",
    "round_tank": "scenes_three_dimensions.md",
    "canal": "scenes_three_dimensions.md",
    "string": "scenes_strings_and_ships.md",
    "thread": "scenes_threads.md",
    "roll": "scenes_strings_and_ships.md",
}
UNITS = (
    *("m", "s", "kg", "N", "1/s", "m²", "rad", "rad/s", "rad/m", "1/rad", "degrees", "m/s", "m/s²", "kg/m³", "kg/m²"),
    *("kg/m", "kg·m", "kg·m²", "m²·s/rad", "kg/(m·s)", "N·m", "N·m/rad", "N·m²", "N/m", "N·s/m²", "N/m²"),
)
UNIT = re.compile(rf"(?:^|, )({'|'.join(map(re.escape, sorted(UNITS, key=len, reverse=True)))})(?=$|[;,])")
SWEEP_TITLE = "Values as a table"
SWEEP_LINK = "#values-as-a-table"


@dataclass(frozen=True, kw_only=True)
class Holder:
    """A field that holds tables, and what it may hold.

    Args:
        models: by their kind; the only one of a field without kinds has the kind None.
        many: whether it is a list of tables.
        kind_by_default: which is meant by a table without a kind, or None.
    """

    models: dict[str | None, type[BaseModel]]
    many: bool
    kind_by_default: str | None


@dataclass(kw_only=True)
class Section:
    """A table of a scene: the TOML headers by which it is written, and the model of its keys."""

    headers: list[str]
    model: type[BaseModel]
    kind: str | None
    kind_by_default: str | None
    note: str

    @property
    def title(self) -> str:
        """Heading of the section."""
        headers = " or ".join(f"`{header}`" for header in self.headers)
        return f"{headers}: {self.kind}" if self.kind else headers


def page(kind: str) -> str:
    """Return the page of a kind of scene as Markdown."""
    root = PAGES[kind]
    sections = sections_of(root)
    lines = [
        f"# {TITLES[kind]}",
        "",
        f"Written by `docs/scene_reference.py` from the models of `scenes/models/`. Examples and what fits together: "
        f"[guide](../{GUIDES[kind]}); numbers, lists and paths in general: [reference](index.md).",
        "",
        *("## At the top of the file", "", *_rows(root, sections, kind_by_default=None)),
    ]
    for section in sections:
        lines += [
            "",
            f"## {section.title}",
            "",
            " ".join(filter(None, (_first_paragraph(section.model), section.note))),
            "",
        ]
        lines += _rows(section.model, sections, kind_by_default=section.kind_by_default, holder=section)
    if any(OR_SWEEP in line for line in lines):
        lines += ["", f"## {SWEEP_TITLE}", "", _first_paragraph(Sweep), ""]
        lines += _rows(Sweep, [], kind_by_default=None)
    return "\n".join(lines).replace(OR_SWEEP, f"or a [table]({SWEEP_LINK}) of them") + "\n"


def sections_of(root: type[BaseModel]) -> list[Section]:
    """All tables of a scene, in the order of its models; of one that may stand in several places, one section."""
    found: dict[type[BaseModel], Section] = {}
    for section in _walk(root, ""):
        if section.model in found:
            known = found[section.model].headers
            if section.headers[0] not in known:
                known += section.headers
                found[section.model].note = ""
        else:
            found[section.model] = section
    return list(found.values())


def _walk(model: type[BaseModel], path: str) -> Iterator[Section]:
    for name, field in model.model_fields.items():
        holder = _holder(field)
        for kind, inner in holder.models.items():
            way = f"{path}{name}"
            yield Section(
                headers=[f"[[{way}]]" if holder.many else f"[{way}]"],
                model=inner,
                kind=kind,
                kind_by_default=holder.kind_by_default,
                note=_how_many(field, holder),
            )
            yield from _walk(inner, f"{way}.")


def _holder(field: FieldInfo) -> Holder:
    many = False
    models: dict[str | None, type[BaseModel]] = {}
    annotation: Any = field.annotation
    metadata = list(field.metadata)
    while get_origin(annotation) in (tuple, Annotated, Union, UnionType):
        if get_origin(annotation) is Annotated:
            metadata += annotation.__metadata__
            annotation = get_args(annotation)[0]
            continue
        parts = [part for part in get_args(annotation) if part not in (type(None), Ellipsis)]
        if len(parts) > 1 and get_origin(annotation) is not tuple:
            models = {_tag(part): get_args(part)[0] for part in parts if get_origin(part) is Annotated}
            break
        many |= get_origin(annotation) is tuple
        annotation = parts[0]
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        models = {None: annotation}
    choose = next((part.discriminator for part in metadata if isinstance(part, Discriminator)), None)
    return Holder(models=models, many=many, kind_by_default=str(choose({})) if callable(choose) else None)


def _tag(part: Any) -> str:
    return next(extra.tag for extra in part.__metadata__ if isinstance(extra, Tag))


def _how_many(field: FieldInfo, holder: Holder) -> str:
    if not holder.many:
        if len(holder.models) > 1:
            return "One of the kinds of this table."
        return "The table is required." if field.is_required() else "The table may be left out."
    least, most = _bounds(field.metadata, "min_length", "max_length")
    if most is not None:
        return f"{least} to {most} of these tables." if field.is_required() else f"Up to {most} of these tables."
    return "Any number of these tables."


def _first_paragraph(model: type[BaseModel]) -> str:
    return " ".join((model.__doc__ or "").strip().split("\n\n")[0].split()).replace("``", "`")


def _rows(
    model: type[BaseModel], sections: list[Section], *, kind_by_default: str | None, holder: Section | None = None
) -> list[str]:
    chosen_by_kind = holder is None or holder.kind is not None
    lines = ["| key | type | unit | default | allowed | meaning |", "|---|---|---|---|---|---|"]
    for name, field in sorted(model.model_fields.items(), key=lambda item: item[0] != "kind"):
        unit, meaning = _unit_and_meaning(field)
        default = _default(field)
        if name == "kind" and chosen_by_kind and field.default != kind_by_default:
            default = "required"
        shown = [_linked(name, field, sections), _type(field), unit, default, _allowed(field), meaning]
        lines.append("| " + " | ".join(cell.replace("|", r"\|") for cell in shown) + " |")
    return lines


def _linked(name: str, field: FieldInfo, sections: list[Section]) -> str:
    """A key; of a table, with links to its sections."""
    models = _holder(field).models.values()
    anchors = [anchor(section.title) for section in sections if section.model in models]
    if not anchors:
        return f"`{name}`"
    if len(anchors) == 1:
        return f"[`{name}`](#{anchors[0]})"
    kinds = [section.kind for section in sections if section.model in models]
    links = ", ".join(f"[{kind}](#{anchor})" for kind, anchor in zip(kinds, anchors, strict=True))
    return f"`{name}`: {links}"


def anchor(title: str) -> str:
    """The anchor that readers of Markdown give a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def _unit_and_meaning(field: FieldInfo) -> tuple[str, str]:
    """Take the unit out of a description; of several, each is left where it stands."""
    text = field.description or ""
    units = UNIT.findall(text)
    if len(units) == 1:
        text = UNIT.sub("", text).lstrip("; ")
    return ", ".join(units), text


def value_type(field: FieldInfo) -> tuple[Any, list[Any], str]:
    """What one value of a field is, its limits, and ``list`` or ``list of 3`` around it."""
    annotation: Any = field.annotation
    limits, around = list(field.metadata), ""
    while True:
        if get_origin(annotation) is Annotated:
            for part in annotation.__metadata__:
                limits += getattr(part, "metadata", [part])
            annotation = get_args(annotation)[0]
        elif type(None) in get_args(annotation):
            (annotation,) = (part for part in get_args(annotation) if part is not type(None))
        elif get_origin(annotation) is tuple:
            parts = get_args(annotation)
            around += "list of " if Ellipsis in parts else f"list of {len(parts)} "
            annotation = parts[0]
        else:
            return annotation, limits, around


NAMES = {float: "number", int: "whole number", bool: "truth value", str: "text", Path: "path"}


def _type(field: FieldInfo) -> str:
    holder = _holder(field)
    if holder.models:
        return "list of tables" if holder.many else "table"
    annotation, _, around = value_type(field)
    name = "text" if get_origin(annotation) is Literal else NAMES[annotation]
    if not around:
        return name
    # A list of lists: only the innermost are of single values.
    return re.sub(r"(list of( \d)?) list", r"\1 lists", around) + f"{name}s"


def _allowed(field: FieldInfo) -> str:
    if _holder(field).models:
        return ""
    annotation, limits, around = value_type(field)
    said = []
    if get_origin(annotation) is Literal:
        said.append(", ".join(f'`"{choice}"`' for choice in get_args(annotation)))
    elif annotation in (float, int):
        said.append(_range(*_bounds(limits, "ge", "le"), whole=annotation is int))
    least, most = _bounds(limits, "min_length", "max_length")
    if around and most is not None:
        said.append(f"{least or 0} to {_number(most)} of them")
    return "; ".join(said)


def _bounds(limits: list[Any], lower: str, upper: str) -> tuple[Any, Any]:
    least = [getattr(limit, lower) for limit in limits if hasattr(limit, lower)]
    most = [getattr(limit, upper) for limit in limits if hasattr(limit, upper)]
    return max(least, default=None), min(most, default=None)


def _range(least: float, most: float, *, whole: bool) -> str:
    lower = {SMALLEST: "positive", 0: "≥ 0", -LARGEST: "any"}
    if not whole and most == LARGEST and least in lower:
        return lower[least]
    if most == float("inf"):
        return f"{lower[least]}, or `inf`"
    return f"{_number(least)} to {_number(most)}"


def _number(value: float) -> str:
    if isinstance(value, int) and value > 9999:
        return f"{value:,}".replace(",", " ")
    return re.sub(r"e-0?(\d)", r"e-\1", f"{value:.7g}").replace("-", "−" if "e" not in f"{value:.7g}" else "-")


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    return _shown(field.default)


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    if hasattr(value, "kind"):
        return f'kind = "{value.kind}"'
    if isinstance(value, BaseModel):
        given = {key: getattr(value, key) for key, field in type(value).model_fields.items() if field.is_required()}
        return ", ".join(f"{key} = {_shown(part)}" for key, part in given.items()) or "all defaults"
    if isinstance(value, tuple):
        return f"[{', '.join(map(_shown, value))}]" if value else "empty"
    if isinstance(value, str):
        return f'`"{value}"`'
    return str(value).lower() if isinstance(value, bool) else _number(value)


if __name__ == "__main__":
    for kind in PAGES:
        (FOLDER / f"{kind}.md").write_text(page(kind), encoding="utf-8")
