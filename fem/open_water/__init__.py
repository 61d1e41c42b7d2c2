"""Open water: radiation, response to waves, resonances, motion after a release."""
