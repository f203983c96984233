"""Searches for the best or the fastest controller under a limit."""
