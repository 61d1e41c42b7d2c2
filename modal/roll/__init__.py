"""Rolling on trains of waves, in closed form."""
