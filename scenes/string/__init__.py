"""Hanging strings."""
