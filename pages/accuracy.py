"""Numbers of the literature and closed forms, computed while you watch."""

import streamlit as st

from pages.common import header
from simc_core.references import REFERENCES

header.show("accuracy")
st.markdown("#### See for yourself")
st.markdown(
    "Each row is computed now, by the same functions that draw the other pages, and set beside what was printed or "
    "follows by hand. A printed number can be met to half its last digit, a closed form to rounding."
)
rows = [(reference, reference.compute()) for reference in REFERENCES]
st.table(
    {
        "": ["✓" if abs(ours - each.expected) <= each.tolerance else "✗ differs" for each, ours in rows],
        "Case": [each.what for each, _ in rows],
        "Quantity": [each.quantity for each, _ in rows],
        "Source": [each.source for each, _ in rows],
        "Expected": [f"{each.expected:.8g}" for each, _ in rows],
        "Here": [f"{ours:.12g}" for _, ours in rows],
        "Difference": [f"{ours - each.expected:.1e}" for each, ours in rows],
        "Allowed": [f"{each.tolerance:.0e}" for each, _ in rows],
    }
)
st.caption(
    "All published numbers are tests of the program; these are a selection. [SK03] J. Process Control 13 (2003) "
    "291-309. [V06] Viteckova, SIMC tables and examples."
)
