"""The home page: a field for my plant, and examples."""
