"""What the page of sources tells of each publication."""

from simc_core.published.sources import SOURCES
from simc_core.published.uses import MISPRINTS, USES


def test_every_publication_has_a_word_on_its_use_and_no_other():
    assert set(USES) == set(SOURCES)
    assert set(MISPRINTS) <= set(SOURCES)
