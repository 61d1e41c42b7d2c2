"""Tanks between walls, and what floats in them: mesh, modes, errors, and the limit of infinite frequency."""
