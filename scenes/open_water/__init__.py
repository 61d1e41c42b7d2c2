"""Bodies in open water: radiation, response, resonances, decay."""
