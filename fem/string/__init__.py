"""The field solution of a hanging string."""
