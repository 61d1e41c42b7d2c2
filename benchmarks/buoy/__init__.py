"""Heaving solids of revolution in the open sea, beside Capytaine and OpenFLASH."""
