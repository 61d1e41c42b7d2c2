"""The weak forms of a liquid between walls, bodies and surfaces: all UFL of tanks.

    Δψ = 0 in the liquid,    ∂ψ/∂n = 0 on walls,    ∂ψ/∂n = ζ on what moves,    ψ = 0 where the pressure is released

Tested with q, with the normal displacement ζ of surfaces and bodies as load,

    ∫ (∇ψ·∇q + m² ψ q) w dx = ∫ ζ q w ds

ψ is the potential of displacements, with the time factor e^{−iωt}. In a section w = 1 and m = 0; in the half-plane of a
solid of revolution w = r and m = n/r for ψ cos nθ; in a section that is extruded between two walls w = 1 and m = k for
ψ cos kz. A surface's elevation η is itself a trial function, and so is the displacement v of a body, of a degree that
follows its shapes: one form serves all shapes of all bodies, v·n is exact for rigid motions.

Each form is compiled once for all meshes of a kind of cell, a degree of its geometry and degrees of its functions.
"""

from __future__ import annotations

from functools import cache
from typing import Literal, NamedTuple

import basix.ufl
import ufl
from dolfinx import fem
from mpi4py import MPI

from hydroelastic.fem.kernel_cache import kernels_locked
from hydroelastic.fem.kernels import jit_options
from hydroelastic.meshes.compat import compiled_form

Kind = Literal["plane", "revolved", "extruded"]
MARKED = 1
"""Number of the facets over which `surface` and `normal_load` are integrated."""
SMOOTHER = 4
"""Degrees of the bodies' displacement beyond that of ψ."""


def laplace(psi, q, weight, transverse):  # type: ignore[no-untyped-def]
    """∫ (∇ψ·∇q + m² ψ q) w dx with m²w = transverse."""
    return weight * ufl.inner(ufl.grad(psi), ufl.grad(q)) + transverse * psi * q


def surface(eta, q, weight):  # type: ignore[no-untyped-def]
    """∫ η q w ds."""
    return weight * eta * q


def normal_load(v, q, weight, normal):  # type: ignore[no-untyped-def]
    """∫ v·n q w ds, n outwards from the liquid."""
    return weight * ufl.dot(v, normal) * q


class CompiledForms(NamedTuple):
    """Forms on any mesh of one kind, and elements of ψ and of bodies' shapes; `transverse` is the constant n² or k², or
    ``None``."""

    element: basix.ufl._ElementBase
    shapes: basix.ufl._ElementBase
    laplace: fem.forms.CompiledForm
    surface: fem.forms.CompiledForm
    normal_load: fem.forms.CompiledForm
    transverse: ufl.Constant | None


@cache
def compiled_forms(kind: Kind, cell: str, dim: int, geometry_degree: int, degree: int) -> CompiledForms:
    """Compile the forms for ψ of a degree (collective)."""
    domain = ufl.Mesh(basix.ufl.element("Lagrange", cell, geometry_degree, shape=(dim,)))
    element = basix.ufl.element("Lagrange", cell, degree)
    shapes = basix.ufl.element("Lagrange", cell, degree + SMOOTHER, shape=(dim,))
    space, of_bodies = ufl.FunctionSpace(domain, element), ufl.FunctionSpace(domain, shapes)
    psi, q, v = ufl.TrialFunction(space), ufl.TestFunction(space), ufl.TrialFunction(of_bodies)
    x, n = ufl.SpatialCoordinate(domain), ufl.FacetNormal(domain)
    weight = x[0] if kind == "revolved" else 1.0
    transverse = None if kind == "plane" else ufl.Constant(domain)
    squared = 0.0 if transverse is None else transverse / x[0] if kind == "revolved" else transverse
    more = 0 if geometry_degree == 1 else geometry_degree
    dx = ufl.dx(domain, metadata={"quadrature_degree": 2 * degree + more})
    ds = ufl.Measure("ds", domain)(MARKED)
    of_surface = ds(metadata={"quadrature_degree": 2 * degree + more})
    of_shapes = ds(metadata={"quadrature_degree": 2 * degree + SMOOTHER + more})
    options = jit_options()

    def compiled(form: ufl.Form) -> fem.forms.CompiledForm:
        return compiled_form(MPI.COMM_WORLD, form, options)

    with kernels_locked(MPI.COMM_WORLD):
        return CompiledForms(
            element=element,
            shapes=shapes,
            laplace=compiled(laplace(psi, q, weight, squared) * dx),
            surface=compiled(surface(psi, q, weight) * of_surface),
            normal_load=compiled(normal_load(v, q, weight, n) * of_shapes),
            transverse=transverse,
        )
