"""What a design does beyond its nominal loop: sweeps, plant families, actuators, advice."""
