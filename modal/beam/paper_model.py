"""The paper's own formulas as printed, beside their corrected forms, and the list of errata."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.cosine_moments import cosine_moments
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.estimate import added_mass_from_frequency, paper_equivalent_mass

SOURCE = (
    "On the liquid added mass under the oscillations of the elastic rod floating on the aquatorium surface, "
    "Bauman Moscow State Technical University, 2018 (in Russian)"
)


@dataclass(frozen=True, kw_only=True)
class Erratum:
    """One slip or gap of the printed paper.

    Attributes:
        number: its number in the list of errata in the docs.
        printed: what the paper prints or omits.
        corrected: what it should be.
        consequence: what goes wrong otherwise.
    """

    number: int
    printed: str
    corrected: str
    consequence: str


@dataclass(frozen=True, kw_only=True)
class PrintedAndCorrected:
    """One quantity by the printed and by the corrected formula, in the same units."""

    printed: float
    corrected: float


def free_end_determinant(argument: float) -> PrintedAndCorrected:
    """Return (d₁₁ d₂₂ − d₁₂ d₂₁)/(β⁵ cosh b), whose roots must be those of the free-free beam (erratum 4).

    Printed d₂₁ = β³(sinh b − sin b); corrected d₂₁ = β³(sinh b + sin b), which gives 2β⁵(1 − cosh b cos b).

    Args:
        argument: b = β l.

    Returns:
        Both values, dimensionless; finite for any b.
    """
    hyperbolic = 2 * math.exp(-abs(argument)) / (1 + math.exp(-2 * abs(argument)))
    cosine, sine = math.cos(argument), math.sin(argument)
    return PrintedAndCorrected(
        printed=2 * cosine**2 * hyperbolic - 2 * cosine + 2 * math.tanh(argument) * sine,
        corrected=2 * (hyperbolic - cosine),
    )


def one_term_stiffness(beam: FloatingBeam) -> PrintedAndCorrected:
    """Return c₁₁ of the one-term equation c₁₁ = ω² a₁₁, with n = 1 and the tip on the wall (erratum 5).

    Printed: k tanh(kH) [cos(2kl)/2 + l/2 + (L − l)/2 + (sin 2kL − sin 2kl)/4], which adds a number to metres.
    Corrected: k tanh(kH) L/2, since the cosines are orthogonal on the whole surface.

    Args:
        beam: the problem; its ``start`` is not used, as in the printed formula.

    Returns:
        Both values; the printed one changes with the unit of length.
    """
    k = math.pi / beam.tank_length
    factor = k * math.tanh(k * beam.depth)
    length = beam.length
    bracket = (
        math.cos(2 * k * length) / 2
        + length / 2
        + (beam.tank_length - length) / 2
        + (math.sin(2 * k * beam.tank_length) - math.sin(2 * k * length)) / 4
    )
    return PrintedAndCorrected(printed=factor * bracket, corrected=factor * beam.tank_length / 2)


def one_term_lid_added_mass(beam: FloatingBeam, number: int = 1) -> PrintedAndCorrected:
    """Return the added mass of dry mode 1 from one cosine under a rigid lid, m_a = ρ c_n²/(l T_nn) (erratum 2).

    With y upward and ψ_y = w the load on the beam is +ρ ω² ψ. The printed minus turns the added mass negative.

    Args:
        beam: the problem.
        number: n of the cosine.

    Returns:
        Both values, kg/m².
    """
    k = number * math.pi / beam.tank_length
    moment = float(cosine_moments(beam, 2, np.array([k]))[0])
    own = k * math.tanh(k * beam.depth) * beam.tank_length / 2
    added_mass = beam.density * moment**2 / (beam.length * own)
    return PrintedAndCorrected(printed=-added_mass, corrected=added_mass)


def added_mass(beam: FloatingBeam, omega: float) -> PrintedAndCorrected:
    """Return the added mass that a wet frequency implies (erratum 9).

    Printed: μ* − μ₀ with μ* = μ₀ ω₀²/ω². Corrected: (EI κ⁴ + s ρ g)/ω² − m. They agree without hydrostatics.

    Args:
        beam: the problem.
        omega: frequency of the wet tone, rad/s.

    Returns:
        Both values, kg/m².

    Raises:
        ValueError: if ω is not positive.
    """
    return PrintedAndCorrected(
        printed=paper_equivalent_mass(beam, omega) - beam.mass_per_length,
        corrected=added_mass_from_frequency(beam, omega),
    )


ERRATA: tuple[Erratum, ...] = (
    Erratum(
        number=1,
        printed="Eq. (3) and its particular solution: the load lacks the factor 1/EJ",
        corrected="W'''' − β⁴ W = ρ ω² ψ/EJ",
        consequence="The dimensions do not agree.",
    ),
    Erratum(
        number=2,
        printed="load −ρ ω² ψ, pressure p = +ρ Φ_t, with y upward and ψ_y = +W",
        corrected="load +ρ ω² ψ, pressure p = −ρ Φ_t",
        consequence="Taken literally the added mass is negative.",
    ),
    Erratum(
        number=3,
        printed="∂Φ/∂y = w",
        corrected="∂Φ/∂y = ∂w/∂t, or use the displacement potential",
        consequence="A velocity equals a displacement.",
    ),
    Erratum(
        number=4,
        printed="d₂₁ = β³ (sh βl − sin βl)",
        corrected="d₂₁ = β³ (sh βl + sin βl)",
        consequence="The determinant loses the roots of the free-free beam, 2β⁵(1 − ch cos).",
    ),
    Erratum(
        number=5,
        printed="c₁₁ = λ₁ th λ₁H [cos 2λ₁l/2 + l/2 + (L−l)/2 + (sin 2λ₁L − sin 2λ₁l)/4]",
        corrected="c₁₁ = λ₁ th(λ₁H) L/2",
        consequence="A number is added to lengths: the result depends on the unit of length.",
    ),
    Erratum(
        number=6,
        printed="the sum starts at i = 1",
        corrected="keep i = 0: the pressure constant and the balance of volume",
        consequence="Modes with heave are wrong, the lowest symmetric one is lost, and the limit N → ∞ is wrong.",
    ),
    Erratum(
        number=7,
        printed="one term, i = 1, for any position of the beam",
        corrected="a cosine that couples with the first dry mode",
        consequence="For a centred beam cos(πx/L) is antisymmetric and the first elastic tone symmetric: the value "
        "found is a pitch or sloshing number.",
    ),
    Erratum(
        number=8,
        printed="one cosine also above its own sloshing frequency",
        corrected="enough cosines for ψ ≈ 0 on the water",
        consequence="The single cosine answers in antiphase and the wet root can lie above the dry frequency.",
    ),
    Erratum(
        number=9,
        printed="μ* = μ₀ ω₀²/ω₁²",
        corrected="m_a = (EI κ⁴ + s ρ g)/ω² − m",
        consequence="With hydrostatics μ* can fall below μ₀, and for m → 0 it is 0·∞.",
    ),
    Erratum(
        number=10,
        printed="no hydrostatic restoring on the beam",
        corrected="add ρ g w unless EI/(ρ g l⁴) ≫ 1/500",
        consequence="Wrong for ice floes and very large floating structures.",
    ),
)
