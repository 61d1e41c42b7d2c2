"""Closed tanks: their quantities."""
