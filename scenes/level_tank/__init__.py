"""Scenes of tanks in three dimensions: solution, tables, files and pictures."""
