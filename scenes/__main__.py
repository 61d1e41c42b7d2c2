"""``python -m hydroelastic.scenes`` and the command ``hydroelastic``: sets the handling of Ctrl-C before all else."""

from hydroelastic.meshes.interrupts import end_on_interrupt


def start() -> None:
    """Run the command line in a process of its own."""
    end_on_interrupt()
    from hydroelastic.scenes.command_line import main

    main()


if __name__ == "__main__":
    start()
