"""Errors of problems that their matrices, or memory, do not let solve; they are caught where a scene is run."""

from hydroelastic.meshes.tagged_mesh import MeshError


class EigenSolverError(RuntimeError):
    """The eigen-solver did not converge, or a matrix of it cannot be factorized."""


class TooLargeError(MeshError):
    """The problem would not fit into memory."""
