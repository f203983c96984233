"""Numbers of the literature, closed forms and high precision, computed while you watch."""

import streamlit as st

from pages.common.accuracy.view import groups, summary
from pages.common.shell import header
from pages.common.words import words
from simc_core.published.checks import check_all

header.show("accuracy")
st.header(words("Check the numbers"))
st.markdown(
    words(
        "Each row is computed now, by the same functions that draw the other pages, and set beside what "
        "was printed, follows by hand, or was computed in 60 digits by another method. A printed number "
        "can be met to half its last digit, the others as far as double precision goes; what is allowed "
        "stands beside them."
    )
)
checks = check_all()
summary(checks)
groups(checks)
st.caption(
    words(
        "All published numbers are tests of the program, and the high-precision ones are computed again "
        "by its tests; these are a selection."
    )
)
