"""A tank in three dimensions with an elastic plate, beside NGSolve in the volume and on the plan."""
