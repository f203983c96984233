"""All boxes by key. What was read in no maker's text says so: Box.verified, Box.unread. ABB 800xA and Freelance are not
here: no text of theirs was found.
"""

from collections.abc import Mapping
from types import MappingProxyType

from simc_core.implementation.boxes import (
    abb_schneider,
    emerson,
    honeywell,
    libraries,
    panel,
    rockwell,
    siemens,
    yokogawa_foxboro,
)
from simc_core.implementation.boxes.box import Box

MAKERS = (rockwell, siemens, emerson, honeywell, yokogawa_foxboro, abb_schneider, panel, libraries)
BOXES: Mapping[str, Box] = MappingProxyType({box.key: box for maker in MAKERS for box in maker.BOXES})
