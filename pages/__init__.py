"""The pages: one thin script each; what they share lies in common."""
