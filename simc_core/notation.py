"""Numbers, plants, models and controllers as LaTeX and as plain text.

`plain` of a plant reads back through parse_plant to the last bit. (A pair with |zeta| >= 1 comes back as the two
real time constants that it is.)
"""

import math
from collections.abc import Callable
from decimal import Decimal  # 28 digits by default, enough for any zeta
from fractions import Fraction
from itertools import groupby

from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.wording import Numeral

DIGITS = 4  # significant digits of numbers meant for the eye


def number(value: float, digits: int = DIGITS) -> Numeral:
    """`value` with `digits` significant digits: 0.3571, 1.2e-5, 12350, ∞; no trailing zeros."""
    return Numeral(_number(value, digits))


def _number(value: float, digits: int) -> str:
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    text = f"{value:.{digits}g}"
    if "e" not in text:
        return text
    if 1 <= abs(float(text)) < 1e6:  # 12345 is not 1.234e+04 to an engineer
        return f"{float(text):.0f}"
    mantissa, exponent = text.split("e")
    return f"{mantissa}e{int(exponent)}"


def rounded_up(value: float, digits: int = 3) -> float:
    """`value` > 0 to `digits` significant digits, not below it."""
    unit = 10.0 ** (math.floor(math.log10(value)) - digits + 1)
    return float(f"{math.ceil(value / unit * (1 - 1e-12)) * unit:.{digits}g}")


def rounded_down(value: float, digits: int = 3) -> float:
    """`value` > 0 to `digits` significant digits, not above it."""
    unit = 10.0 ** (math.floor(math.log10(value)) - digits + 1)
    return float(f"{math.floor(value / unit * (1 + 1e-12)) * unit:.{digits}g}")


def latex_number(value: float, digits: int = DIGITS) -> str:
    """`value` as LaTeX with `digits` significant digits."""
    text = number(value, digits).replace("∞", r"\infty").replace("−", "-").replace("–", r"\text{–}")
    if "e" not in text or "\\" in text:
        return text
    mantissa, exponent = text.split("e")
    return rf"{mantissa}\cdot 10^{{{exponent}}}"


def latex(item: Plant | Model | Controller, digits: int = DIGITS) -> str:
    """`item` as a LaTeX transfer function of s, a fraction where there is a denominator."""
    if isinstance(item, SeriesPid | IdealPid | ParallelPid | IController):
        return _latex_controller(item, digits)
    top, bottom = latex_factors(item if isinstance(item, Plant) else item.plant, digits)
    return rf"\frac{{{' '.join(top)}}}{{{' '.join(bottom)}}}" if bottom else " ".join(top)


def latex_factors(plant: Plant, digits: int = DIGITS) -> tuple[list[str], list[str]]:
    """Numerator, with gain and dead time, and denominator, each as LaTeX factors to be written one after the other."""
    show = _Latex(digits)
    top, bottom = _numerator(plant, show), _denominator(plant, show)
    if plant.theta:
        top.append(show.delay(plant.theta))
    # the unity numerator of 1/(s+1) needs its 1, that of e^{-s}/(s+1) does not
    if plant.k == -1 and top:
        top[0] = "-" + top[0]
    elif plant.k != 1 or not top:
        top.insert(0, show.number(plant.k))
    if len(bottom) == 1 and bottom[0].startswith("(") and bottom[0].endswith(")"):
        bottom[0] = bottom[0][1:-1]
    return top, bottom


def plain(item: Plant | Model) -> str:
    """`item` as one line of text that parse_plant reads back."""
    plant = item if isinstance(item, Plant) else item.plant
    show = _Plain()
    top, bottom = _numerator(plant, show), _denominator(plant, show)
    delay = show.delay(plant.theta)
    head = [] if plant.k == 1 and (top or delay) else [show.number(plant.k)]
    text = " ".join([*head, *top, *([delay] if delay else [])])
    if not bottom:
        return text
    return f"{text}/({' '.join(bottom)})" if len(bottom) > 1 else f"{text}/{bottom[0]}"


class _Latex:
    """How factors are written in LaTeX."""

    def __init__(self, digits: int):
        self.digits = digits

    def number(self, value: float) -> str:
        return latex_number(value, self.digits)

    def middle(self, tau: float, zeta: float) -> str:
        return self.number(2 * zeta * tau)

    def power(self, base: str, exponent: int) -> str:
        return base if exponent == 1 else f"{base}^{{{exponent}}}"

    def delay(self, theta: float) -> str:
        return rf"e^{{-{times_s(self.number(theta))}}}" if theta else ""


class _Plain:
    """How factors are written in text that reads back: every digit, brackets everywhere."""

    def number(self, value: float) -> str:
        text = repr(value)
        return text.removesuffix(".0")

    def middle(self, tau: float, zeta: float) -> str:
        """2 zeta tau with as many digits as it takes to get zeta back; 17 are not always enough."""
        double = 2 * Fraction(tau)
        text = self.number(2 * zeta * tau)
        digits = 17
        while float(Fraction(text) / double) != zeta:
            text = f"{Decimal(zeta) * Decimal(2 * tau):.{digits}g}"
            digits += 1
        return text

    def power(self, base: str, exponent: int) -> str:
        return base if exponent == 1 else f"{base}^{exponent}"

    def delay(self, theta: float) -> str:
        return f"exp(-{times_s(self.number(theta))})" if theta else ""


def times_s(coefficient: str) -> str:
    """ "2 s" for "2", and "s" for "1"."""
    return "s" if coefficient == "1" else f"{coefficient} s"


def _numerator(plant: Plant, show: _Latex | _Plain) -> list[str]:
    return [
        *_powers([_first_order(T, show) for T in plant.leads], show),
        *_powers([_second_order(pair, show) for pair in plant.lead_pairs], show),
    ]


def _denominator(plant: Plant, show: _Latex | _Plain) -> list[str]:
    return [
        *([show.power("s", plant.integrators)] if plant.integrators else []),
        *_powers([_first_order(tau, show) for tau in plant.lags], show),
        *_powers([_second_order(pair, show) for pair in plant.lag_pairs], show),
    ]


def _powers(written: list[str], show: _Latex | _Plain) -> list[str]:
    return [show.power(text, len(list(group))) for text, group in groupby(written)]


def _first_order(tau: float, show: _Latex | _Plain) -> str:
    if tau < 0:
        return f"(1 - {times_s(show.number(-tau))})"
    return f"({times_s(show.number(tau))} + 1)"


def _second_order(pair: tuple[float, float], show: _Latex | _Plain) -> str:
    tau, zeta = pair
    square = show.number(tau * tau)
    first = "s^2" if square == "1" else f"{square} s^2"
    if zeta == 0:
        return f"({first} + 1)"
    return f"({first} {'+' if zeta > 0 else '-'} {times_s(show.middle(tau, abs(zeta)))} + 1)"


def _latex_controller(controller: Controller, digits: int) -> str:
    def show(value: float) -> str:
        return latex_number(value, digits)

    def lag(tau: float) -> str:
        return f"{times_s(show(tau))} + 1"

    match controller:
        case IController(K_I):
            return rf"\frac{{{show(K_I)}}}{{s}}"
        case SeriesPid(Kc, tau_I, tau_D, tau_F):
            integral = "" if tau_I == math.inf else rf"\frac{{{lag(tau_I)}}}{{{times_s(show(tau_I))}}}"
            derivative = rf"({lag(tau_D)})" if tau_D else ""
            if tau_F:
                derivative = rf"\frac{{{lag(tau_D) if tau_D else 1}}}{{{lag(tau_F)}}}"
            return " ".join(part for part in (show(Kc), integral, derivative) if part)
        case IdealPid(Kc, tau_I, tau_D, tau_F):
            inner = [
                "1",
                *([] if tau_I == math.inf else [rf"\frac{{1}}{{{times_s(show(tau_I))}}}"]),
                *([times_s(show(tau_D))] if tau_D else []),
            ]
            action = rf"\left({' + '.join(inner)}\right)" if len(inner) > 1 else ""
            return f"{show(Kc)} {action}".strip() + _latex_filter(tau_F, show)
        case ParallelPid(Kp, Ki, Kd, tau_F):
            terms = [
                *([show(Kp)] if Kp else []),
                *([rf"\frac{{{show(Ki)}}}{{s}}"] if Ki else []),
                *([times_s(show(Kd))] if Kd else []),
            ]
            total = " + ".join(terms).replace("+ -", "- ")
            return rf"\left({total}\right)" + _latex_filter(tau_F, show) if tau_F else total


def _latex_filter(tau_F: float, show: Callable[[float], str]) -> str:
    return rf" \frac{{1}}{{{times_s(show(tau_F))} + 1}}" if tau_F else ""
