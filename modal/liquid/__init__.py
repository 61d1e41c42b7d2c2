"""Waves of one liquid and of two, without bodies."""
