"""The field solution of a flexible thread."""
