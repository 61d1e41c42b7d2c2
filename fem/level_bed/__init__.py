"""Upright tanks with level beds, without a mesh of the volume: one problem on a line for each order."""
