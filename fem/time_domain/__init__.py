"""Motions of bodies in waves over time, from matrices and transfer functions of any solver of the frequency domain."""
