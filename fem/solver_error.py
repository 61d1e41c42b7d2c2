"""The error of problems that their matrices do not let solve; it is caught where a scene is run."""


class EigenSolverError(RuntimeError):
    """The eigen-solver did not converge, or a matrix of it cannot be factorized."""
