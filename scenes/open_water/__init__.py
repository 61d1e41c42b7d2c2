"""Scenes with open ends: checks, summary, tables, files and pictures."""
