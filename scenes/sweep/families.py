"""Points of a sweep whose tanks have one liquid: it is meshed and solved once for all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from math import ceil
from typing import TYPE_CHECKING

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene

if TYPE_CHECKING:
    from hydroelastic.fem.tank.liquids import SharedLiquids

# With fewer points the answer of the liquid to all loads would cost more than it saves.
_FEWEST = 4
# One more scene of the sample for so many points: of few points further directions cost less than further solutions.
_FOR_EACH = 32


@dataclass(frozen=True, kw_only=True)
class Family:
    """Closed tanks that differ only in what does not touch the liquid.

    Attributes:
        name: a hash, which also tells families of different sweeps apart.
        sample: some scenes of the grid, with the first and the last one: all take a resolution that suffices for them,
            and the directions of their motions, so that the result of a point does not depend on which points were
            solved before.
        scenes: all of them.
    """

    name: str
    sample: tuple[TankScene, ...]
    scenes: tuple[TankScene, ...] = ()


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
    samples = {liquid: _sample(found) for liquid, found in members.items() if len(found) >= _FEWEST}
    return Families(
        known={
            liquid: Family(
                name=_hash(liquid, *(one.model_dump_json() for one in sample)),
                sample=sample,
                scenes=tuple(members[liquid]),
            )
            for liquid, sample in samples.items()
        }
    )


def _sample(scenes: list[TankScene]) -> tuple[TankScene, ...]:
    last = len(scenes) - 1
    count = 1 + ceil(len(scenes) / _FOR_EACH)
    return tuple(scenes[round(number * last / (count - 1))] for number in range(count))


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

        asked = family.sample[0].accuracy
        LAST.clear()
        LAST[family.name] = shared_liquids(
            [physical_tank(scene) for scene in family.sample], tolerance=asked.tolerance, modes=asked.modes
        )
        from hydroelastic.fem.tank.together import attempt_together

        attempt_together(
            LAST[family.name],
            [physical_tank(scene) for scene in family.scenes if scene not in family.sample],
            tolerance=asked.tolerance,
            modes=asked.modes,
        )
    return LAST[family.name]
