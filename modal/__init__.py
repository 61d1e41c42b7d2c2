"""Closed forms and estimates of the older theories: NumPy and SciPy only."""
