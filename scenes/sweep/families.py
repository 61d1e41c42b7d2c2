"""Points of a sweep: what identifies them, and those whose tanks have one liquid, meshed and solved once for all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene, read_scene

if TYPE_CHECKING:
    from hydroelastic.fem.tank.liquids import SharedLiquids

# With fewer points the answer of the liquid to all loads would cost more than it saves.
_FEWEST = 4
# One more scene of the sample for so many points: of few points further directions cost less than further solutions.
_FOR_EACH = 32


def identity(scene: Scene) -> str:
    """Return what identifies a scene: its values, and hashes of the bytes of all files that it names, of its section
    too."""
    texts = [scene.model_dump_json()]
    for named in _paths(scene):
        file = scene.folder / named
        # The names of the parts of a mesh, and the numbers of XDMF, stand in files beside it.
        beside = (file.with_name(f"{file.name}.names.json"), file.with_suffix(".h5"))
        texts += [f"{one.name} {sha256(one.read_bytes()).hexdigest()}" for one in (file, *beside) if one.is_file()]
    if scene.kind == "roll" and scene.section_file is not None:
        with suppress(SceneError):
            texts.append(identity(read_scene(scene.section_file)))
    return "\n".join(texts)


def _paths(value: Any) -> Iterator[Path]:
    if isinstance(value, Path):
        yield value
    elif isinstance(value, BaseModel):
        for _, entry in value:
            yield from _paths(entry)
    elif isinstance(value, tuple):
        for entry in value:
            yield from _paths(entry)


@dataclass(frozen=True, kw_only=True)
class Family:
    """Closed tanks that differ only in what does not touch the liquid.

    Attributes:
        name: a hash of all of them, which also tells families of different sweeps apart.
        sample: some scenes of the grid, with the first and the last one: all take a resolution that suffices for them,
            so that the result of a point does not depend on which points were solved before.
    """

    name: str
    sample: tuple[TankScene, ...]


@dataclass(frozen=True, kw_only=True)
class Families:
    """The families of a sweep, by what their liquid depends on."""

    known: dict[object, Family]

    def of(self, scene: Scene | SceneError) -> Family | None:
        """Return the family of a scene; ``None`` without one."""
        return self.known.get(_liquid_of(scene)) if isinstance(scene, TankScene) and self.known else None


def families(scenes: Sequence[Scene | SceneError]) -> Families:
    """Return the families of the scenes of a grid."""
    members: dict[object, list[TankScene]] = {}
    for scene in scenes:
        if isinstance(scene, TankScene):
            members.setdefault(_liquid_of(scene), []).append(scene)
    members.pop(None, None)
    known: dict[object, Family] = {}
    for liquid, own in members.items():
        if len(own) < _FEWEST:
            continue
        sample = tuple(own[place] for place in _places_of_sample(len(own)))
        known[liquid] = Family(name=_hash(repr(liquid), *map(identity, sample)), sample=sample)
    return Families(known=known)


def _places_of_sample(scenes: int) -> list[int]:
    count = 1 + ceil(scenes / _FOR_EACH)
    return [round(number * (scenes - 1) / (count - 1)) for number in range(count)]


def _liquid_of(scene: TankScene) -> object:
    """What the liquid of a scene depends on; ``None`` where it is not shared."""
    if scene.is_open or scene.mesh is not None or not scene.body:
        return None
    from hydroelastic.fem.tank.liquids import liquid_key
    from hydroelastic.scenes.models.physical import physical_tank

    key = liquid_key(physical_tank(scene).scaled())
    return None if key is None else (key, scene.accuracy)


def _hash(*texts: str) -> str:
    return sha256("\n".join(texts).encode()).hexdigest()


last_liquids: dict[str, SharedLiquids] = {}


def liquids_of(family: Family) -> SharedLiquids:
    """Return the liquids of a family, made when it is first asked for; those of the last family only are kept."""
    from hydroelastic.fem.tank.solve import shared_liquids
    from hydroelastic.scenes.models.physical import physical_tank

    if family.name not in last_liquids:
        asked, tanks = family.sample[0].accuracy, [physical_tank(scene) for scene in family.sample]
        last_liquids.clear()
        last_liquids[family.name] = shared_liquids(tanks, tolerance=asked.tolerance, modes=asked.modes)
    return last_liquids[family.name]
