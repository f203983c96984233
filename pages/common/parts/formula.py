"""Transfer functions, typeset to fit where they stand."""

from pages.common.words import typeset
from simc_core.notation import latex
from simc_core.plants.plant import Plant

SIZES = ((7, r"\tiny"), (5, r"\scriptsize"), (4, r"\footnotesize"))  # from this many different factors on


def fitted(plant: Plant) -> str:
    """LaTeX of the plant at the size at which its fraction still fits a column."""
    different = len({tuple(row) for row in plant.factored.den.tolist()})
    size = next((size for least, size in SIZES if different >= least), "")
    return rf"\displaystyle {size} {typeset(latex(plant))}"
