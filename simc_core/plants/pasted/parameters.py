"""A plant given as a list of parameters: k=2, tau=10, theta=3; Km=2.5, Tm=8, Taum=1.2."""

from fractions import Fraction

from simc_core.errors import ParseError
from simc_core.numbers.refusal import quoted
from simc_core.plants.parse_values import ONE, Polynomial, Value
from simc_core.plants.pasted.statements import Statement
from simc_core.plants.pasted.tokens import fault
from simc_core.wording import said

GAINS = ("k", "km", "kp", "k0", "ks", "gain", "processgain")
DELAYS = (
    "theta", "thetam", "thetap", "theta0", "l", "lm", "taum", "taud", "td", "tdelay", "delay", "deadtime", "timedelay",
    "transportdelay", "t0", "inputdelay", "outputdelay", "iodelay",
)  # fmt: skip
LAGS = (
    "tau", "taup", "tau1", "tau2", "tau3", "tau0", "t", "tm", "tp", "t1", "t2", "t3", "tp1", "tp2", "tp3",
    "timeconstant", "lag", "lag1", "lag2", "lag3",
)  # fmt: skip
DAMPING = ("zeta", "zeta0", "xi")
ENOUGH = said(
    "write gain, lag and dead time as in k=2, tau=10, theta=3, or a transfer function as in 2 e^{-3s}/(10s+1)"
)


def from_parameters(text: str, given: dict[str, tuple[Fraction, Statement]]) -> Value:
    """The plant of the parameters `given`, by name.

    Raises ParseError where a name is not known, where tau may be a lag or the dead time, or where one is missing.
    """
    found: dict[str, list[Fraction]] = {"gain": [], "delay": [], "lag": [], "damping": []}
    for name, (number, part) in given.items():
        kind = next(
            (kind for kind, names in zip(found, (GAINS, DELAYS, LAGS, DAMPING), strict=True) if name.lower() in names),
            None,
        )
        if kind is None:
            raise _fault(
                text,
                said("'{name}' is not known in a list of parameters: {enough}", name=quoted(part.name), enough=ENOUGH),
                part,
            )
        found[kind].append(number)
    first = next(iter(given.values()))[1]
    letters = {name.lower() for name in given}
    if "tau" in letters and letters & {"t", "tm", "tp", "t1"}:
        raise _fault(
            text,
            said("tau can be read in two ways beside T: write theta for the dead time, or tau1 and tau2 for two lags"),
            given[next(name for name in given if name.lower() == "tau")][1],
        )
    if len(found["gain"]) != 1 or not found["lag"] or len(found["delay"]) > 1 or len(found["damping"]) > 1:
        raise _fault(
            text, said("'{name} = ...' alone is not a plant: {enough}", name=quoted(first.name), enough=ENOUGH), first
        )
    if 0 in found["lag"]:
        raise _fault(text, said("a lag must not be zero: leave it out"), first)
    one = Fraction(1)
    if found["damping"]:
        if len(found["lag"]) != 1:
            raise _fault(text, said("zeta belongs to one tau: write k=2, tau=5, zeta=0.3, theta=1"), first)
        tau = found["lag"][0]
        lags: tuple[Polynomial, ...] = ((one, 2 * found["damping"][0] * tau, tau * tau),)
    else:
        lags = tuple((one, tau) for tau in found["lag"])
    theta = found["delay"][0] if found["delay"] else Fraction(0)
    return Value(((found["gain"][0],),) if found["gain"] else (ONE,), lags, theta, first.at)


def _fault(text: str, message: str, part: Statement) -> ParseError:
    return fault(message, text, part.at)
