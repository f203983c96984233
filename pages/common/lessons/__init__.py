"""Lessons: an example, a question, a prediction, a move, and the numbers. Files in data/, read by read.py."""
