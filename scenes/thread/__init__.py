"""Flexible threads in a stream."""
