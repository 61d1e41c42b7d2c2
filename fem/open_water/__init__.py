"""Waves that leave: complex scaling, resonances, the far field."""
