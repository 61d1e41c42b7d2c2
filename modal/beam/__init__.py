"""Floating beams: dry modes, Rayleigh, Grammel, strip theory."""
