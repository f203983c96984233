"""A plant in plain words, to be shown beside the field it was typed in, so that a slip is seen at once."""

from collections.abc import Iterable
from itertools import groupby

from simc_core.notation import number
from simc_core.plants.plant import Plant
from simc_core.wording import Numeral, Text, counted, joined, said

DIGITS = 6  # enough to see every slip of a comma or a digit
INTEGRATORS = (said("integrator"), said("double integrator"), said("triple integrator"), said("fourfold integrator"))


def read_back(plant: Plant) -> Text:
    """What a plant consists of, in words.

    Parameters
    ----------
    plant : Plant
        Any plant.

    Returns
    -------
    Text
        For instance "gain 2.2, lags 180 and 5, dead time 20": plain text, times in the user's own unit. The gain is
        that of G(s) s^n with n integrators; a negative time constant is that of tau s + 1.

    Examples
    --------
    >>> from simc_core import Plant, read_back
    >>> read_back(Plant(2.2, 20, (180, 5)))
    'gain 2.2, lags 180 and 5, dead time 20'
    """
    parts: list[Text] = [said("gain {k}", k=_shown(plant.k))]
    if plant.integrators:
        parts.append(INTEGRATORS[plant.integrators - 1])
    found = (
        (_lags, [_shown(tau) for tau in plant.lags if tau > 0]),
        (_unstable_lags, [_shown(tau) for tau in plant.lags if tau < 0]),
        (_pairs, [_pair(*pair) for pair in plant.lag_pairs if pair[1] >= 0]),
        (_unstable_pairs, [_pair(*pair) for pair in plant.lag_pairs if pair[1] < 0]),
        (_leads, [_shown(tau) for tau in plant.leads if tau > 0]),
        (_inverse_leads, [_shown(tau) for tau in plant.leads if tau < 0]),
        (_numerator_pairs, [_pair(*pair) for pair in plant.lead_pairs]),
    )
    parts += [named(len(shown), _listed(shown)) for named, shown in found if shown]
    parts.append(said("dead time {theta}", theta=_shown(plant.theta)) if plant.theta else said("no dead time"))
    return joined(parts)


def _lags(n: int, times: str) -> Text:
    return counted("lag {times}", "lags {times}", n, times=times)


def _unstable_lags(n: int, times: str) -> Text:
    return counted("unstable lag {times}", "unstable lags {times}", n, times=times)


def _leads(n: int, times: str) -> Text:
    return counted("lead {times}", "leads {times}", n, times=times)


def _inverse_leads(n: int, times: str) -> Text:
    return counted("inverse response lead {times}", "inverse response leads {times}", n, times=times)


def _pairs(n: int, pairs: str) -> Text:
    return counted("pair {pairs}", "pairs {pairs}", n, pairs=pairs)


def _unstable_pairs(n: int, pairs: str) -> Text:
    return counted("unstable pair {pairs}", "unstable pairs {pairs}", n, pairs=pairs)


def _numerator_pairs(n: int, pairs: str) -> Text:
    return counted("numerator pair {pairs}", "numerator pairs {pairs}", n, pairs=pairs)


def _pair(tau: float, zeta: float) -> Text:
    return said("tau {tau} zeta {zeta}", tau=_shown(tau), zeta=_shown(zeta))


def _listed(words: Iterable[str]) -> str:
    """10, 6 and 1; the same one several times in a row as 6 (3 times)."""
    runs = [(word, len(list(group))) for word, group in groupby(words)]
    shown = [word if n == 1 else counted("{word} (once)", "{word} ({n} times)", n, word=word) for word, n in runs]
    return shown[0] if len(shown) == 1 else said("{some} and {last}", some=joined(shown[:-1]), last=shown[-1])


def _shown(value: float) -> Numeral:
    return number(value, DIGITS)
