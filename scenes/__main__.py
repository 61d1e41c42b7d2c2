"""``python -m hydroelastic.scenes`` and the command ``hydroelastic``: sets the handling of Ctrl-C before all else."""

import os
import sys
import traceback

from hydroelastic.meshes.interrupts import end_on_interrupt


def start() -> None:
    """Run the command line in a process of its own."""
    end_on_interrupt()
    # Else it reads the metadata of every installed package.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    # It would make a folder for preferences in the home folder.
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    os.environ.setdefault("MPLCONFIGDIR", os.path.join(cache, "matplotlib"))
    # Its handlers would turn the end of `| head` into a report of a crash.
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} -no_signal_handler".lstrip()
    from hydroelastic.scenes.command_line import main

    try:
        main()
    except Exception:
        _end_other_processes()
        raise


def _end_other_processes() -> None:
    """End all processes of MPI after an error of one: the others would wait for it without end."""
    # Who did not use MPI does not begin now.
    mpi = sys.modules.get("mpi4py.MPI")
    if mpi is not None and mpi.COMM_WORLD.size > 1:
        traceback.print_exc(file=sys.__stderr__)
        place = f"process {mpi.COMM_WORLD.rank} of {mpi.COMM_WORLD.size}"
        print(f"Error: {place} has failed, see above; all processes end.", file=sys.__stderr__, flush=True)
        mpi.COMM_WORLD.Abort(1)


if __name__ == "__main__":
    start()
