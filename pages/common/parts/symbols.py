"""Names of the core's plain messages as a reader of a page knows them: tau1 as τ₁, theta as θ."""

import re

from pages.common.words import translated
from simc_core.wording import said

SYMBOLS = {
    "tau0b": "τ₀ᵦ",
    "tau0": "τ₀",
    "tau1": "τ₁",
    "tau2": "τ₂",
    "tau_c": "$\\tau_c$",
    "tau_c_inner": said("{symbol} (inner)", symbol="$\\tau_c$"),
    "tau_c_outer": said("{symbol} (outer)", symbol="$\\tau_c$"),
    "lambda": "λ",
    "lambda_inner": said("{symbol} (inner)", symbol="λ"),
    "lambda_outer": said("{symbol} (outer)", symbol="λ"),
    "Ms_inner": said("{symbol} (inner)", symbol="$M_s$"),
    "Ms_outer": said("{symbol} (outer)", symbol="$M_s$"),
    "N_inner": said("{symbol} (inner)", symbol="N"),
    "N_outer": said("{symbol} (outer)", symbol="N"),
    "primary": "$G_a$",
    "secondary": "$G_b$",
    "u_min": "$u_{min}$",
    "u_max": "$u_{max}$",
    "tau_I": "$\\tau_I$",
    "tau_D": "$\\tau_D$",
    "tau_F": "$\\tau_F$",
    "tau": "τ",
    "theta": "θ",
    "zeta": "ζ",
    "omega": "ω",
    "T0": "T₀",
    "Kc": "$K_c$",
    "Kp": "$K_p$",
    "Kd": "$K_d$",
    "Ki": "$K_i$",
    "K_I": "$K_I$",
    "k_db": "$k_{db}$",
    "k'": "$k'$",
    "k''": "$k''$",
    "d1": "$d_1$",
    "d2": "$d_2$",
    "<=": "≤",
    ">=": "≥",
    "deg": "°",
}
WORD = re.compile(r"(?<![\w'\\])(?:" + "|".join(map(re.escape, sorted(SYMBOLS, key=len, reverse=True))) + r")(?![\w'])")
SMALL_WORD = re.compile(r"[^\W\d_]{3}|no ")
NEGATIVE = re.compile(r"(?<![\w.^{)-])-(?=[\d.])")  # the sign of a number


def symbols(text: str) -> str:
    """`text` for st.markdown, in the language in use, with Greek letters, indices and minus signs for plain names."""
    return NEGATIVE.sub("−", WORD.sub(lambda found: translated(SYMBOLS[found[0]]), translated(text)))


def spoken(text: str) -> str:
    """The same without formulas, for the name of a button, which a screen reader says as it is written."""
    return re.sub(r"[$_{}]", "", symbols(text).replace(r"\tau", "τ").replace(r"\lambda", "λ"))


def sentence(text: str) -> str:
    """The same with a capital at its beginning, unless that is a symbol."""
    shown = symbols(text)
    return shown[0].upper() + shown[1:] if SMALL_WORD.match(shown) else shown
