"""Closed tanks: from a domain to a Dataset."""
