"""Geometry, gmsh, tagged and graded meshes."""
