"""The force to which errors of tensions and forces are relative: in free fall the tension vanishes and is no scale."""

from __future__ import annotations

from math import inf

from hydroelastic.physics.thread import Thread

# Stretch whose force is the scale where no other force acts on a thread.
_STRETCH = 1e-6


def force_scale(model: Thread, speed: float) -> float:
    """The largest force that acts on a thread: |F| + k u² of a body, |w| L, (kn u + nv) u L, EI/L², ma u² if
    reactive."""
    reactive = 0.0 if model.reactive == "none" else model.added_mass * speed**2
    largest = max(
        *(float(sum(part**2 for part in body.dead_force) ** 0.5) + body.drag * speed**2 for body in model.bodies),
        abs(model.weight) * model.length,
        (model.normal_drag * speed + model.viscous_drag) * speed * model.length,
        model.flexural_rigidity / model.length**2,
        reactive,
    )
    if largest > 0.0 or model.axial_rigidity == inf:
        return largest
    return _STRETCH * model.axial_rigidity
