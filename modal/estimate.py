"""What an older theory says about the first elastic tone, and what that number bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from hydroelastic.modal.beam.floating_beam import FloatingBeam

Bound = Literal["above_mode_index", "above_pressure_release_tone", "none"]
"""``above_mode_index``: not below the exact frequency number ``mode_index`` (zero modes not counted);
``above_pressure_release_tone``: not below frequency number ``mode_index`` of the problem with ψ = 0 around the beam."""


class NoEstimateError(ValueError):
    """The method has no value for this beam; the message says why."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """One estimate of the first elastic tone."""

    omega: float | None  # angular frequency, rad/s, or ``None`` where the method has no meaning
    added_mass_per_length: float | None  # m_a = (EI κ⁴ + s ρ g)/ω² − m, kg/m², or ``None``
    note: str  # what the method neglects, or why there is no number
    bound: Bound  # which exact quantity lies below ``omega``
    mode_index: int | None = None  # number of that quantity, from 1; ``None`` with bound "none"

    def __post_init__(self) -> None:
        """Refuse a number that is not one, and a bound without its index."""
        for name in ("omega", "added_mass_per_length"):
            value = getattr(self, name)
            if value is not None and not math.isfinite(value):
                raise ValueError(f"{name} is {value}; leave it None where it has no meaning")
        if (self.bound == "none") != (self.mode_index is None):
            raise ValueError("mode_index goes with every bound but 'none'")


def without_number(note: str, reason: str) -> Estimate:
    """Return an estimate without a number: what the method is, and why it has no value here."""
    return Estimate(omega=None, added_mass_per_length=None, note=f"{note} No value: {reason}.", bound="none")


def added_mass_from_frequency(beam: FloatingBeam, omega: float) -> float:
    """Return m_a = (EI κ₁⁴ + s ρ g)/ω² − m, kg/m².

    The hydrostatic stiffness is part of what the frequency balances, and the dry frequency (infinite for m → 0) does
    not appear.

    Args:
        omega: frequency of the wet tone, rad/s, positive.

    Source: theory of the aquarium, docs, § 1.3, erratum 9.
    """
    _check_omega(omega)
    return beam.first_dry_stiffness / omega**2 - beam.mass_per_length


def frequency_from_added_mass(beam: FloatingBeam, added_mass: float) -> float:
    """Return ω = √((EI κ₁⁴ + s ρ g)/(m + m_a)), rad/s, for an added mass in kg/m²."""
    return math.sqrt(beam.first_dry_stiffness / (beam.mass_per_length + added_mass))


def _check_omega(omega: float) -> None:
    if not omega > 0:
        raise ValueError(f"omega is {omega}; it must be positive")


def difference(value: float | None, reference: float | None) -> float | None:
    """Return the relative difference of a value to a reference in the same unit, where there are both."""
    return None if value is None or not reference else value / reference - 1.0
