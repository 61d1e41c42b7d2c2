"""Points of a sweep: what identifies them, and those whose tanks have one liquid, meshed and solved once for all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
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
# Points that are solved together. Measured: with half as many, or twice, a sweep takes as long; more take more memory.
_TOGETHER = 64


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
    """All paths among the values of a scene."""
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
    """Closed tanks that differ only in what does not touch the liquid, and some of them that are solved together.

    Attributes:
        name: a hash of all of them, which also tells families of different sweeps apart.
        sample: some scenes of the grid, with the first and the last one: all take a resolution that suffices for them,
            and the directions of their motions, so that the result of a point does not depend on which points were
            solved before.
        batch: number of those that are solved together.
        together: their scenes, without those of the sample; none for a point beside the grid.
    """

    name: str
    sample: tuple[TankScene, ...]
    batch: int = -1
    together: tuple[TankScene, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Families:
    """The families of a sweep, by what their liquid depends on, and by the scenes of the grid."""

    known: dict[object, Family]
    of_scenes: dict[TankScene, Family]

    def of(self, scene: Scene | SceneError) -> Family | None:
        """Return the family of a scene; ``None`` without one."""
        if not isinstance(scene, TankScene) or not self.known:
            return None
        return self.of_scenes.get(scene) or self.known.get(_liquid_of(scene))


def families(scenes: Sequence[Scene | SceneError]) -> Families:
    """Return the families of the scenes of a grid."""
    members: dict[object, list[TankScene]] = {}
    for scene in scenes:
        if isinstance(scene, TankScene):
            members.setdefault(_liquid_of(scene), []).append(scene)
    members.pop(None, None)
    known: dict[object, Family] = {}
    of_scenes: dict[TankScene, Family] = {}
    for liquid, own in members.items():
        if len(own) < _FEWEST:
            continue
        places = _places_of_sample(len(own))
        sample = tuple(own[place] for place in places)
        family = Family(name=_hash(repr(liquid), *map(identity, sample)), sample=sample)
        known[liquid] = family
        for batch, first in enumerate(range(0, len(own), _TOGETHER)):
            batched = range(first, min(first + _TOGETHER, len(own)))
            others = tuple(own[place] for place in batched if place not in places)
            one = replace(family, batch=batch, together=others)
            of_scenes |= {own[place]: one for place in batched}
    return Families(known=known, of_scenes=of_scenes)


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


@dataclass
class _Shared:
    """The liquids of a family, and the batch whose first attempts are made."""

    liquids: SharedLiquids
    batch: int = -1


LAST: dict[str, _Shared] = {}
"""Those of the last family, by its name."""


def liquids_of(family: Family) -> SharedLiquids:
    """Return the liquids of a family, made when it is first asked for, with the first attempts at the tanks of its
    batch; those of the last family and batch only are kept."""
    from hydroelastic.fem.tank.solve import shared_liquids
    from hydroelastic.fem.tank.together import attempt_together
    from hydroelastic.scenes.models.physical import physical_tank

    asked = family.sample[0].accuracy
    if family.name not in LAST:
        LAST.clear()
        tanks = [physical_tank(scene) for scene in family.sample]
        LAST[family.name] = _Shared(shared_liquids(tanks, tolerance=asked.tolerance, modes=asked.modes))
    shared = LAST[family.name]
    if family.batch not in (-1, shared.batch):
        shared.batch, tanks = family.batch, [physical_tank(scene) for scene in family.together]
        if tanks:
            attempt_together(shared.liquids, tanks, tolerance=asked.tolerance, modes=asked.modes)
    return shared.liquids
