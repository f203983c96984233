"""How much work a march may take, in elements: 20 us each, and 9 kB with all that is made of it afterwards.

A march holds the elements of all its tunings until it has arrived. Before it begins it is known what the first
intervals of the dead time take, and only so many tunings begin together as these allow; how far the rest is from there
is not known, so a march that reaches the bound on its way goes on with half of its tunings and leaves the others to
the next one.
"""

import math

from simc_core.certificate.poles import dominant_poles
from simc_core.loops.loop import Loop
from simc_core.wording import said

MOST_HELD = 12_000  # elements of all tunings of one march: 110 MB
MOST_TOGETHER = 120  # tunings, or loops of a list, in one march; more do not make it faster
MOST_TO_END, MOST_TO_REST = 12_000, 6_000  # elements of one tuning
MOST_OF_ALL = 100_000  # elements of all tunings of one call: 2 s
LEAST_SHARE = 300  # elements of one tuning on its way to rest, however many there are
LOOK = 150  # elements after which the poles of a loop that has not arrived are asked how far it is
RADIANS = 8.0  # of an oscillation on one element
LIKELY = 4.0  # times the least number of elements that an oscillation takes
DECAY, GROWTH = 7.0, 300.0  # nepers; an oscillation begins with at least 1e-8 of the largest value, it is assumed


def together(elements: int) -> int:
    """Tunings that may begin together where the first intervals take so many elements of each."""
    return max(1, min(MOST_TOGETHER, MOST_HELD // max(2 * elements, 1)))


def share(tunings: int) -> int:
    """Elements that each of so many tunings may take to come to rest."""
    return min(MOST_TO_REST, max(LEAST_SHARE, MOST_OF_ALL // tunings))


def too_much(t_end: float) -> str:
    """What to say where all tunings of one call would take more than MOST_OF_ALL."""
    return said(
        "all responses up to t = {t_end:.4g} must need at most {most_of_all} elements together, found more: they "
        "oscillate too long; ask for fewer or shorter ones",
        t_end=t_end,
        most_of_all=MOST_OF_ALL,
    )


def oscillation(loop: Loop) -> tuple[float, float]:
    """Elements per time that the longest lived oscillation of the loop takes at least, and for how long it does.

    An element resolves at most RADIANS of it, until it has decayed by DECAY, or grown by GROWTH.
    """
    found = [pole.s for pole in dominant_poles(loop) if pole.s.imag]
    lasting = [(s.imag / RADIANS, (DECAY if s.real < 0 else GROWTH) / abs(s.real)) for s in found if s.real]
    return max(lasting, key=math.prod, default=(0.0, 0.0))
