"""Nested loops, each block with its own dead time, stepped over a mesh that has every breakpoint."""
