"""What the Accuracy page shows: every row must hold."""

import pytest

from simc_core.references import REFERENCES


@pytest.mark.parametrize("reference", REFERENCES, ids=lambda each: f"{each.what}, {each.quantity}")
def test_each_reference_is_met(reference):
    assert abs(reference.compute() - reference.expected) <= reference.tolerance
