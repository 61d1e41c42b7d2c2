"""The solution of the scene of a hanging string, and the reasons why it may miss the tolerance."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.physics.string_motions import Motion
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.physics import end_motion


@dataclass(frozen=True, kw_only=True)
class StringResult:
    """A solved scene."""

    scene: StringScene
    solution: StringSolution  # displacements and free motions

    @property
    def method(self) -> str:
        """The word "series", or "field"."""
        return self.scene.method

    @property
    def motion(self) -> Motion:
        """Motion of the upper end."""
        return end_motion(self.scene)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not reached; empty if it is."""
        solution = self.solution
        reasons = []
        if solution.relative_error > solution.tolerance:
            reasons.append(
                f"the displacement has an estimated error of {solution.relative_error:.1e} of the largest one, above "
                f"the tolerance {solution.tolerance:g}; {kept_tolerance(solution.relative_error)}"
            )
        if solution.frequency_error > solution.tolerance:
            reasons.append(
                f"the free motions have an estimated relative error of {solution.frequency_error:.1e}, above the "
                f"tolerance {solution.tolerance:g}"
            )
        return tuple(reasons)
