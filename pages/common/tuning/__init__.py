"""The tuning page: its widgets, figures, guards and views."""
