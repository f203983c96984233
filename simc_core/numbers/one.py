"""One number. What can be read in two ways is refused, and no digit is ever dropped.

    0.5   0,5   −3   1e-3   2·10^-3   2×10⁻³   11/5   1,234.5   1.234,5   1 234,5   12 500   1'234   1_000

1.234 is a number here, with a decimal point; 1,234 may be meant either way and is refused.
"""

import re
from fractions import Fraction

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.numbers.refusal import no_number, quoted
from simc_core.numbers.signs import INVISIBLE, LOWERED, SUPERSCRIPTS, tidied
from simc_core.wording import said

LONGEST_NUMBER = 100  # characters
LARGEST_EXPONENT = 300  # powers of ten; a double ends at 308

DECIMAL = re.compile(r"(?:\d+(?:[.,]\d*)?|[.,]\d+)", re.ASCII)
# one to three digits that do not begin with 0, then groups of exactly three after one and the same separator
THOUSANDS = re.compile(
    r"[1-9]\d{0,2}(?P<group>[ '_,.])\d{3}(?:(?P=group)\d{3})*(?:(?!(?P=group))(?P<point>[.,])\d*)?", re.ASCII
)
TWO_WAYS = re.compile(r"[1-9]\d{0,2},\d{3}", re.ASCII)

DIGITS = r"(?P<digits>[\d.,'_ ]*[\d.,])"
WHOLE = r"[+-]?\d+"
POWER = rf"10(?P<power>(?:\^|\*\*)(?:{WHOLE}|\({WHOLE}\)|\{{{WHOLE}\}})|[⁺⁻]?[{SUPERSCRIPTS[:10]}]+)"
FORMS = [
    re.compile(rf"(?P<sign>[+-]?) *{form}", re.ASCII)
    for form in (rf"{DIGITS}(?:[eE](?P<power>{WHOLE}))?", rf"{DIGITS} *[*x ] *{POWER}", rf"(?P<digits>){POWER}")
]


def read_number(name: str, text: str) -> float:
    """One number typed by a person.

    Parameters
    ----------
    name : str
        The field, as the message shall call it.
    text : str
        What was typed: decimal point or comma, any minus sign, 1e-3, 2·10^-3, 11/5; separators of thousands where no
        other reading is left.

    Returns
    -------
    float
        The number, finite.

    Raises
    ------
    InvalidParameter
        Where the text is no number, can be read in two ways, or is too large or too small for a double; names the
        field, what was found and the way out.

    Examples
    --------
    >>> from simc_core import read_number
    >>> read_number("k", "1,5"), read_number("theta", "2·10^-3")
    (1.5, 0.002)
    """
    return to_float(name, read_exact(name, text))


def read_exact(name: str, text: str) -> Fraction:
    """As `read_number`, without rounding."""
    checks.text(name, text, LONGEST_NUMBER)
    return exact(name, text)


def exact(name: str, text: str) -> Fraction:
    """As `read_exact`, of text whose length was looked at before."""
    plain = tidied(text.strip().strip(INVISIBLE)).strip()
    if not plain:
        raise InvalidParameter(said("{name} must be a number, found nothing: write for instance 0.5", name=name))
    top, *bottom = [part.strip() for part in plain.split("/")]
    if not bottom:
        return _scientific(name, top)
    if re.search(r"[^\W\d_]{2}", plain):  # 5 kg/h
        raise InvalidParameter(no_number(name, plain))
    # 1 1/2 may be one and a half, so that blanks have no place here at all
    if len(bottom) > 1 or " " in top or " " in bottom[0] or not top or not bottom[0]:
        raise InvalidParameter(
            said(
                "{name} must be one number or one fraction like 11/5 or 3/2, found '{plain}'",
                name=name,
                plain=quoted(plain),
            )
        )
    divisor = _scientific(name, bottom[0])
    if not divisor:
        raise InvalidParameter(
            said("{name} must not be divided by zero, found '{plain}'", name=name, plain=quoted(plain))
        )
    return _scientific(name, top) / divisor


def to_float(name: str, value: Fraction) -> float:
    """`value` as a double. Raises InvalidParameter where it is too large, or not zero but would be rounded to it."""
    limit = Fraction(10) ** LARGEST_EXPONENT
    if abs(value) > limit or 0 < abs(value) < 1 / limit:
        raise InvalidParameter(
            said(
                "|{name}| must be 0 or between 1e-{largest_exponent} and 1e{largest_exponent}, found a number beyond",
                name=name,
                largest_exponent=LARGEST_EXPONENT,
            )
        )
    return float(value)


def decimal(name: str, digits: str) -> Fraction:
    """A number without sign and exponent: 12.5, 12,5, 1,234.5, 1 234: the one place that knows what a comma means.

    Raises InvalidParameter where the comma can be either.
    """
    if TWO_WAYS.fullmatch(digits):
        whole, _, rest = digits.partition(",")
        raise InvalidParameter(
            said(
                "{name} can be read in two ways, found '{digits}': write {whole}{rest} if the comma separates "
                "thousands, {whole}.{rest} if it is a decimal comma",
                name=name,
                digits=digits,
                whole=whole,
                rest=rest,
            )
        )
    if DECIMAL.fullmatch(digits):
        return Fraction(digits.replace(",", "."))
    found = THOUSANDS.fullmatch(digits)
    if not found:
        raise InvalidParameter(no_number(name, digits))
    return Fraction(digits.replace(found["group"], "").replace(",", "."))


def _scientific(name: str, part: str) -> Fraction:
    """Sign, digits and a power of ten."""
    found = next((match for form in FORMS if (match := form.fullmatch(part))), None)
    if not found:
        raise InvalidParameter(no_number(name, part))
    size = decimal(name, found["digits"]) if found["digits"] else Fraction(1)
    exponent = int((found["power"] or "0").translate(LOWERED).strip("^*(){}"))
    if abs(exponent) > LARGEST_EXPONENT:
        raise InvalidParameter(
            said(
                "{name} must have an exponent of at most {largest_exponent}, found {exponent}",
                name=name,
                largest_exponent=LARGEST_EXPONENT,
                exponent=exponent,
            )
        )
    value = size * Fraction(10) ** exponent
    return -value if found["sign"] == "-" else value
