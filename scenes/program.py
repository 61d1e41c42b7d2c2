"""The command name of the program, for usage, help and hints."""

import os

PROGRAM = os.environ.get("HYDROELASTIC_PROGRAM", "hydroelastic")
"""The launcher gives the name that it was started by."""
