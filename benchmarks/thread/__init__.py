"""Flexible threads, beside MoorPy and MoorDyn."""
