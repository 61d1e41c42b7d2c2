"""Rigid floats: thin floats, closed boxes, channels, sections."""
