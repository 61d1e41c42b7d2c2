"""Ships that roll on a swell."""
