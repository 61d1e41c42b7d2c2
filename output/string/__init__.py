"""Hanging strings: their quantities."""
