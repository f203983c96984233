"""What fitted structures and their parameters are called, and what is told of a plant that was identified."""

from pages.common.parts.foreign_text import exact
from pages.common.parts.symbols import SYMBOLS
from pages.common.session.record import PARAMETERS, Origin
from simc_core.notation import number

TITLES = {
    "FOPDT": "First order",
    "SOPDT": "Second order",
    "IPDT": "Integrating",
    "IPDT_lag": "Integrating with lag",
    "inverse": "With a zero",
    "oscillating": "Oscillating",
    "DIPDT": "Double integrating",
    "unstable": "Unstable",
}
SIGNS = {"k_prime": "k'", "k_double_prime": "k''"}


def sign_of(parameter: str) -> str:
    """A parameter as a reader of a page knows it: tau1 as τ₁."""
    return SIGNS.get(parameter) or SYMBOLS.get(parameter, parameter)


def told_of(origin: Origin) -> str:
    """Markdown: from what the plant was identified, how well it fits, and its standard errors."""
    source = f" from {exact(origin.source)}" if origin.source else ""
    names = PARAMETERS[origin.structure]
    errors = ", ".join(f"{sign_of(name)} {number(error, 2)}" for name, error in zip(names, origin.errors, strict=True))
    title = TITLES[origin.structure].lower()
    return (
        f"Identified{source}: {title}, fit {100 * origin.fit:.1f} %, {origin.samples} samples. "
        f"Standard errors: {errors}."
    )


def gains_apart(origin: Origin) -> str:
    """A warning: moves of OP do not show the one gain that was fitted to all of them."""
    low, high = (number(each, 3) for each in origin.gains)
    return (
        f"**Gains differ.** Moves of OP in the record show gains of {low} and {high}; this plant has one for all of "
        "them. *Tune for the larger, or fit each operating point on the page From data and make a gain schedule.*"
    )
