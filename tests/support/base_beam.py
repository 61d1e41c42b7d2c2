"""The beam of the case base_s0, for tests of the estimates, which need no dolfinx."""

from hydroelastic.modal.beam.floating_beam import FloatingBeam

BASE = FloatingBeam(
    tank_length=10.0,
    depth=5.0,
    density=1000.0,
    gravity=9.81,
    start=3.0,
    length=4.0,
    flexural_rigidity=5e3,
    mass_per_length=50.0,
    hydrostatic=False,
)
