"""Pictures: fields rendered by pyvista without a screen, curves, lines in space and all frames by matplotlib."""
