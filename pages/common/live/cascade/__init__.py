"""The live instrument of the cascade page."""
