"""Is u defined at all? Without dead time the loop answers itself at once, through L(inf): 1 + L(inf) must not be 0.

Everything that works on a loop without dead time asks here, so that all refuse the same loops in the same words.
"""

from simc_core.errors import InvalidParameter
from simc_core.wording import said

ZERO = 1e-12  # |1 + L(inf)| up to which rounding cannot tell it from 0


def is_well_posed(one_plus_L: float) -> bool:
    """Whether 1 + L(inf) is not 0, for a loop without dead time."""
    return abs(one_plus_L) > ZERO


def require_well_posed(one_plus_L: float) -> None:
    """Raises InvalidParameter where 1 + L(inf) is 0, for a loop without dead time."""
    if not is_well_posed(one_plus_L):
        raise InvalidParameter(said("1 + L(inf) must not be 0 in a loop without dead time, found 0: u is not defined"))
