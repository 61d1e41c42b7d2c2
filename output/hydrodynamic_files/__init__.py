"""Files of other programs with the hydrodynamics of whole rigid bodies: WAMIT, BEMIO of WEC-Sim, Nemoh, Capytaine."""
