"""Results of tanks in three dimensions."""
