"""Tanks on meshes of their volume."""
