"""Tanks with a level bed on their plan: tensor products in boxes, triangles and poles in any plan."""
