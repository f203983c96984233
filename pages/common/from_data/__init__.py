"""The page From data: from a file or a paste to a model one can trust, and on to its tuning."""
