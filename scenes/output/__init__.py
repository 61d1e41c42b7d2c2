"""Output that all kinds of scenes share: tables, folders, curves, provenance."""
