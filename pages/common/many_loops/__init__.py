"""The page of many loops: a list in, settings and a report out."""
