"""Placeholder."""

from pages.common import header

header.show("half_rule")
