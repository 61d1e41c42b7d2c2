"""Ships that roll on a swell: their quantities."""
