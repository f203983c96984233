"""What the program does, the way through it, and plants to begin with."""

from pages.common import header

header.show("home")
