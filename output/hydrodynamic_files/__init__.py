"""Files of other programs with the hydrodynamics of whole bodies: WAMIT, BEMIO of WEC-Sim, Nemoh, Capytaine."""
