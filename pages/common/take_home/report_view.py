"""The report of the loop: files to keep, and how it looks on paper."""

from functools import partial

import streamlit as st

from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.take_home.as_png import as_png
from pages.common.take_home.report.html import STYLE, body, document, picture
from pages.common.take_home.report.record import report
from pages.common.take_home.report.texts import curves_csv, markdown, settings_csv
from pages.common.words import translated, words
from simc_core.wording import said

FILES = (  # label, ending, kind, from the record
    (said("HTML, to print"), "html", "text/html", document),
    (said("Markdown"), "md", "text/markdown", markdown),
    (said("Settings as CSV"), "csv", "text/csv", settings_csv),
    (said("Figures as SVG"), "svg", "image/svg+xml", picture),
    (said("Curves as CSV"), "curves.csv", "text/csv", curves_csv),
)
IN_LANGUAGE = (document, picture)  # made at once: a file that is made when it is asked for has no session to speak for


def report_view(design: Design, present: Study) -> None:
    """What there is to tell, whatever the box makes of the design."""
    found = report(design, present, state.address())
    name = "".join(c if c.isalnum() else "_" for c in design.sheet.tag) or "loop"
    with st.container(horizontal=True, gap="small"):
        for label, ending, kind, make in FILES:
            file = make(found) if make in IN_LANGUAGE else partial(make, found)
            st.download_button(
                translated(label), file, f"{name}.{ending}", kind, key=f"report_{ending}", on_click="ignore"
            )
            if make is picture:
                as_png(file, f"{name}.png", "report_png")
    st.caption(words("A PDF is made by the print command of the browser, from the HTML file."))
    st.html(f"<style>{STYLE}</style>{body(found)}")
