"""Weak forms, the coupled pencil and its analyses on dolfinx."""
