"""References computed now, group by group, and what they come to."""

import math
from html import escape

import streamlit as st

from pages.common.parts.sources import linked
from pages.common.parts.symbols import symbols
from simc_core.published.checks import GROUPS, Check

WHY = {
    "Time responses": "y at one instant. The high-precision values expand the loop in powers of $e^{-\\theta s}$ and "
    "invert each term on a contour, which has nothing in common with the engine here.",
    "Metrics of steps": "Integrals over all time. For $L = e^{-s}/(2s)$ the response is a polynomial between whole "
    "times, integrated between its roots in 60 digits; a response of one sign has IAE = $\\tau_I/K_c$.",
    "Margins": "For a first-order plant they follow by hand, the others by root finding in 60 digits, "
    "and [SK03] prints them to three.",
    "Stability at the limit": "Verdicts one part in 10⁹ inside, on, and outside of limits that follow by hand, and "
    "counts of unstable poles.",
    "Half rule and settings": "The worked examples of the papers, printed to two or three digits.",
    "Cascade": "Settings, peaks and integrals that the paper prints for its first pair of processes, both dead times "
    "exact.",
}


def summary(checks: list[Check]) -> None:
    """How many are met, and the largest difference from what is known exactly; what is not met is named."""
    st.html(summary_html(checks))
    for found in checks:
        if not found.met:
            row = found.reference
            why = found.fault or f"expected {value_text(row.expected)}, found {value_text(found.ours)}"
            source = linked(f"[{row.source.strip('[]')}]")
            st.error(f"**{row.group}: {row.what}, {row.quantity}** {source}: {why}")


def summary_html(checks: list[Check]) -> str:
    """The strip on top."""
    met = sum(found.met for found in checks)
    exact = [found for found in checks if found.reference.exact and not math.isnan(found.difference)]
    worst = max(exact, key=lambda found: abs(found.difference))
    band = "calm" if met == len(checks) else "alarm"
    largest = signed(f"{abs(worst.difference):.1e}")
    where = escape(f"{worst.reference.what}: {worst.reference.quantity}")
    return (
        f'<div class="strip accuracy {band}" role="status"><div class="first"><b>{met} of {len(checks)}</b>'
        "<span>within their tolerance</span></div>"
        f"<div><small>Largest difference from an exact number</small><b>{largest}</b></div>"
        f"<div><small>in</small><b>{where}</b></div></div>"
    )


def groups(checks: list[Check]) -> None:
    """A table a group, with one sentence on where its numbers come from."""
    for number, group in enumerate(GROUPS):
        found = [each for each in checks if each.reference.group == group]
        met = sum(each.met for each in found)
        st.markdown(f"**{group}**, {met} of {len(found)}. {linked(WHY[group])}")
        with st.container(key=f"references_{number}"):
            st.table(table(found))


def table(found: list[Check]) -> dict[str, list[str]]:
    """Columns of text."""
    rows = [each.reference for each in found]
    return {
        "met": ["✓" if each.met else "✗ differs" for each in found],
        "Case": [row.what for row in rows],
        "Quantity": [symbols(row.quantity) for row in rows],
        "Expected": [value_text(row.expected) for row in rows],
        "Here": [value_text(each.ours) for each in found],
        "Difference": ["" if math.isnan(each.difference) else signed(f"{each.difference:.1e}") for each in found],
        "Allowed": ["" if isinstance(row.expected, str) else signed(f"{row.tolerance:.0e}") for row in rows],
        "Source": [row.source for row in rows],
    }


def value_text(value: float | str) -> str:
    """Fifteen digits, as many as a double always has; words as they are."""
    return value if isinstance(value, str) else signed(f"{value:.15g}")


def signed(number: str) -> str:
    """With the minus sign of print in place of a hyphen."""
    return number.replace("-", "−")
