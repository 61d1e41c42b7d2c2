"""The force of vortices that a thread sheds, across the stream and the thread.

    f = c |u_n|² b sin(2π n ∫ |u_n| dt + ψ),    b = τ × u_n/|u_n|,    c = ρ d C_L/2,    n = St/d,

with the relative velocity u_n across the thread and a phase at each point of its own.
"""

from __future__ import annotations

from math import pi
from typing import Any

import basix.ufl
import ufl
from dolfinx import fem

from hydroelastic.fem.kernels import compiled_expression
from hydroelastic.fem.thread.forms import ThreadForms, tangent
from hydroelastic.physics.thread_motion import VortexShedding


class SheddingLoad:
    """The vortex force at the middle of a step, with the path lengths ∫|u_n| dt at all quadrature points.

    Args:
        shedding: in the units of the forms.
    """

    def __init__(self, forms: ThreadForms, shedding: VortexShedding) -> None:
        mesh, degree = forms.space.mesh, forms.space.quadrature_degree
        self._forms, self._shedding = forms, shedding
        element = basix.ufl.quadrature_element("interval", degree=degree)
        self._way = fem.Function(fem.functionspace(mesh, element))
        self._half_step = fem.Constant(mesh, 0.0)
        self._points = element.custom_quadrature()[0]
        self._next: Any = None

    def _across(self, position: Any, velocity: Any) -> Any:
        tau = tangent(position)
        stream = self._forms.stream
        relative = -velocity if stream is None else stream.along(position) - velocity
        return relative - ufl.inner(relative, tau) * tau

    def __call__(self, position: Any, velocity: Any) -> Any:
        """The force per length, as an expression of position and velocity in the middle of the step."""
        across = self._across(position, velocity)
        speed = ufl.sqrt(ufl.inner(across, across) + 1e-16)
        turns = self._forms.constant(self._shedding.wave_number) * (self._way + self._half_step * speed)
        after = self._way + 2.0 * self._half_step * speed
        self._next = compiled_expression(after, self._points)
        size = self._forms.constant(self._shedding.lift) * speed
        size *= ufl.sin(2.0 * pi * turns + self._forms.constant(self._shedding.phase))
        return size * ufl.cross(tangent(position), across)

    def set_step(self, step: float) -> None:
        """Set the length of the step."""
        self._half_step.value = 0.5 * step

    def advance(self) -> None:
        """Advance to the end of the step."""
        self._way.interpolate(self._next)
