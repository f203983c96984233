"""A loop with one dead time, stepped over elements that grow: all tunings of a plant together."""
