"""Sweeps: one scene solved for many values of its keys, its results along them, its modes followed from point to
point."""
