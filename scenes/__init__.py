"""Typed scenes, pipelines and the command line."""
