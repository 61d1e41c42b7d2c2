"""Well-posedness of the small motions of a thread without bending stiffness.

With the added mass M as a load that moves at W along a thread of mass m and tension T, waves of short length travel at
the speeds c of (m + M) c² − 2 M W c + M W² − T = 0. They are real for

    T ≥ m M W²/(m + M),

and T ≥ 0 without that load. Elsewhere waves grow at a rate that increases without bound with the wavenumber (Hadamard
instability), and solutions on finer meshes have no limit; only bending stiffness bounds the rate.
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.thread.equilibrium import Equilibrium, in_space
from hydroelastic.fem.thread.table import line_table

_SAMPLES_PER_ELEMENT = 8
# Of the largest tension. Next to a free tail without tension the field solution may have this error, of either sign.
_SLACK = 1e-4
# Where a stream along the thread requires tension, only rounding may be lacking.
_ROUNDING = 1e-9


class IllPosedError(ValueError):
    """The growth rate of short waves is unbounded; the message says where, and why."""


def require_real_wave_speeds(equilibrium: Equilibrium) -> None:
    """Refuse equilibria whose small motions are ill-posed."""
    model, units = equilibrium.model, equilibrium.units
    if model.bends:
        return
    nodes = equilibrium.space.nodes
    # Both ends of the thread among them.
    s = np.interp(
        np.arange(_SAMPLES_PER_ELEMENT * (len(nodes) - 1) + 1) / _SAMPLES_PER_ELEMENT, np.arange(len(nodes)), nodes
    )
    positions = line_table(equilibrium.solution, nodes, 0)
    tension = line_table(equilibrium.solution, nodes, 1).at(s)[:, 0] * units.force
    speed = np.zeros(len(s))
    if model.reactive != "none" and model.stream is not None:
        tangents = in_space(positions.at(s, 1))
        velocity = model.stream.velocity_at(in_space(positions.at(s)) * units.length)
        speed = np.sum(velocity * tangents, axis=1) / np.linalg.norm(tangents, axis=1)
    mass = model.mass + model.added_mass
    needed = model.mass * model.added_mass / mass * speed**2 if mass > 0.0 else np.zeros(len(s))
    scale = max(float(np.abs(tension).max()), float(needed.max()))
    excess = tension - needed + scale * np.where(needed > 0.0, _ROUNDING, _SLACK)
    worst = int(np.argmin(excess))
    if excess[worst] >= 0.0:
        return
    place = s[worst] * units.length
    if needed[worst] == 0.0:
        raise IllPosedError(
            f"tension is {tension[worst]:.4g} N at s = {place:.4g} m: a compressed thread without flexural_rigidity "
            "folds, the faster the shorter the fold, and no mesh resolves that; give it flexural_rigidity"
        )
    tail = not all(model.ends[int(place > 0.5 * model.length)].held) and worst in (0, len(s) - 1)
    where = "its free end" if tail else f"s = {place:.4g} m"
    raise IllPosedError(
        f"tension is {tension[worst]:.4g} N at {where}, less than m ma W²/(m + ma) = {needed[worst]:.4g} N with the "
        f"stream W = {speed[worst]:.4g} m/s along the thread: waves grow the faster the shorter they are, and no mesh "
        'resolves that; give the thread flexural_rigidity, or reactive = "none"'
    )
