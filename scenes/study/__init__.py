"""Error against cost, measured."""
