"""Pictures: fields rendered by VTK without a screen, curves, lines in space and all frames by matplotlib."""
