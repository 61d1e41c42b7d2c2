"""Dry modes of thin plates: closed polynomials in rectangles, discs and rings."""
