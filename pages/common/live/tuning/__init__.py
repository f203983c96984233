"""The live instrument of the tuning page."""
