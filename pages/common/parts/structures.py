"""What fitted structures and their parameters are called, and what is told of a plant that was identified."""

from pages.common.parts.foreign_text import exact
from pages.common.parts.symbols import SYMBOLS
from pages.common.session.record import PARAMETERS, Origin
from pages.common.words import capitalised, number, translated, words
from simc_core.wording import said

NAMES = {
    "FOPDT": said("first order"),
    "SOPDT": said("second order"),
    "IPDT": said("integrating"),
    "IPDT_lag": said("integrating with lag"),
    "inverse": said("with a zero"),
    "oscillating": said("oscillating"),
    "DIPDT": said("double integrating"),
    "unstable": said("unstable"),
}
SIGNS = {"k_prime": "k'", "k_double_prime": "k''"}


def title_of(structure: str) -> str:
    """A structure, as it is called at the beginning of a line."""
    return capitalised(translated(NAMES[structure]))


def sign_of(parameter: str) -> str:
    """A parameter as a reader of a page knows it: tau1 as τ₁."""
    return SIGNS.get(parameter) or SYMBOLS.get(parameter, parameter)


def told_of(origin: Origin) -> str:
    """Markdown: from what the plant was identified, how well it fits, and its standard errors."""
    names = PARAMETERS[origin.structure]
    errors = ", ".join(f"{sign_of(name)} {number(error, 2)}" for name, error in zip(names, origin.errors, strict=True))
    told = {"structure": NAMES[origin.structure], "fit": 100 * origin.fit, "n": origin.samples, "errors": errors}
    if not origin.source:
        return words("Identified: {structure}, fit {fit:.1f} %, {n} samples. Standard errors: {errors}.", **told)
    return words(
        "Identified from {source}: {structure}, fit {fit:.1f} %, {n} samples. Standard errors: {errors}.",
        source=exact(origin.source),
        **told,
    )


def gains_apart(origin: Origin) -> str:
    """A warning: moves of OP do not show the one gain that was fitted to all of them."""
    low, high = (number(each, 3) for each in origin.gains)
    return words(
        "**Gains differ.** Moves of OP in the record show gains of {low} and {high}; this plant has one for all of "
        "them. *Tune for the larger, or fit each operating point on the page From data and make a gain schedule.*",
        low=low,
        high=high,
    )
