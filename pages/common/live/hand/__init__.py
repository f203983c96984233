"""The live instrument of settings and plants that are dragged by hand."""
