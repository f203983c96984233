"""The publications this program relies on: key in square brackets, full reference. docs/sources.md is made from it.

`[SK03 eq. 10]` anywhere in the tree means equation 10 of `SOURCES["SK03"]`. tests/test_sources.py compares both ways:
every key that is used has its entry, and every entry is used.

    python -m simc_core.published.sources > docs/sources.md

A title stays in its language. Where words of ours stand in a reference, it is a sentence of the catalogue.
"""

from simc_core.wording import said

SOURCES = {
    "AH04": "K. J. Astrom and T. Hagglund: Revisiting the Ziegler-Nichols step response method for PID control. "
    "Journal of Process Control 14 (2004) 635-650.",
    "AH84": "K. J. Astrom and T. Hagglund: Automatic tuning of simple regulators with specifications on phase and "
    "amplitude margins. Automatica 20 (1984) 645-651.",
    "AH95": "K. J. Astrom and T. Hagglund: PID Controllers: Theory, Design, and Tuning. 2nd edition, Instrument "
    "Society of America, 1995.",
    "B17": said(
        "{reference} PhD thesis, Lund University, 2017.",
        reference="J. Berner: Automatic controller tuning using relay-based model identification.",
    ),
    "CC53": "G. H. Cohen and G. A. Coon: Theoretical consideration of retarded control. Transactions of the ASME 75 "
    "(1953) 827-834.",
    "CHR52": "K. L. Chien, J. A. Hrones and J. B. Reswick: On the automatic control of generalized passive systems. "
    "Transactions of the ASME 74 (1952) 175-185.",
    "D07": said(
        "{author}: PID controllers, principles and tuning (in Russian). 2007; as this project received it.",
        author="V. V. Denisenko",
    ),
    "FL00": "U. Forssell and L. Ljung: Identification of unstable systems using output error and Box-Jenkins model "
    "structures. IEEE Transactions on Automatic Control 45 (2000) 137-141.",
    "GP73": "G. H. Golub and V. Pereyra: The differentiation of pseudo-inverses and nonlinear least squares problems "
    "whose variables separate. SIAM Journal on Numerical Analysis 10 (1973) 413-432.",
    "GS18": "C. Grimholt and S. Skogestad: Optimal PI and PID control of first-order plus delay processes and "
    "evaluation of the original and improved SIMC rules. Journal of Process Control 70 (2018) 36-46.",
    "H64": "P. J. Huber: Robust estimation of a location parameter. Annals of Mathematical Statistics 35 (1964) "
    "73-101.",
    "K54": said(
        "{author}: {first} (magnitude optimum), Regelungstechnik 2 (1954) and 3 (1955); {second}, Regelungstechnik 6 "
        "(1958).",
        author="C. Kessler",
        first="Ueber die Vorausberechnung optimal abgestimmter Regelkreise",
        second="Das symmetrische Optimum",
    ),
    "K95": "U. Kuhn: Eine praxisnahe Einstellregel fuer PID-Regler: die T-Summen-Regel. Automatisierungstechnische "
    "Praxis 37 (1995) no. 5, 10-16.",
    "LPLB98": "Y. Lee, S. Park, M. Lee and C. Brosilow: PID controller tuning for desired closed-loop responses for "
    "SI/SO systems. AIChE Journal 44 (1998) 106-115.",
    "M67": "P. W. Murrill: Automatic Control of Processes. International Textbook Company, 1967.",
    "NW87": "W. K. Newey and K. D. West: A simple, positive semi-definite, heteroskedasticity and autocorrelation "
    "consistent covariance matrix. Econometrica 55 (1987) 703-708.",
    "PSB": said(
        "Prelic, Sekara and Boskovic: analytic design of PI and PID controllers for cascade processes under robustness "
        "constraints."
    ),
    "R69": "A. A. Rovira, P. W. Murrill and C. L. Smith: Tuning controllers for setpoint changes. Instruments and "
    "Control Systems 42 (1969) 67-69.",
    "RC00": said(
        "Collection of texts on PID tuning (in Russian); authors and year not told; as this project received it."
    ),
    "RMS86": "D. E. Rivera, M. Morari and S. Skogestad: Internal Model Control. 4. PID Controller Design. Industrial & "
    "Engineering Chemistry Process Design and Development 25 (1986) 252-265. "
    "https://doi.org/10.1021/i200032a041",
    "S72": "C. L. Smith: Digital Computer Process Control. Intext Educational Publishers, 1972.",
    "SCH97": "H. M. Schaedel: A new method of direct PID controller design based on the principle of cascaded damping "
    "ratios. Proceedings of the European Control Conference, 1997.",
    "SG12": "S. Skogestad and C. Grimholt: The SIMC Method for Smooth PID Controller Tuning. Chapter 5 in R. Vilanova "
    "and A. Visioli (eds.), PID Control in the Third Millennium, Springer, 2012. "
    "https://doi.org/10.1007/978-1-4471-2425-2_5",
    "SK03": "S. Skogestad: Simple analytic rules for model reduction and PID controller tuning. Journal of Process "
    "Control 13 (2003) 291-309. https://doi.org/10.1016/S0959-1524(02)00062-8",
    "SK98": said(
        "{reference} (Derivation of Skogestad's PID rules). Note in Norwegian, 20 August 1998.",
        reference="S. Skogestad: Utledning av Skogestads PID-regler",
    ),
    "SS10": "M. Shamsuzzoha and S. Skogestad: The setpoint overshoot method: A simple and fast closed-loop approach "
    "for PID tuning. Journal of Process Control 20 (2010) 1220-1234.",
    "T84": "Y. Z. Tsypkin: Relay Control Systems. Cambridge University Press, 1984.",
    "TL92": "B. D. Tyreus and W. L. Luyben: Tuning PI controllers for integrator/dead time processes. Industrial & "
    "Engineering Chemistry Research 31 (1992) 2625-2628.",
    "V06": said(
        "{reference} (Simple controller tuning by the SIMC method). In Czech, 2006.",
        reference="Viteckova: Jednoduche serizeni regulatoru metodou SIMC",
    ),
    "YIG07": "Z.-J. Yang, H. Iemura, S. Kanae and K. Wada: Identification of continuous-time systems with multiple "
    "unknown time delays by global nonlinear least-squares and instrumental variable methods. Automatica 43 (2007) "
    "1257-1264.",
    "ZN42": "J. G. Ziegler and N. B. Nichols: Optimum settings for automatic controllers. Transactions of the ASME 64 "
    "(1942) 759-768.",
}

HEAD = """# Sources

Made by `python -m simc_core.published.sources`; to change an entry, change that module. A DOI is given where it was
found confirmed. [PSB], [SK98] and [V06] are cited as this project received them, those without a DOI from the common
knowledge of the field: look them up before you cite them.
"""


def as_markdown() -> str:
    """The text of docs/sources.md."""
    return HEAD + "".join(f"\n**[{key}]** {reference}\n" for key, reference in SOURCES.items())


if __name__ == "__main__":
    print(as_markdown(), end="")
