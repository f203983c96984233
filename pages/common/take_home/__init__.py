"""The page that takes settings home: into a box, with proof, and back."""
