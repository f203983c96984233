"""Radau collocation on one element, and responses as pieces of it."""
