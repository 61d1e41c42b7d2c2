"""Running a scene of a tank of revolution."""
