"""Flexible threads: their quantities."""
