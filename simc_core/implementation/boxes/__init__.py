"""Controllers that one can buy or download: their laws, units and ranges."""
