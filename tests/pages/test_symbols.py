"""Plain messages of the core as a page shows them."""

import pytest

from pages.common.parts.symbols import sentence, symbols


@pytest.mark.parametrize(
    ("plain", "shown"),
    [
        ("tau1 must be > 0, found -0.17", "τ₁ must be > 0, found −0.17"),
        ("k >= -.5", "k ≥ −.5"),
        ("[SK98] eq. 23-24, 1e-05, 10^-1, second-order", "[SK98] eq. 23-24, 1e-05, 10^-1, second-order"),
    ],
)
def test_only_the_sign_of_a_number_becomes_a_minus_sign(plain, shown):
    assert symbols(plain) == shown


@pytest.mark.parametrize(
    ("plain", "shown"),
    [("integrators must be <= 2", "Integrators must be ≤ 2"), ("k must not be 0", "k must not be 0"), ("theta", "θ")],
)
def test_a_sentence_begins_with_a_capital_unless_it_is_a_symbol(plain, shown):
    assert sentence(plain) == shown
