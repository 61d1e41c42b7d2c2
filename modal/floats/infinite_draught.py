"""The exponential float of infinite draught of the paper, compared with one that ends at its tail."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hydroelastic.modal.floats.thin_float_radiation import natural_rate
from hydroelastic.modal.floats.thin_float_resonance import heave_pole, second_pole
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile


@dataclass(frozen=True, kw_only=True)
class InfiniteDraughtFloat:
    """The float of infinite draught after a release in infinitely deep liquids, by the closed form."""

    # estimate of the largest |f − f_∞| over all times, f = s/s₀ of the float with its end and f_∞ without; at most 2
    cut: float
    resonances: tuple[complex, complex]  # ω − iγ, rad/s, of heave and of the second pole, of motions e^{−iωt}
    residues: tuple[complex, complex]  # f contains 2 Re(residue e^{−iωt}) of each


def infinite_draught_float(profile: Profile, layers: TwoLayers) -> InfiniteDraughtFloat:
    """Return poles and residues of an exponential float without its end, and the effect of the end on the motion.

    Args:
        profile: an exponential, with an end or without.
        layers: infinitely deep liquids.
    """
    infinite, rate = replace(profile, tail=0.0), natural_rate(profile, layers)
    poles = heave_pole(infinite), second_pole(infinite)
    return InfiniteDraughtFloat(
        cut=cut_distance(profile),
        resonances=(
            1j * poles[0].frequency.conjugate() * rate,
            1j * poles[1].frequency.conjugate() * rate,
        ),
        residues=(poles[0].residue.conjugate(), poles[1].residue.conjugate()),
    )


def cut_distance(profile: Profile) -> float:
    """Return the approximate largest |f − f_∞| of an exponential that ends where its width is a part ``tail`` of b:

        2/(eτ) tail (1 + ln 1/tail), at most 2.

    The end takes the part tail (1 + ln 1/tail) of the float's mass away, to the order of tail, which raises Ω by half
    of it; the phase that this adds is largest beside the amplitude e^{−γt} at t = 1/γ, γ ≈ Ωτ/4. Against the closed
    forms of both, for tails from 1e-2 to 1e-6 and τ from 0.01 to 1, it is 1.05 to 1.25 times too large wherever it is
    below 0.6; for τ = 3, 1.5 times.
    """
    tail = profile.tail
    if not tail:
        return 0.0
    slenderness = profile.half_width / profile.half_height
    return min(2.0 / (math.e * slenderness) * tail * (1.0 - math.log(tail)), 2.0)
