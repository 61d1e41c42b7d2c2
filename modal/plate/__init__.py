"""Plates: dry modes, closed forms and estimates."""
