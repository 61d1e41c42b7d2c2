"""Pictures: fields on triangles as pixels; curves, lines in space, frames by matplotlib; surfaces in space by VTK."""
