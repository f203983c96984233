"""A plant in plain words, to be shown beside the field it was typed in, so that a slip is seen at once."""

from collections.abc import Iterable
from itertools import groupby

from simc_core.notation import number
from simc_core.plants.plant import Plant

DIGITS = 6  # enough to see every slip of a comma or a digit
INTEGRATORS = ("", "integrator", "double integrator", "triple integrator", "fourfold integrator")


def read_back(plant: Plant) -> str:
    """What a plant consists of, in words.

    Parameters
    ----------
    plant : Plant
        Any plant.

    Returns
    -------
    str
        For instance "gain 2.2, lags 180 and 5, dead time 20": plain text, times in the user's own unit. The gain is
        that of G(s) s^n with n integrators; a negative time constant is that of tau s + 1.

    Examples
    --------
    >>> from simc_core import Plant, read_back
    >>> read_back(Plant(2.2, 20, (180, 5)))
    'gain 2.2, lags 180 and 5, dead time 20'
    """
    parts = [f"gain {_shown(plant.k)}"]
    if plant.integrators:
        parts.append(INTEGRATORS[plant.integrators])
    parts += _times("lag", [tau for tau in plant.lags if tau > 0])
    parts += _times("unstable lag", [tau for tau in plant.lags if tau < 0])
    parts += _pairs("pair", [pair for pair in plant.lag_pairs if pair[1] >= 0])
    parts += _pairs("unstable pair", [pair for pair in plant.lag_pairs if pair[1] < 0])
    parts += _times("lead", [tau for tau in plant.leads if tau > 0])
    parts += _times("inverse response lead", [tau for tau in plant.leads if tau < 0])
    parts += _pairs("numerator pair", plant.lead_pairs)
    parts.append(f"dead time {_shown(plant.theta)}" if plant.theta else "no dead time")
    return ", ".join(parts)


def _times(name: str, times: list[float]) -> list[str]:
    if not times:
        return []
    return [f"{name}{'s' if len(times) > 1 else ''} {_listed(map(_shown, times))}"]


def _pairs(name: str, pairs: Iterable[tuple[float, float]]) -> list[str]:
    shown = [f"tau {_shown(tau)} zeta {_shown(zeta)}" for tau, zeta in pairs]
    return [f"{name}{'s' if len(shown) > 1 else ''} {_listed(shown)}"] if shown else []


def _listed(words: Iterable[str]) -> str:
    """10, 6 and 1; the same one several times in a row as 6 (3 times)."""
    counted = [(word, len(list(group))) for word, group in groupby(words)]
    shown = [word if count == 1 else f"{word} ({count} times)" for word, count in counted]
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"


def _shown(value: float) -> str:
    return number(value, DIGITS)
