"""Closed forms, dry modes and the estimates of the older theories, on NumPy and SciPy alone."""
