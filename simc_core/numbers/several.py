"""Lists of coefficients: 1 3.5 2, 1; 3,5; 2, [1, 3.5, 2]', num = [1 0.5], conv([1 2], [3 4]).

Numbers stand apart by blanks, by semicolons, or by commas. Brackets are a program's, where a comma is never decimal;
outside of brackets a comma is decimal where blanks or semicolons do the separating. Anything else has two readings.
"""

import re
from fractions import Fraction

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.numbers.one import THOUSANDS, exact, to_float
from simc_core.numbers.refusal import quoted
from simc_core.numbers.signs import INVISIBLE, tidied
from simc_core.wording import said

LONGEST_LIST = 2000  # characters
MOST_PRODUCTS = 40  # conv inside conv
MOST_NUMBERS = checks.MOST_FACTORS + 1

NAME = re.compile(r"[^\W\d]\w*\s*=(?!=)")
COMMENT = re.compile(r"(?<![^\s;\]])[%#]\s*[^\W\d].*", re.DOTALL)
ARRAY = re.compile(r"(?:np\.|numpy\.)?array\s*\((.*)\)", re.DOTALL)
LIST = r"\[[^\[\]()]*\]"
PRODUCT = re.compile(rf"(?:np\.|numpy\.)?(?:conv|convolve|polymul)\s*\(\s*({LIST})\s*,\s*({LIST})\s*\)")
BRACKETS = {"[": "]", "(": ")", "{": "}"}


def read_numbers(name: str, text: str) -> list[float]:
    """Coefficients typed or pasted by a person.

    Parameters
    ----------
    name : str
        The field, as the message shall call it.
    text : str
        The list, as a person or a program writes it; see the module's docstring.

    Returns
    -------
    list of float
        At least one number, in the order given.

    Raises
    ------
    InvalidParameter
        As `read_number`, with the place of the fault in the list.

    Examples
    --------
    >>> from simc_core import read_numbers
    >>> read_numbers("denominator", "[180 5 1]"), read_numbers("denominator", "1,5; 2")
    ([180.0, 5.0, 1.0], [1.5, 2.0])
    """
    return [to_float(name, value) for value in read_exact_numbers(name, text)]


def read_exact_numbers(name: str, text: str) -> list[Fraction]:
    """As `read_numbers`, without rounding."""
    checks.text(name, text, LONGEST_LIST)
    plain = COMMENT.sub("", tidied(text.strip().strip(INVISIBLE))).strip().rstrip(";").strip()
    if assigned := NAME.match(plain):
        plain = plain[assigned.end() :].strip()
    for _ in range(MOST_PRODUCTS):
        found = PRODUCT.search(plain)
        if not found:
            break
        product = multiplied(program_list(name, found[1]), program_list(name, found[2]))
        for value in product:
            to_float(name, value)  # only to bound it
        plain = f"{plain[: found.start()]}[{', '.join(map(str, product))}]{plain[found.end() :]}"
    return _listed(name, plain)


def program_list(name: str, text: str) -> list[Fraction]:
    """The numbers of [1, 2.5 3], as MATLAB and Python have them: a comma separates, whatever stands beside it."""
    inner = text.strip()[1:-1].strip().rstrip(",")
    if re.search(r"[;\n]", inner.strip()):
        raise InvalidParameter(said("{name} must be one row of numbers, found '{text}'", name=name, text=quoted(text)))
    return _each(name, re.split(r"\s*,\s*|\s+", inner), text)


def multiplied(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    """The product of two polynomials."""
    product = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            product[i + j] += x * y
    return product


def _listed(name: str, plain: str) -> list[Fraction]:
    plain = plain.rstrip("'.").strip() if plain.endswith(("]'", "].'")) else plain
    if array := ARRAY.fullmatch(plain):
        plain = array[1].strip()
    if plain[:1] in BRACKETS and plain.endswith(BRACKETS[plain[0]]):
        inner = plain[1:-1].strip()
        if plain[0] == "[" and not re.search(r"[\[\](){};\n]", inner):
            if _two_styles(inner):
                raise _two_ways(name, plain)
            return program_list(name, plain)
        plain = inner
    if not plain:
        raise InvalidParameter(said("{name} must have at least one coefficient, found none", name=name))
    if re.search(r"[^\W\d_]{2,}|[a-df-wyzA-DF-WYZ(]", plain):
        raise InvalidParameter(
            said(
                "{name} must be coefficients, found '{plain}': write 1 3 2 for s^2 + 3s + 2",
                name=name,
                plain=quoted(plain),
            )
        )
    return _each(name, _parts(name, plain), plain)


def _two_styles(inner: str) -> bool:
    """Whether [..] holds decimal commas, or may: [1 3,5 2], [0,5]."""
    blanks = re.search(r"[^,\s]\s+[^,\s]", inner)
    return bool(re.search(r"\d,\d", inner) and blanks) or bool(re.fullmatch(r"-?0,\d+", inner))


def _parts(name: str, plain: str) -> list[str]:
    """The list taken apart; refused where that can be done in two ways."""
    if ";" in plain:
        return [part.strip() for part in plain.split(";")]
    spaced, tight = re.search(r",\s", plain), re.search(r",(?=\S)", plain)
    bare = re.search(r"[^,\s]\s+[^,\s]", plain)
    if spaced and (tight or bare):
        raise _two_ways(name, plain)
    if spaced:
        return re.split(r",\s+", plain.rstrip(", "))
    if bare or plain.count(",") == 0:
        return _blank_separated(name, plain)
    if plain.count(",") > 1:
        if THOUSANDS.fullmatch(plain):
            raise _two_ways(name, plain)
        return plain.split(",")
    if re.fullmatch(r"[+-]?0?,\d+|[+-]?\d+,", plain):  # nobody writes a leading coefficient 0
        return [plain]
    if re.search(r"[.eE/]", plain):  # 1.5,2 cannot be one number
        return plain.split(",")
    raise _two_ways(name, plain)


def _blank_separated(name: str, plain: str) -> list[str]:
    """1 3.5 2; refused where 1 200 may be twelve hundred, and where a sign has lost its number."""
    parts = plain.split()
    if re.search(r"(?<!\S)[+-]?[1-9]\d{0,2} \d{3}(?![\d/eE*x^])|\d 10(?:\^|\*\*|[⁰¹²³⁴-⁹⁺⁻])", plain):
        raise _two_ways(name, plain)
    if any(part in ("+", "-", "/", "*") for part in parts):
        raise InvalidParameter(
            said(
                "{name}: a sign must stand at its number, found '{plain}': write 1 -2 for 1 and -2",
                name=name,
                plain=quoted(plain),
            )
        )
    return parts


def _two_ways(name: str, plain: str) -> InvalidParameter:
    return InvalidParameter(
        said(
            "{name} can be read in two ways, found '{plain}': write decimal points, and semicolons between "
            "the coefficients, like 1; 2.5; 3",
            name=name,
            plain=quoted(plain),
        )
    )


def _each(name: str, parts: list[str], text: str) -> list[Fraction]:
    if len(parts) > MOST_NUMBERS:
        raise InvalidParameter(
            said(
                "{name} may have at most {most_numbers} coefficients, found {parts}",
                name=name,
                most_numbers=MOST_NUMBERS,
                parts=len(parts),
            )
        )
    values = []
    for i, part in enumerate(parts, start=1):
        if not part:
            raise InvalidParameter(
                said("{name}: coefficient {i} is missing, found '{text}'", name=name, i=i, text=quoted(text))
            )
        if " " in part:
            raise _two_ways(name, text)
        values.append(exact(said("{name}: coefficient {i}", name=name, i=i), part))
    return values
