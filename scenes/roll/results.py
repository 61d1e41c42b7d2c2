"""The solution of the scene of a rolling ship, and the reasons why it may miss the tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.modal.roll.solution import RollSolution
from hydroelastic.scenes.models.roll import RollScene

if TYPE_CHECKING:
    from hydroelastic.fem.section_roll import SectionRoll


@dataclass(frozen=True, kw_only=True)
class RollResult:
    """A solved scene."""

    scene: RollScene
    solution: RollSolution  # the motion; the error of its ship is that of the section
    section: SectionRoll | None  # roll of the section by its field solution; ``None`` without one
    seconds: dict[str, float]  # time by stage

    @property
    def levels(self) -> tuple[float, ...]:
        """Levels whose exceedances are counted, rad."""
        return self.scene.output.levels

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not reached; empty if it is."""
        solution, tolerance = self.solution, self.scene.accuracy.tolerance
        relative = solution.relative_error
        if relative <= tolerance:
            return ()
        by_section = solution.ship_error > solution.angle_error
        cause = "; most of it comes from the section: ask for a smaller tolerance there" if by_section else ""
        return (
            f"the angle has an estimated error of {relative:.1e} of the largest one, above the tolerance "
            f"{tolerance:g}; {kept_tolerance(relative)}{cause}",
        )
