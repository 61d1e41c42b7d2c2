"""The core: weak forms, liquid, bodies, pencil, modes, estimates, and the one loop that refines."""
