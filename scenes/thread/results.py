"""The solution of the scene of a thread."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.thread.analyses import ThreadAnalyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.physics import no_sea_bed

Floats = NDArray[np.float64]

# Relative error of tensions above which slack of the thread is undetermined.
_TENSION_KNOWN = 0.1


@dataclass(frozen=True, kw_only=True)
class ThreadSolutionOfScene(ThreadAnalyses):
    """Results of all analyses of a scene."""

    scene: ThreadScene

    @cached_property
    def s(self) -> Floats:
        """Arc lengths at which the equilibrium is reported, m."""
        return np.array(self.scene.positions)

    @property
    def derived(self) -> dict[str, float]:
        """What follows from the scene alone: weight, drag and added mass, and the dimension of the model."""
        scene = self.scene
        return {
            "weight": scene.weight,
            "normal_drag": scene.normal_drag,
            "tangential_drag": scene.tangential_drag,
            "added_mass": scene.added_mass,
            "dimension": self.frame.dimension,
        }

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is not modelled and these results show: a sea bed."""
        ends = self.rest.end_positions
        words = no_sea_bed(self.scene, (float(ends[0, 2]), float(ends[1, 2])), self.rest.lowest_height)
        return (words,) if words else ()

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the results are not within the tolerances; empty if they are."""
        tolerance = self.scene.accuracy.tolerance
        judged = [("equilibrium", "of its positions and forces", self.rest.relative_error, tolerance)]
        for modes in self.modes:
            for kind, roots in (("frequency", modes.oscillating), ("root that does not oscillate", modes.aperiodic)):
                worst = float(np.max(roots.relative_errors, initial=0.0))
                judged.append(("modes", f"of a {kind}", worst, tolerance))
        for threshold in (threshold for sweep in self.stability for threshold in sweep.thresholds):
            judged.append(("stability", f"of the {threshold.kind}", threshold.error / threshold.value, tolerance))
        for motion, asked in zip(self.motions, self.scene.motions, strict=True):
            relative = motion.position_error / self.scene.thread.length
            judged.append(("motion", "of positions, of the length,", relative, asked.tolerance))
        slack = [
            f"motion: from {motion.slack[0].start:.6g} s on a part of the thread would be in compression"
            for motion in self.motions
            if motion.slack
        ]
        slack += [
            f"motion: the estimated error of tensions is {motion.extremes.error:.1e} N, of {motion.extremes.size:.1e} N"
            for motion in self.motions
            if motion.extremes.error > _TENSION_KNOWN * motion.extremes.size
        ]
        return *slack, *(
            f"{what}: the estimated error {of} is {error:.1e}; {kept_tolerance(error)}"
            for what, of, error, asked_error in judged
            if error > asked_error
        )
