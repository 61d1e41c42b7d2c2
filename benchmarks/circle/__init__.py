"""A circle in open water, beside Capytaine."""
