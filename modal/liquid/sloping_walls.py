"""Closed forms of sloshing between walls that rise by 45 degrees from an edge or a tip at the depth H.

- a cone: ψ = r (z + H) cos θ with ω² = g/H;
- a canal of the width B along its edge: ψ = x (z + H) with ω² = g/H, and ψ = cosh κx cosh κ(z + H) cos kx' with
  ω² = gκ tanh κH, κ = k/√2, k = π/B.

Source: H. Lamb, *Hydrodynamics*, 6th ed., 1932, §§ 258, 261.
"""

from __future__ import annotations

from math import isclose, pi, sqrt, tanh

from hydroelastic.modal.plate.closed_forms import ExactMode
from hydroelastic.physics.tank import ROUND_OFF, Tank


def lowest_between_slopes(tank: Tank) -> tuple[ExactMode, ...]:
    """Return the lowest mode of a cone or a V-shaped canal of 45 degrees with nothing on its water; none of others."""
    depth, gravity = tank.layers[0].depth, tank.gravity
    sides = (
        [(0.0, -depth), (depth, 0.0)] if tank.geometry.is_revolved else [(0.0, 0.0), (depth, -depth), (2 * depth, 0.0)]
    )
    if tank.bodies or len(tank.layers) > 1 or tank.top != "free" or not _is_bed(tank, sides):
        return ()
    swaying = ExactMode(
        formula="ω² = g/H between walls of 45 degrees",
        order=int(tank.geometry.is_revolved),
        omega=sqrt(gravity / depth),
    )
    if tank.geometry.is_revolved:
        return (swaying,)
    slope = pi / tank.geometry.width / sqrt(2.0)
    along = ExactMode(
        formula="ω² = gκ tanh κH of a canal with walls of 45 degrees, κ = π/(√2 B)",
        order=1,
        omega=sqrt(gravity * slope * tanh(slope * depth)),
    )
    return (min(swaying, along, key=lambda mode: mode.omega),)


def _is_bed(tank: Tank, sides: list[tuple[float, float]]) -> bool:
    bed = tank.bed
    if not isinstance(bed, tuple) or len(bed) != len(sides):
        return False
    near = ROUND_OFF * tank.layers[0].depth
    return all(
        isclose(found, known, abs_tol=near)
        for one, other in zip(bed, sides, strict=True)
        for found, known in zip(one, other, strict=True)
    )
