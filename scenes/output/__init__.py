"""What all kinds of scenes share of their results: tables, folders, curves, provenance."""
