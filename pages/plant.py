"""Enter a plant and see what it is."""

from pages.common import header

header.show("plant")
