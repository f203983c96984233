"""The publications behind the keys in brackets: full reference, what of each is in the program, its misprints."""

import streamlit as st

from pages.common.lessons.shelf import by_source
from pages.common.lessons.texts import named
from pages.common.parts.sources import address
from pages.common.parts.symbols import symbols
from pages.common.session import state
from pages.common.shell import header
from pages.common.words import translated, words
from simc_core.published.sources import SOURCES
from simc_core.published.uses import MISPRINTS, USES

header.show("sources")
with st.container(key="lesson_title"):
    st.markdown(f"# {words('Sources')}")
st.markdown(
    words(
        "A DOI is given where it was found confirmed. \\[PSB\\], \\[RC00\\], \\[SK98\\] and \\[V06\\] are cited as "
        "this project received them, those without a DOI from the common knowledge of the field: look them up before "
        "you cite them."
    )
)
taught = by_source()
asked = state.place().get("source", "")
for key in sorted(SOURCES, key=lambda key: (key != asked, key)):
    with st.container(key=f"source_{key}", border=key == asked, gap="xsmall"):
        reference, _, doi = translated(SOURCES[key]).partition("https://")
        link = f"[https\\://{doi}](https://{doi})" if doi else ""
        st.markdown(f"**[\\[{key}\\]]({address(key)})** {reference}{link}  \n{symbols(USES[key])}")
        if key in MISPRINTS:
            st.markdown(words("Misprints: {misprints}", misprints=" ".join(map(symbols, MISPRINTS[key]))))
        if found := taught.get(key):
            links = ", ".join(f"[{named(each, each.title)}](lessons?lesson={each.id}&step=1)" for each in found)
            st.markdown(words("Lessons: {lessons}", lessons=links))
