"""Bodies of the field model: beams in their dry modes, rigid floats in their motions."""
