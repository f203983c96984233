"""What the page From data works on, and where a plant came from that was found there. Pure: no streamlit.

A record itself is in no link and no file; what is chosen of it is, and what was found.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from simc_core import Identified, Plant, Uncertainty, checks, uncertainty_of
from simc_core.errors import InvalidParameter, SimcError
from simc_core.identification.estimator.structures import STRUCTURES
from simc_core.identification.trend import LARGEST_INSTANT
from simc_core.plants.plant import scaled
from simc_core.wording import said

MOST_STRUCTURES = 4  # that fit nearly as well, and are kept
DIGITS = 7  # of the numbers of an uncertainty
MOST_BAD = 12  # stretches that are left out
LONGEST_SOURCE = 60  # characters
LONGEST_KEY = 20
PARAMETERS = {  # of each structure, in order, with the power of time in its unit
    "FOPDT": {"k": 0, "theta": 1, "tau1": 1},
    "SOPDT": {"k": 0, "theta": 1, "tau1": 1, "tau2": 1},
    "IPDT": {"k_prime": -1, "theta": 1},
    "IPDT_lag": {"k_prime": -1, "theta": 1, "tau2": 1},
    "DIPDT": {"k_double_prime": -2, "theta": 1},
    "inverse": {"k": 0, "T": 1, "theta": 1, "tau1": 1, "tau2": 1},
    "oscillating": {"k": 0, "theta": 1, "tau0": 1, "zeta": 0},
    "unstable": {"k_prime": -1, "theta": 1, "a": -1},
}


@dataclass(frozen=True, slots=True)
class Chosen:
    """What is chosen of a record.

    example: key of one that the program makes, "" for one that was read.   structure: of the model, "" for the best.
    begin, end: of the part that is fitted, in the time of the record; None for its ends.
    bad: stretches that are left out, as pairs (from, to).
    """

    example: str = ""
    structure: str = ""
    begin: float | None = None
    end: float | None = None
    bad: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        if len(self.example) > LONGEST_KEY or (not self.example.replace("_", "a").isalnum() and self.example):
            raise InvalidParameter(
                said(
                    "example must be a key of at most {longest_key} letters, found {example}",
                    longest_key=LONGEST_KEY,
                    example=self.example[:30],
                )
            )
        checks.one_of("structure", self.structure, ("", *STRUCTURES))
        for name in ("begin", "end"):
            if getattr(self, name) is not None:
                number = checks.real(name, getattr(self, name), -LARGEST_INSTANT, LARGEST_INSTANT)
                object.__setattr__(self, name, number)
        if self.begin is not None and self.end is not None and not self.begin < self.end:
            raise InvalidParameter(
                said("end must be > begin = {begin:g}, found {end:g}", begin=self.begin, end=self.end)
            )
        for low, high in checks.items("bad", self.bad, MOST_BAD):
            checks.real("end of a bad stretch", high, checks.real("bad", low, -LARGEST_INSTANT), LARGEST_INSTANT)


@dataclass(frozen=True, slots=True)
class Origin:
    """From what a plant was identified.

    plant: what came out.   structure: its key.   errors: standard errors of PARAMETERS of the structure, in order.
    fit: 1 - |residuals|/|PV - mean|.   samples: of PV.   source: name of the file or example.
    gains: two that moves of OP show by themselves, where they are farther apart than their errors; else empty.
    """

    plant: Plant
    structure: str
    errors: tuple[float, ...]
    fit: float
    samples: int
    source: str = ""
    gains: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        put = object.__setattr__
        wanted = len(PARAMETERS[checks.one_of("structure", self.structure, PARAMETERS)])
        if len(self.errors) != wanted:
            raise InvalidParameter(
                said(
                    "{structure} has {wanted} standard errors, found {n}",
                    structure=self.structure,
                    wanted=wanted,
                    n=len(self.errors),
                )
            )
        put(
            self, "errors", tuple(checks.real("standard error", each, 0.0, checks.LARGEST_GAIN) for each in self.errors)
        )
        put(self, "fit", checks.real("fit", self.fit, -checks.LARGEST_GAIN, 1.0))
        put(self, "samples", checks.whole("samples", self.samples, 1, 1_000_000))
        if len(self.gains) not in (0, 2):
            raise InvalidParameter(said("gains must be two, or none, found {n}", n=len(self.gains)))
        bound = checks.LARGEST_GAIN
        put(self, "gains", tuple(checks.real("gain", each, -bound, bound) for each in self.gains))
        put(self, "source", "".join(c for c in self.source if c.isprintable())[:LONGEST_SOURCE])

    def rescaled(self, plant: Plant, time: Fraction) -> "Origin":
        """The same for the plant in another time unit; times are multiplied by `time`."""
        powers = PARAMETERS[self.structure].values()
        errors = tuple(
            scaled(each, time) if power == 1 else each / float(time) ** -power
            for each, power in zip(self.errors, powers, strict=True)
        )
        power = next(iter(powers))
        gains = tuple(each / float(time) ** -power for each in self.gains)
        return Origin(plant, self.structure, errors, self.fit, self.samples, self.source, gains)


def origin_text(origin: Origin | None) -> str:
    """structure~fit~samples~standard errors~source, the structure with !gains where they differ; empty for None."""
    if origin is None:
        return ""
    numbers = [repr(origin.fit), str(origin.samples), *(repr(each) for each in origin.errors)]
    structure = "!".join([origin.structure, *(repr(each) for each in origin.gains)])
    return "~".join([structure, *numbers, origin.source])


def origin_of(text: str, plant: Plant) -> Origin:
    """The origin of this plant. Raises SimcError."""
    first, *rest = text.split("~")
    structure, *own = first.split("!")
    count = 2 + len(PARAMETERS[checks.one_of("structure", structure, PARAMETERS)])
    try:
        fit, samples, *errors = (float(each) for each in rest[:count])
        gains = tuple(float(each) for each in own)
    except ValueError:
        raise SimcError(
            said("origin of {structure} has {count} numbers after its name", structure=structure, count=count)
        ) from None
    return Origin(
        plant, structure, tuple(errors), fit, samples if math.isfinite(samples) else -1, "~".join(rest[count:]), gains
    )


def kept_uncertainty(several: Sequence[Identified]) -> tuple[Uncertainty, ...]:
    """What a record leaves open, in numbers short enough for a link; empty where they are beyond all bounds."""
    try:
        found = uncertainty_of(several)[:MOST_STRUCTURES]
        return tuple(
            Uncertainty(
                each.structure,
                tuple(float(f"{value:.{DIGITS}g}") for value in each.values),
                tuple(float(f"{value:.{DIGITS}g}") for value in each.covariance),
                float(f"{each.freedom:.{DIGITS}g}"),
            )
            for each in found
        )
    except InvalidParameter:
        return ()


def uncertainty_text(found: tuple[Uncertainty, ...]) -> str:
    """structure~freedom~values~covariance, separated by !."""
    return "!".join(
        "~".join([each.structure, *(repr(value).removesuffix(".0") for value in _numbers(each))]) for each in found
    )


def uncertainty_from(text: str) -> tuple[Uncertainty, ...]:
    """What a text holds. Raises SimcError."""
    found = []
    for part in text.split("!"):
        structure, *rest = part.split("~")
        checks.one_of("structure", structure, STRUCTURES)
        try:
            freedom, *numbers = (float(each) for each in rest)
        except ValueError:
            raise SimcError(
                said("uncertainty of {structure} is made of numbers separated by ~", structure=structure)
            ) from None
        m = 1 + len(STRUCTURES[structure].lags) + len(STRUCTURES[structure].gains)
        found.append(Uncertainty(structure, tuple(numbers[:m]), tuple(numbers[m:]), freedom))
    return tuple(found)


def _numbers(each: Uncertainty) -> tuple[float, ...]:
    return (each.freedom, *each.values, *each.covariance)


def bad_text(bad: tuple[tuple[float, float], ...]) -> str:
    """from~to, separated by !."""
    return "!".join(f"{low!r}~{high!r}" for low, high in bad)


def bad_of(text: str) -> tuple[tuple[float, float], ...]:
    """The stretches of a text. Raises SimcError."""
    try:
        pairs = [tuple(float(each) for each in part.split("~")) for part in text.split("!")]
    except ValueError:
        raise SimcError(said("bad stretches are pairs of numbers, from~to, separated by !")) from None
    if not all(len(pair) == 2 for pair in pairs):
        raise SimcError(said("bad stretches are pairs of numbers, from~to, separated by !"))
    return tuple((pair[0], pair[1]) for pair in pairs)
