"""A hanging string, as series and as a field."""
