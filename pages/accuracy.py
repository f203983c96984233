"""Placeholder."""

from pages.common import header

header.show("accuracy")
