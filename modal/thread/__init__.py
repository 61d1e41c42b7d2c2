"""Threads in closed and asymptotic form."""
