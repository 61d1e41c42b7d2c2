"""The parts of a beam: uniform sections, and joints between them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Section:
    """A uniform part of a beam, per metre of width."""

    length: float  # its length, m
    flexural_rigidity: float  # EI, N·m
    mass_per_length: float  # m, kg/m²

    def stiffness(self, wavenumber: float) -> float:
        """EI k⁴ of waves e^{ikx} along it."""
        return self.flexural_rigidity * wavenumber**4


@dataclass(frozen=True, kw_only=True)
class StretchedSection(Section):
    """A part under tension."""

    tension: float  # T per metre of width, N/m

    def stiffness(self, wavenumber: float) -> float:
        """EI k⁴ + T k² of waves e^{ikx} along it."""
        return super().stiffness(wavenumber) + self.tension * wavenumber**2


@dataclass(frozen=True, kw_only=True)
class Joint:
    """A place at which the slope may jump: k (w′(x+) − w′(x−)) = EI w″(x)."""

    at: float  # distance from the beam's left end, m
    rotational_stiffness: float  # k per metre of width, N·m/rad; 0 is a hinge
