"""Factored transfer functions, polynomials and realisations: what all the rest is computed with."""
