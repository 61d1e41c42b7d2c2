"""Hanging strings in series."""
