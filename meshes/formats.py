"""Mesh file formats that can be read and written, by suffix; apart, so that a scene is validated without meshio."""

FORMATS = (".msh", ".vtu", ".xdmf")
