"""References computed now, group by group, and what they come to."""

import math
from html import escape

import streamlit as st

from pages.common.parts.sources import linked
from pages.common.parts.symbols import symbols
from pages.common.words import numeral, translated, words
from simc_core.published.checks import GROUPS, Check
from simc_core.wording import said

WHY = {
    "Time responses": said(
        "y at one instant. The high-precision values expand the loop in powers of $e^{-\\theta s}$ and invert each "
        "term on a contour, which has nothing in common with the engine here."
    ),
    "Metrics of steps": said(
        "Integrals over all time. For $L = e^{-s}/(2s)$ the response is a polynomial between whole times, integrated "
        "between its roots in 60 digits; a response of one sign has IAE = $\\tau_I/K_c$."
    ),
    "Margins": said(
        "For a first-order plant they follow by hand, the others by root finding in 60 digits, and [SK03] prints them "
        "to three."
    ),
    "Stability at the limit": said(
        "Verdicts one part in 10⁹ inside, on, and outside of limits that follow by hand, and counts of unstable poles."
    ),
    "Half rule and settings": said("The worked examples of the papers, printed to two or three digits."),
    "Cascade": said(
        "Settings, peaks and integrals that the paper prints for its first pair of processes, both dead times exact."
    ),
}


def summary(checks: list[Check]) -> None:
    """How many are met, and the largest difference from what is known exactly; what is not met is named."""
    st.html(summary_html(checks))
    for found in checks:
        if not found.met:
            row = found.reference
            why = found.fault or words(
                "expected {expected}, found {ours}", expected=value_text(row.expected), ours=value_text(found.ours)
            )
            told = words(
                "**{group}: {what}, {quantity}** [{source}]: {why}",
                group=row.group,
                what=row.what,
                quantity=row.quantity,
                source=translated(row.source).strip("[]"),
                why=why,
            )
            st.error(linked(told))


def summary_html(checks: list[Check]) -> str:
    """The strip on top."""
    met = sum(found.met for found in checks)
    exact = [found for found in checks if found.reference.exact and not math.isnan(found.difference)]
    worst = max(exact, key=lambda found: abs(found.difference))
    band = "calm" if met == len(checks) else "alarm"
    largest = signed(f"{abs(worst.difference):.1e}")
    where = escape(f"{translated(worst.reference.what)}: {translated(worst.reference.quantity)}")
    share, tolerance = words("{met} of {n}", met=met, n=len(checks)), words("within their tolerance")
    difference, place = words("Largest difference from an exact number"), words("in", context="largest difference")
    return (
        f'<div class="strip accuracy {band}" role="status"><div class="first"><b>{share}</b>'
        f"<span>{tolerance}</span></div><div><small>{difference}</small><b>{largest}</b></div>"
        f"<div><small>{place}</small><b>{where}</b></div></div>"
    )


def groups(checks: list[Check]) -> None:
    """A table a group, with one sentence on where its numbers come from."""
    for number, group in enumerate(GROUPS):
        found = [each for each in checks if each.reference.group == group]
        met = sum(each.met for each in found)
        told = words("**{group}**, {met} of {n}. {why}", group=group, met=met, n=len(found), why=WHY[group])
        st.markdown(linked(told))
        with st.container(key=f"references_{number}"):
            st.table(table(found))


def table(found: list[Check]) -> dict[str, list[str]]:
    """Columns of text."""
    rows = [each.reference for each in found]
    return {
        words("met"): ["✓" if each.met else words("✗ differs") for each in found],
        words("Case"): [translated(row.what) for row in rows],
        words("Quantity"): [symbols(row.quantity) for row in rows],
        words("Expected"): [value_text(row.expected) for row in rows],
        words("Here"): [value_text(each.ours) for each in found],
        words("Difference"): [
            "" if math.isnan(each.difference) else signed(f"{each.difference:.1e}") for each in found
        ],
        words("Allowed"): ["" if isinstance(row.expected, str) else signed(f"{row.tolerance:.0e}") for row in rows],
        words("Source"): [translated(row.source) for row in rows],
    }


def value_text(value: float | str) -> str:
    """Fifteen digits, as many as a double always has; words as they are."""
    return translated(value) if isinstance(value, str) else signed(f"{value:.15g}")


def signed(number: str) -> str:
    """With the minus sign of print in place of a hyphen."""
    return numeral(number.replace("-", "−"))
