"""``python -m hydroelastic.scenes`` and the command ``hydroelastic``: sets the handling of Ctrl-C before all else."""

import gc
import os
import sys
import traceback

from hydroelastic.meshes.interrupts import end_on_interrupt

# New objects after which Python searches for cycles. Imports, a small scene and its pictures make some 230 000, hardly
# any in cycles; with Python's own number, 2 000, the searches take a tenth of its run.
_BEFORE_FIRST_SEARCH = 300_000
_BETWEEN_SEARCHES = 50_000
# Commands that need MPI, which takes the longest of all libraries to load.
_SOLVING = {"run", "compare", "study", "sweep"}


def start() -> None:
    """Run the command line in a process of its own."""
    end_on_interrupt()
    gc.set_threshold(_BEFORE_FIRST_SEARCH)
    gc.callbacks.append(lambda _phase, _found: gc.set_threshold(_BETWEEN_SEARCHES))
    # Else it reads the metadata of every installed package.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    # It would make a folder for preferences in the home folder.
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    os.environ.setdefault("MPLCONFIGDIR", os.path.join(cache, "matplotlib"))
    # Its handlers would turn the end of `| head` into a report of a crash.
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} -no_signal_handler".lstrip()
    if _SOLVING.intersection(sys.argv[1:2]) and not {"-h", "--help"}.intersection(sys.argv):
        # Libraries are loaded one at a time: first the small ones of these modules, which would wait for MPI.
        import hydroelastic.output.folder
        import hydroelastic.scenes.errors  # noqa: F401
        from hydroelastic.scenes.early_libraries import DOLFINX, MPI, load_early

        load_early(MPI, DOLFINX)
    from hydroelastic.scenes.command_line import main

    try:
        main()
    except Exception:
        _end_other_processes()
        raise
    finally:
        # The process ends: searching all that was imported for cycles would take longer than solving a scene.
        gc.freeze()


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
