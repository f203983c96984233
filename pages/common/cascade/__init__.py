"""The cascade page: its diagram, widgets, figures, guards and views."""
