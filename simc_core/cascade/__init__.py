"""Design of two nested loops, and the published pairs."""
