"""The stream at the thread: velocities and gradients at quadrature points and nodes, updated as the thread moves.

A form sees u(r) as u_k + G_k (r − r_k) about the positions r_k of the last `update`: its value there and its derivative
are exact for every profile, and one compiled form serves them all.
"""

from __future__ import annotations

from typing import Any

import basix.ufl
import numpy as np
import ufl
from dolfinx import fem
from numpy.typing import NDArray

from hydroelastic.fem.kernels import compiled_expression
from hydroelastic.physics.stream import Stream


class _Places:
    """u and ∂u/∂r at the points of one kind of function space."""

    def __init__(self, mesh: Any, element: Any, shape: tuple[int, ...], points: NDArray[np.float64]) -> None:
        dimension = shape[0]
        self.position = fem.Function(fem.functionspace(mesh, element(shape)))
        self.velocity = fem.Function(self.position.function_space)
        self.gradient = fem.Function(fem.functionspace(mesh, element((dimension, dimension))))
        self._points = points
        # The last position and its expression: creating an expression takes longer than evaluating it.
        self._expression: tuple[Any, Any] = (None, None)

    def update(self, position: Any, stream: Stream) -> None:
        if self._expression[0] is not position:
            self._expression = position, compiled_expression(position, self._points)
        self.position.interpolate(self._expression[1])
        dimension = self.position.function_space.dofmap.bs
        places = self.position.x.array.reshape(-1, dimension)
        points = np.zeros((len(places), 3))
        axes = [0, 2] if dimension == 2 else [0, 1, 2]
        points[:, axes] = places
        self.velocity.x.array[:] = stream.velocity_at(points)[:, axes].ravel()
        self.gradient.x.array[:] = stream.gradient_at(points)[:, axes][:, :, axes].ravel()

    def at(self, position: Any) -> Any:
        return self.velocity + ufl.dot(self.gradient, position - self.position)


class StreamField:
    """The stream about the thread's last position.

    Args:
        mesh: intervals in s.
        stream: u(r).
        quadrature_degree: of the forms that will use it.
    """

    def __init__(self, mesh: Any, dimension: int, stream: Stream, quadrature_degree: int) -> None:
        self.stream = stream
        rule, _ = basix.make_quadrature(basix.CellType.interval, quadrature_degree)

        def quadrature(shape: tuple[int, ...]) -> Any:
            return basix.ufl.quadrature_element("interval", value_shape=shape, degree=quadrature_degree)

        def linear(shape: tuple[int, ...]) -> Any:
            return basix.ufl.element("Lagrange", "interval", 1, shape=shape)

        self._cells = _Places(mesh, quadrature, (dimension,), rule)
        self._nodes = _Places(mesh, linear, (dimension,), np.array([[0.0], [1.0]]))

    def update(self, position: Any) -> None:
        """Evaluate the stream at the position of the thread."""
        self._cells.update(position, self.stream)
        self._nodes.update(position, self.stream)

    def along(self, position: Any) -> Any:
        """u for integrals over elements, linear about the last update."""
        return self._cells.at(position)

    def at_nodes(self, position: Any) -> Any:
        """u for terms at nodes, linear about the last update."""
        return self._nodes.at(position)
