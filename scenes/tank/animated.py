"""Which natural modes of a tank are animated."""

from __future__ import annotations

from hydroelastic.scenes.output.provenance import Summary

# Always shown, whatever they are.
_LOWEST = 2
# Part of the elastic energy below which nobody would say that a body bends.
_BENDS = 0.005


def animated_modes(summary: Summary) -> list[int]:
    """Places of the lowest two modes, of the lowest mode of each kind, and of the one in which bodies bend most."""
    modes = summary["modes"]
    chosen = set(range(min(_LOWEST, len(modes))))
    kinds = [mode["kind"] for mode in modes]
    chosen |= {kinds.index(kind) for kind in kinds}
    bending = [mode["elastic_energy_fraction"] for mode in modes]
    if max(bending, default=0.0) >= _BENDS:
        chosen.add(bending.index(max(bending)))
    return sorted(chosen)
