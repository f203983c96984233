"""What stands between controller and plant: limits, anti-windup, noise, sampling."""
