"""The physical vocabulary: liquids, tanks, beams, floats, strings, threads, streams, ships and waves, in SI units."""
