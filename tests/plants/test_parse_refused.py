"""What may be read in two ways, or is no plant: refused by name, with a way out that works when followed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import ParseError, Plant, SimcError, parse_plant

TWO_READINGS = {
    # commas and blanks
    "1,000/(5s+1)": "two ways, found '1,000': write 1000 .* 1.000",
    "2,500/(1,000s+1)": "two ways, found '2,500'",
    "1/(12,345s+1)": "two ways, found '12,345'",
    "exp(-1,500s)/s": "two ways",
    "k=1,234, tau=5": "two ways",
    "tf(1,234,[1 1])": "too many arguments: write decimal points",
    "1,000,000/(s+1)": "is not a number",
    "1.000.000/(s+1)": "is not a number",
    "2 3/(s+1)": "two numbers stand side by side, '2 3'",
    "0,5 2/(s+1)": "two numbers stand side by side",
    "1 23/(s+1)": "two numbers stand side by side",
    "12 50/(s+1)": "two numbers stand side by side",
    "1/(1 200s)": "'1 200' can be read in two ways: write 1200 without a blank, or put \\+",
    "12 500 e^{-2s}/s": "two ways",
    "1/(5s 1)": "a sign is missing",
    "[2,5]/(s+1)": r"two ways: write \[2.5\] for one number, \[2 5\] for two",
    "[1 3,5 2]/[1 2 3]": "two ways",
    "[1 2] s/(s+1)": "after a list of coefficients",
    # superscripts lost on the way
    "5e-3s/(s(10s+1))": r"'5e-3' before s .* did you mean 5 e\^\(-3s\)\?",
    "2e-1s/(s(3s+1))": r"did you mean 2 e\^\(-1s\)",
    "4e-2s/(s(s+1)(0.5s+1))": r"did you mean 4 e\^\(-2s\)",
    "5e-3s/(10s+1)": r"did you mean 5 e\^\(-3s\)",
    "2.2e-20s/(180s+1)": r"did you mean 2.2 e\^\(-20s\)",
    "-1.5e−4s/(20s+1)": r"did you mean 1.5 e\^\(-4s\)",
    "G(s) = 5e-3s(s+1)/(s(10s+1))": r"did you mean 5 e\^\(-3s\)",
    "(5e-3s)/(s(10s+1))": r"did you mean 5 e\^\(-3s\)",
    "2e-3*s/(s(10s+1))": r"did you mean 2 e\^\(-3s\)",
    "2e-3p/(p(10p+1))": r"did you mean 2 e\^\(-3s\)",
    "2e-2.5s/(5s+1)": r"did you mean 2 e\^\(-2.5s\)",
    "2e−0,5s/(5s+1)": r"did you mean 2 e\^\(-0.5s\)",
    "e-3s/(10s+1)": r"e must have an exponent: did you mean e\^\(-3s\)",
    "5 e-3s/(s+1)": r"did you mean e\^\(-3s\)",
    "5·e-3s/(s+1)": r"did you mean e\^\(-3s\)",
    "2/(5s+1)e-3s": r"did you mean e\^\(-3s\)",
    "5e^{-3}s/(10s+1)": "multiple of s",
    "2·103/(5s+1)": "'103' .* two ways: write 10\\^3",
    "2×10-3/(5s+1)": r"'10-3' .* two ways: write 10\^-3",
    "2*10-3/(5*s+1)": r"'10-3' .* two ways: write 10\^-3 .* or 10 - 3 with blanks",
    # numbers of equations and lists
    r"\frac{2}{10s+1}   (3)": r"'\(3\)' can be the number of an equation: leave it out",
    "2/(10s+1) [3]": "can be the number of an equation",
    "(3) e^{-s}/(10s+1)": "can be the number of an equation",
    "2. e^{-s}/(10s+1)": "'2.' can be the number of a list: leave it out, or write 2.0",
    # exponents on a line of their own, in a field of one line
    "2   -------   2   s  + 3 s + 1": "a power on a line of its own: write s\\^2",
    "2      ─────────────  2           s  + 3⋅s + 1 ": "a power on a line of its own",
    " 0.5 ───   2  s ": "a power on a line of its own",
    "     -3s   2 e  ---------  10 s + 1": "e must have an exponent",
    "tf([0.2],[1 -0.8],'Variable','z^-1')": "sampled model",
    "tf([0.2],[1 -0.8],'Ts',1)": "sampling time",
    "tf(0.2,[1 -0.8],'variable','z')": "sampled model",
    "z = tf('z'); G = 0.2/(z-0.8)": "a sampled model in z is not read",
    "0.5*q^-1/(1-0.9*q^-1)": "'q' is not known: a sampled model",
    "1.234.567,8/(s+1) 2": "sign is missing",
    "2,5,1/(s+1)": "is not a number: write one decimal point",
    "s+1": "a denominator is missing: write /",
    "2 e^(-3s)\n(10s+1)": "a denominator is missing: write /",
    "G = @(s) 2/(10*s+1)": r"leave @\(s\) out",
    "G(s) → 2/(10s+1)": "'G' is not known|write =",
    "2 ± 0.1/(10s+1)": "enter one value",
    "2:(10s+1)": "write / for a division",
    "k=2, theta=3, integrating": "'theta' must be a number",
    "1/(S(2)*s+1)": "two variables, S and s",
    "2, s/(s+1)": "a decimal comma stands between digits",
    "1/(s2+3s+1)": "a sign is missing before this number.* \\^ if it is a power",
    "1/(s+1)2": "a sign is missing before this number",
    "(s+1)2/(s+2)3": "a sign is missing before this number",
    # how far a denominator goes
    "1/2s": "the denominator is unclear: write",
    "1/(5s+1)(3s+1)": "the denominator is unclear: write",
    "2 e^{-3s} / 5s+1": "the denominator is unclear: write",
    "1/s²(s+1)": "the denominator is unclear: write",
    # letters
    "K=2, T=10, tau=3": "tau can be read in two ways beside T",
    "1/(s+p)": "two variables, s and p",
    "2/(5s+1), tau=3": "'tau' is given a value and is not used",
    "50%/(s+1)": "write 0.5, or 50, for 50 %",
    "50 %/(s+1)": "write 0.5, or 50, for 50 %",
    "tf(1,[1 1],0.1)": "0.1 at the end of tf.* is a sampling time",
    "control.TransferFunction([1],[1, 1], 0.1)": "sampling time",
    "G1 = 2/(5s+1); G2 = 1/(s+1)": "two transfer functions",
    "2/(5s+1); 3/(s+1)": "two transfer functions",
    "2/(5s+1) = 0.4/(s+0.2)": "'=' is not part",
}

NO_PLANT = {
    "k=2": "'k = ...' alone is not a plant: write gain, lag and dead time",
    "theta = 3": "'theta = ...' alone is not a plant",
    "T=10": "'T = ...' alone is not a plant",
    "tau=10, theta=3": "alone is not a plant",
    "k=2, theta=3": "alone is not a plant",
    "tau=10 s": "'tau' must be a number without a unit",
    "k=2, tau=10 s, theta=3 s": "'tau' must be a number without a unit",
    "2/(5s+1), theta=3 min": "'theta' must be a number without a unit|not known",
    "k=2, tau=10, alpha=3": "'alpha' is not known in a list of parameters",
    "Kp=2, Ti=10, Td=3": "'Ti' is not known",
    "k=2, k=3, tau=1": "'k' is given twice",
    "e^{-s}/(5s+1), L=2": "dead time is given twice",
    "k=2, tau=0": "must not be zero",
    "s=2; 1/(s+1)": "'s' cannot be given a value",
    "K=[1 2], T=3": "'K' must be one number",
    "num = [1 2]; G = 2/(5s+1)": "'num' is a list of numbers and is not used",
    "den = [1 3 2]": "'den' is a list of numbers and is not used: name two lists num and den",
    "b=[1 2]; a=[1 3 2]": "'b' is a list of numbers and is not used: name two lists num and den",
    "G(s) = 2/(10s+1), [3]": "a decimal comma stands between digits",
    "5*10-3s/(s+1)": r"'10-3' .* two ways",
    "2/(10 S + 1) e^{-3 s}": "two variables, S and s",
    "num = [0.5 a]; den = [1 3 2]": "'a'|found",
    "K=2, T=10 min, L=3 min": "'T' must be a number without a unit, all times in the same one: write T = 10",
    "K=2 °C/%, T=10": "'K' must be a number without a unit.*write K = 2",
    "K=2 %/%, T=10": "'K' must be a number without a unit.*write K = 2",
    "2/(10s+1), delay 3": "a dead time behind a comma is written theta = 3",
    "gain 2, time constant 10, dead time 3": "'gain' is not known: write parameters with =, as in k=2",
    "FOPDT with gain 2": "'FOPDT' is not known: write parameters with =",
    '{"k": 2, "tau": 10}': "leave the quotes out",
    "Kp = 2, wn = 0.5, zeta = 0.3": "'wn' is not known in a list of parameters",
}

WORDS = {
    "tf(": "must be closed",
    "tf()": "tf\\(...\\) is not understood .* as in tf\\(\\[1 2\\], \\[1 3 2\\]\\)",
    "control.tf([1],[1, 1], 2)": "sampling time",
    "lti(-1,1,1,0)": "state space is not read",
    "½/(s+1)": "write 0.5 or 1/2",
    r"\frac 2 {10s+1}": r"an opening bracket is expected here as in \\frac\{2\}",
    "[2] [10 1]": "a list of coefficients stands alone: write tf",
    "2/(10 min s+1)": "'min' is not known: leave units out",
    "2/(10s+1) °C/%": "leave the unit out",
    "2/(10s+1) K/kW": "'K' is not known",
    "y(s) = 2/(10s+1) u(s)": "'u' is not known: only the transfer function between input and output",
    "1.5x10-3/(10s+1)": "'x10' is not known: write 1.5e-3",
    "1.5d-3/(10s+1)": "'d' is not known: write 1.5e-3",
    "G = tf(2,[10 1]); step(G)": "'step' is not known: leave it out",
    "series(tf(2,[10 1]),tf(1,[5 1]))": r"'series' is not known: write the two with \*",
    "idproc('P1D','Kp',2)": "'idproc' is not known",
    "https://example.com/?p=2": "is not known|not part",
    "T*dy/dt + y = K*u": "'T' is not known",
    "tf(a,b)": "numerator must be coefficients, found 'a'",
    "tf(1,0)": "denominator must not be zero",
    "ss(-1,1,1,0)": "'ss' is not known: state space is not read: write",
    "control.ss(A,B,C,D)": "'control.ss' is not known: state space",
    "sqrt(x)/(s+1)": "'x' is not known",
    "sqrt(s)": "square root must be of a number",
    "pade(exp(-s),2)": "'pade' is not known: the dead time is exact here: write exp\\(-2s\\)",
    "feedback(G,1)": "'feedback' is not known",
    "minreal(1/(s+1))": "'minreal' is not known",
    "K/(T s+1)": "'K' is not known: write the transfer function in s, with numbers for everything else",
    "gain/(s+1)": "'gain' is not known",
    "1/(z-0.5)": "'z' is not known: a sampled model in z is not read",
    "G(jw) = 2/(5jw+1)": "'jw' is not known: write the transfer function in s",
    r"\foo{2}/(s+1)": r"'\\foo' is not known",
    r"2 \alpha/(s+1)": r"'\\alpha' is not known",
    "syslin('d',1/(%s+1))": "syslin\\(...\\) is not understood",
    "zpk([],[-1+2i],5)": "conjugate pairs",
    "__import__('os').system('ls')": "not part of a transfer function",
    "<script>alert(1)</script>": "'<' is not part",
    "{}": "closes a bracket that was not opened",
    "%": "'%' is not part",
    "$": "'\\$' is not part",
    "=": "expected here",
    "G(s)=": "expected here",
}

REFUSED = TWO_READINGS | NO_PLANT | WORDS


def outcome(text: str) -> str:
    """The plant, or the message, as text."""
    try:
        return str(parse_plant(text))
    except SimcError as error:
        return str(error)


@pytest.mark.parametrize("text", REFUSED)
def test_refused_by_name(text):
    with pytest.raises(ParseError, match=REFUSED[text]) as caught:
        parse_plant(text)
    assert caught.value.text == text
    assert 0 <= caught.value.position <= len(text)


@pytest.mark.parametrize(
    ("text", "followed"),
    [
        ("5e-3s/(s(10s+1))", "5 e^(-3s)/(s(10s+1))"),
        ("2.2e-20s/(180s+1)", "2.2 e^(-20s)/(180s+1)"),
        ("2e-2.5s/(5s+1)", "2 e^(-2.5s)/(5s+1)"),
        ("1,000/(5s+1)", "1000/(5s+1)"),
        ("1,000/(5s+1)", "1.000/(5s+1)"),
        ("1/(1 200s)", "1/(1200s)"),
        ("2·103/(5s+1)", "2·10^3/(5s+1)"),
        ("2·103/(5s+1)", "2*103/(5s+1)"),
        ("[2,5]/(s+1)", "[2.5]/(s+1)"),
        ("[2,5]/(s+1)", "[2 5]/(s+1)"),
        ("1/(s2+3s+1)", "1/(s^2+3s+1)"),
        ("k=2", "k=2, tau=10, theta=3"),
        ("K=2, T=10, tau=3", "K=2, T=10, theta=3"),
        ("K=2, T=10, tau=3", "K=2, tau1=10, tau2=3"),
        ("tau=10 s", "k=2, tau=10, theta=3"),
        ("50%/(s+1)", "0.5/(s+1)"),
        ("ss(-1,1,1,0)", "tf([1 2], [1 3 2])"),
        ("tf(1,[1 1],0.1)", "tf(1,[1 1],'InputDelay',0.1)"),
        ("1/(s+1) + e^{-s}/(s+2)", "(1/(s+1) + 2/(3s+1)) e^(-2s)"),
    ],
)
def test_the_way_out_works_when_followed(text, followed):
    with pytest.raises(ParseError):
        parse_plant(text)
    assert parse_plant(followed).k


@pytest.mark.parametrize(
    ("text", "sum_", "followed"),
    [
        ("2(1+e^-s)/(s(s+1))", r"close to 2 e\^\(-0.5s\)", "2(2 e^(-0.5s))/(s(s+1))"),
        ("(1-e^-.1s)/s", r"close to 0.1 s e\^\(-0.05s\)", "(0.1 s e^(-0.05s))/s"),
        ("(1-e^{-2s})/(2s)", r"close to 2 s e\^\(-1s\)", "(2 s e^(-1s))/(2s)"),
        ("(3e^{-s}+e^{-5s})/(s+1)", r"close to 4 e\^\(-2s\)", "(4 e^(-2s))/(s+1)"),
    ],
)
def test_sums_of_dead_times_name_a_plant_that_is_close_for_slow_changes(text, sum_, followed):
    with pytest.raises(ParseError, match=f"different dead times.*{sum_}"):
        parse_plant(text)
    s = 1e-3j
    meant = eval_sum(text, s)
    assert abs(complex(parse_plant(followed).response(s)) / meant - 1) < 1e-5


def eval_sum(text: str, s: complex) -> complex:
    """The sum as complex arithmetic, for the four texts above."""
    e = 2.718281828459045
    return {
        "2(1+e^-s)/(s(s+1))": 2 * (1 + e**-s) / (s * (s + 1)),
        "(1-e^-.1s)/s": (1 - e ** (-0.1 * s)) / s,
        "(1-e^{-2s})/(2s)": (1 - e ** (-2 * s)) / (2 * s),
        "(3e^{-s}+e^{-5s})/(s+1)": (3 * e**-s + e ** (-5 * s)) / (s + 1),
    }[text]


@pytest.mark.parametrize(
    "text",
    [
        "[" + "1,1," * 490,
        "[" + "1 " * 900 + "]",
        "√" * 1999,
        "s" * 2000,
        "a" * 2000,
        "\\" * 2000,
        "'" * 2000,
        "$" * 2000,
        "=" * 2000,
        "a=" * 900,
        "a=1;" * 490,
        "A=1;" + "AA" * 900,
        "a=1;aa=1;" + "a" * 39 + "b",
        "G=s;" * 400,
        "syslin('c'," * 170 + "1" + ")" * 20,
        "syslin('c'," * 150 + "1" + ")" * 150,
        "tf(" * 600,
        "tf([1 1],[1 1])" * 100,
        "conv(" * 390,
        "tf(1," + "conv([1 1]," * 100 + "[1 1]" + ")" * 101,
        "tf([" + "1e300 " * 300 + "],1)",
        "-" * 2000,
        "1\n-\n" * 400,
        "─" * 2000,
        "%" * 2000,
        "#a\n" * 600,
        "Transfer function " * 100,
        "exp(1e300 1e300 1e300s)",
        "sqrt(1e300 1e300)",
        "(" * 40 + "sqrt(" * 40 + "2" + ")" * 80,
        "{\\rm " * 300,
        "x_{" * 600,
        "a." * 900,
        "1 000" * 390,
        "1'000" * 390,
        ",".join(["1"] * 900),
        "e⁻" * 900,
        "\\frac" * 380,
        "{1\\over" * 280,
        "K=1e300;L=K^40;M=L^40/(s+1)",
        "\u202f" * 1999 + "x",
        "[a" * 900,
        " [°C/%]" * 280,
        "2e155s+1+s²",
        "1/(2e155s+1+s²)",
        "1/((2e155s+1+s²)(1+1e-155s+1e-300s^3))",
    ],
    ids=lambda text: f"{text[:14]!r} {len(text)}",
)
def test_hostile_texts_end_in_words(text):
    assert "must have at most" not in outcome(text)
    assert 0 < len(outcome(text)) < 600


PIECES = [
    *"0123456789.,;:=+-*/^()[]{}' \n%#$&\\_",
    *("s", "p", "e", "e^", "exp(", "-3s", "tf(", "zpk(", "[1 2]", "syslin('c',", "\\frac{", "\\over", "sqrt(", "pi"),
    *(
        "K",
        "K=2",
        "tau=",
        "theta=3",
        "-----",
        "G(s) =",
        "e⁻³ˢ",
        "²",
        "10^3",
        "·",
        "×",
        "\u202f",
        "−",
        "InputDelay",
        "1e-3",
    ),
]


@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
def test_any_row_of_pieces_gives_a_plant_or_words(text):
    assert outcome(text)


@given(
    st.integers(1, 999),
    st.integers(0, 999),
    st.sampled_from(["{} {:03}/(s+1)", "{},{:03}/(s+1)", "{}.{:03}/(s+1)", "{}\u202f{:03}/(s+1)", "{}'{:03}/(s+1)"]),
)
def test_no_digit_of_a_gain_is_dropped(high, low, form):
    """Digits with anything between them are one number with all of its digits, or refused."""
    text = form.format(high, low)
    found = outcome(text)
    with_point, together = Plant(high + low / 1000, 0, (1,)), Plant(high * 1000 + low, 0, (1,))
    if "," in text:
        assert "two ways" in found
    else:
        assert found == str(with_point if "." in text else together)
