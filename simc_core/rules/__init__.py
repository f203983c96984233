"""Tuning rules: one pure function a rule, beside its source."""
