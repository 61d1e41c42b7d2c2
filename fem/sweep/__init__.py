"""Modes followed along a parameter: which mode of one solution continues which of the next."""
