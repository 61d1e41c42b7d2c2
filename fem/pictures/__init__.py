"""Pictures of fields and lines, rendered without a screen."""
