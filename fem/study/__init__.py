"""Error against cost of the frequencies of a closed tank, measured."""
