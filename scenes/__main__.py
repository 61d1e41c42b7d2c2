"""``python -m hydroelastic.scenes`` and the command ``hydroelastic``: sets the handling of Ctrl-C before all else."""

import gc
import os

from hydroelastic.meshes.interrupts import end_on_interrupt


def start() -> None:
    """Run the command line in a process of its own."""
    end_on_interrupt()
    # Its handlers would turn the end of `| head` into a report of a crash.
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} -no_signal_handler".lstrip()
    from hydroelastic.scenes.command_line import main

    try:
        main()
    finally:
        # The process ends: searching all that was imported for cycles would take longer than solving a scene.
        gc.freeze()


if __name__ == "__main__":
    start()
