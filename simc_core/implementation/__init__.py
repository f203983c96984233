"""From the design to the box: what is typed, sampled or compiled, and what it does to the loop."""
