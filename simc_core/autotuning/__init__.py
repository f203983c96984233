"""Auto-tuning: from what a trend shows to settings with their price."""
