"""Mesh file formats that can be read and written, by suffix; separate, so that a scene is validated without meshio."""

FORMATS = {
    ".msh": "a mesh of gmsh, format 2.2 or 4.1, as gmsh writes it",
    ".vtu": "an unstructured grid of VTK, as ParaView and meshio write it",
    ".xdmf": "a uniform grid of XDMF 3, with its .h5 file beside it if it names one",
}
