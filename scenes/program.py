"""What the environment tells of this program: its name, for usage, help and hints, and which process of MPI it is."""

import os

PROGRAM = os.environ.get("HYDROELASTIC_PROGRAM", "hydroelastic")
"""The launcher gives the name that it was started by."""

RANK_VARIABLES = ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK")
"""Where MPI launchers say which process this is; without one there is only one process."""
