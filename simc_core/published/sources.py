"""The publications this program relies on: key in square brackets, full reference. docs/sources.md is made from it.

`[SK03 eq. 10]` anywhere in the tree means equation 10 of `SOURCES["SK03"]`. tests/test_sources.py compares both ways:
every key that is used has its entry, and every entry is used.

    python -m simc_core.published.sources > docs/sources.md
"""

SOURCES = {
    "PSB": "Prelic, Sekara and Boskovic: analytic design of PI and PID controllers for cascade processes under "
    "robustness constraints.",
    "RMS86": "D. E. Rivera, M. Morari and S. Skogestad: Internal Model Control. 4. PID Controller Design. Industrial & "
    "Engineering Chemistry Process Design and Development 25 (1986) 252-265. "
    "https://doi.org/10.1021/i200032a041",
    "SG12": "S. Skogestad and C. Grimholt: The SIMC Method for Smooth PID Controller Tuning. Chapter 5 in R. Vilanova "
    "and A. Visioli (eds.), PID Control in the Third Millennium, Springer, 2012. "
    "https://doi.org/10.1007/978-1-4471-2425-2_5",
    "SK03": "S. Skogestad: Simple analytic rules for model reduction and PID controller tuning. Journal of Process "
    "Control 13 (2003) 291-309. https://doi.org/10.1016/S0959-1524(02)00062-8",
    "SK98": "S. Skogestad: Utledning av Skogestads PID-regler (Derivation of Skogestad's PID rules). Note in "
    "Norwegian, 20 August 1998.",
    "V06": "Viteckova: Jednoduche serizeni regulatoru metodou SIMC (Simple controller tuning by the SIMC method). In "
    "Czech, 2006.",
}

HEAD = """# Sources

Made by `python -m simc_core.published.sources`; to change an entry, change that module. A DOI is given where it was
found confirmed. No DOI was found for [PSB], [SK98] and [V06], and their authors and titles are as this project received
them: look them up before you cite them.
"""


def as_markdown() -> str:
    """The text of docs/sources.md."""
    return HEAD + "".join(f"\n**[{key}]** {reference}\n" for key, reference in SOURCES.items())


if __name__ == "__main__":
    print(as_markdown(), end="")
