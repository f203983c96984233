"""IAE, ISE, ITAE, TV, overshoot, peak, rise and settling of unit steps over an infinite horizon."""
