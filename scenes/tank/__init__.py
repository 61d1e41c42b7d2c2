"""Closed tanks: beams and floats, their modes and estimates."""
