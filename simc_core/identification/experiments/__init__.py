"""Experiments other than a step of OP: relay, set-point step under P control, a running loop that oscillates."""
