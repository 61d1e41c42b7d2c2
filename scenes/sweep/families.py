"""Points of a sweep whose tanks have one liquid: it is meshed and solved once for all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from typing import TYPE_CHECKING

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene

if TYPE_CHECKING:
    from hydroelastic.fem.tank.liquids import SharedLiquids

# With fewer points the answer of the liquid to all loads would cost more than it saves.
_FEWEST = 4


@dataclass(frozen=True, kw_only=True)
class Family:
    """Closed tanks that differ only in what does not touch the liquid.

    Attributes:
        name: a hash, which also tells families of different sweeps apart.
        ends: the first and the last scene of the grid: all take a resolution that suffices for both, so that the result
            of a point does not depend on which points were solved before.
    """

    name: str
    ends: tuple[TankScene, TankScene]


@dataclass(frozen=True, kw_only=True)
class Families:
    """The families of a sweep, by what their liquid depends on."""

    known: dict[str, Family]

    def of(self, scene: Scene | SceneError) -> Family | None:
        """Return the family of a scene; ``None`` without one."""
        return self.known.get(_liquid_of(scene))


def families(scenes: Sequence[Scene | SceneError]) -> Families:
    """Return the families of the scenes of a grid."""
    members: dict[str, list[TankScene]] = {}
    for scene in scenes:
        if isinstance(scene, TankScene):
            members.setdefault(_liquid_of(scene), []).append(scene)
    members.pop("", None)
    return Families(
        known={
            liquid: Family(
                name=_hash(liquid, *(one.model_dump_json() for one in (found[0], found[-1]))),
                ends=(found[0], found[-1]),
            )
            for liquid, found in members.items()
            if len(found) >= _FEWEST
        }
    )


@lru_cache(maxsize=256)
def _liquid_of(scene: Scene | SceneError) -> str:
    """What the liquid of a scene depends on, as a text; "" where it is not shared."""
    if not isinstance(scene, TankScene) or scene.is_open or scene.mesh is not None or not scene.body:
        return ""
    from hydroelastic.fem.tank.liquids import liquid_key
    from hydroelastic.scenes.models.physical import physical_tank

    key = liquid_key(physical_tank(scene).scaled())
    return "" if key is None else _hash(repr(key), scene.accuracy.model_dump_json())


def _hash(*texts: str) -> str:
    return sha256("\n".join(texts).encode()).hexdigest()


LAST: dict[str, SharedLiquids] = {}
"""The liquids of the last family, by its name."""


def liquids_of(family: Family) -> SharedLiquids:
    """Return the liquids of a family, made when it is first asked for; those of the last family only are kept."""
    if family.name not in LAST:
        from hydroelastic.fem.tank.solve import shared_liquids
        from hydroelastic.scenes.models.physical import physical_tank

        asked = family.ends[0].accuracy
        LAST.clear()
        LAST[family.name] = shared_liquids(
            [physical_tank(scene) for scene in family.ends], tolerance=asked.tolerance, modes=asked.modes
        )
    return LAST[family.name]
