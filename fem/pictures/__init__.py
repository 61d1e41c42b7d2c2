"""Motions as they are drawn and written: sampled fields, surfaces and floats, as plain values."""
