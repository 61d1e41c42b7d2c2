"""Uniform refinement of a distributed mesh of tetrahedra, on all processes at once, that keeps to its surfaces.

A coarse mesh of gmsh, which one process can hold, is distributed; each process divides each of its cells into eight and
moves the new nodes on curved surfaces to them. The whole mesh stands on no process. Curved meshes get nodes in the
middle of edges, the second degree: its error of the volume falls like the fourth power of the size.
"""

from __future__ import annotations

from dataclasses import replace

import basix.ufl
import numpy as np
import ufl
from dolfinx import cpp, fem
from dolfinx.mesh import Mesh, RefinementOption, meshtags, refine, transfer_meshtag

from hydroelastic.meshes.compat import geometry_dofmap
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.surfaces import Surface, moved_to
from hydroelastic.physics.arrays import FloatArray

APART = "@"
"""Between the name of a facet's group, "" of a wall, and the number of its surface."""

_CURVED_DEGREE = 2


def refined_mesh(coarse: TankMesh, surfaces: dict[tuple[str, ...], Surface], times: int, *, curved: bool) -> TankMesh:
    """Divide each cell into eight, several times (collective)."""
    mesh, facet_tags, cell_tags = coarse.mesh, coarse.facet_tags, coarse.cell_tags
    groups = list(coarse.facet_names.items())
    places_of = {name: place for place, (name, _) in enumerate(groups)}

    def snapped(space: fem.FunctionSpace) -> FloatArray:
        """The nodes of a space, at the surfaces that they lie on."""
        points: FloatArray = space.tabulate_dof_coordinates()
        in_group = np.zeros((len(points), len(groups)), dtype=bool)
        for place, (_, tag) in enumerate(groups):
            # remote=True: a process may have a node of a surface none of whose facets it holds.
            in_group[fem.locate_dofs_topological(space, 2, facet_tags.find(tag), remote=True), place] = True
        lies_on = [in_group[:, [places_of[name] for name in names]].all(axis=1) for names in surfaces]
        return moved_to(list(surfaces.values()), points, np.column_stack(lies_on))

    for _ in range(times):
        mesh.topology.create_entities(1)
        fine, parents, places = refine(mesh, partitioner=None, option=RefinementOption.parent_cell_and_facet)
        for dim in (1, 2):
            fine.topology.create_entities(dim)
        fine.topology.create_connectivity(2, 3)
        fine.topology.create_connectivity(3, 2)
        facet_tags = transfer_meshtag(facet_tags, fine, parents, places)
        cell_tags = transfer_meshtag(cell_tags, fine, parents)
        mesh = fine
        if curved:
            corners = fem.functionspace(mesh, ("Lagrange", 1))
            mesh.geometry.x[geometry_dofmap(mesh).ravel()] = snapped(corners)[corners.dofmap.list.ravel()]
    if curved:
        nodes = fem.functionspace(mesh, ("Lagrange", _CURVED_DEGREE))
        mesh = _with_nodes(mesh, nodes, snapped(nodes))
    mesh.topology.create_connectivity(2, 0)
    names = dict.fromkeys(name.split(APART)[0] for name, _ in groups)
    names.pop("", None)
    numbers = {name: number for number, name in enumerate(names, 1)}
    renamed = np.zeros(max(tag for _, tag in groups) + 1, dtype=np.int32)
    for name, tag in groups:
        renamed[tag] = numbers.get(name.split(APART)[0], 0)
    values = renamed[facet_tags.values]
    return replace(
        coarse,
        mesh=mesh,
        facet_tags=meshtags(mesh, 2, facet_tags.indices[values > 0], values[values > 0]),
        facet_names=numbers,
        cell_tags=meshtags(mesh, 3, cell_tags.indices, cell_tags.values),
    )


def _with_nodes(mesh: Mesh, space: fem.FunctionSpace, points: FloatArray) -> Mesh:
    cell, dofmap = mesh.topology.cell_name(), space.dofmap
    element = basix.ufl.element("Lagrange", cell, _CURVED_DEGREE)
    geometry = cpp.mesh.Geometry_float64(
        dofmap.index_map,
        dofmap.list,
        fem.coordinate_element(element.basix_element)._cpp_object,
        points,
        dofmap.index_map.local_to_global(np.arange(len(points), dtype=np.int32)),
    )
    vector = basix.ufl.element("Lagrange", cell, _CURVED_DEGREE, shape=(3,))
    return Mesh(cpp.mesh.Mesh_float64(mesh.comm, mesh.topology._cpp_object, geometry), ufl.Mesh(vector))
