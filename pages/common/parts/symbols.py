"""Names of the core's plain messages as a reader of a page knows them: tau1 as τ₁, theta as θ."""

import re

SYMBOLS = {
    "tau0b": "τ₀ᵦ",
    "tau0": "τ₀",
    "tau1": "τ₁",
    "tau2": "τ₂",
    "tau_c": "$\\tau_c$",
    "tau_c_inner": "$\\tau_c$ (inner)",
    "tau_c_outer": "$\\tau_c$ (outer)",
    "lambda": "λ",
    "lambda_inner": "λ (inner)",
    "lambda_outer": "λ (outer)",
    "Ms_inner": "$M_s$ (inner)",
    "Ms_outer": "$M_s$ (outer)",
    "N_inner": "N (inner)",
    "N_outer": "N (outer)",
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
WORD = re.compile(r"(?<![\w'])(?:" + "|".join(map(re.escape, sorted(SYMBOLS, key=len, reverse=True))) + r")(?![\w'])")
NEGATIVE = re.compile(r"(?<![\w.^{)-])-(?=[\d.])")  # the sign of a number


def symbols(text: str) -> str:
    """`text` for st.markdown, with Greek letters, indices and minus signs in place of their plain names."""
    return NEGATIVE.sub("−", WORD.sub(lambda found: SYMBOLS[found[0]], text))


def spoken(text: str) -> str:
    """The same without formulas, for the name of a button, which a screen reader says as it is written."""
    return re.sub(r"[$_{}]", "", symbols(text).replace(r"\tau", "τ").replace(r"\lambda", "λ"))


def sentence(text: str) -> str:
    """The same with a capital at its beginning, unless that is a symbol."""
    shown = symbols(text)
    return shown[0].upper() + shown[1:] if re.match(r"[a-z]{3}|no ", shown) else shown
