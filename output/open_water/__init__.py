"""Open water: its quantities, each declared once."""
