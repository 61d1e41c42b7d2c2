"""How fine the scripts of the peers make their models: rules that were found by search on the tanks of the benchmark.

Elements near one wavelength, degrees to 14: the fewest seconds for a given error lie within a tenth or two of these
rules, for each tank, from errors of 1e-3 to 1e-10.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log10

from hydroelastic.benchmarks.tank.cases import BenchmarkTank

RING_RATIO = 0.15
"""Of the sizes of successive rings; from 0.1 to 0.2 the same errors cost the same within a tenth."""


@dataclass(frozen=True, kw_only=True)
class PeerRule:
    """What a script makes of the wavelengths of the highest mode.

    Attributes:
        waves_on_water: largest element at the water in wavelengths there.
        waves_under_beam: largest element under the beam in wavelengths there.
        degrees_per_ring: how many degrees are worth a layer of elements around each end of the beam.
    """

    waves_on_water: float
    waves_under_beam: float
    degrees_per_ring: int


@dataclass(frozen=True, kw_only=True)
class PeerResolution:
    """Sizes for one tank and degree.

    Attributes:
        degree: of ψ.
        water_size: largest element at the water, m.
        beam_size: largest element under the beam, m.
        rings: layers of elements around each end of the beam.
        shapes: number of dry modes.
    """

    degree: int
    water_size: float
    beam_size: float
    rings: int
    shapes: int


def peer_resolution(tank: BenchmarkTank, degree: int, rule: PeerRule) -> PeerResolution:
    """The resolution of a tank for a degree: the error that the degree leaves elsewhere decides rings and dry modes."""
    beam = tank.beam
    gap = min(gap for gap in (beam.left_gap, beam.right_gap) if gap > 0.0)
    return PeerResolution(
        degree=degree,
        water_size=rule.waves_on_water * tank.water_wavelength,
        beam_size=rule.waves_under_beam * tank.beam_wavelength,
        rings=max(2, degree // rule.degrees_per_ring),
        # The narrower a gap, the more the beam bends near its end.
        shapes=ceil((24.0 + 30.0 * log10(beam.length / gap)) * 1.15 ** (degree - 10)),
    )
