"""Is the loop stable? Closed-loop poles counted by the argument principle, certified, with exact dead time."""
