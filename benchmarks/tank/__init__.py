"""A beam in a tank, beside NGSolve, scikit-fem and a lower bound."""
