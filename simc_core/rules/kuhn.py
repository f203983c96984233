"""Kuhn's T-sum rule: for processes that come to rest with many lags, from their sum alone [K95]. Ideal form.

TS = theta + lags - zeros, the area over the step response divided by k
usual   PI 0.5/k, 0.5 TS     PID 1/k, 0.66 TS, 0.167 TS
fast    PI 1/k, 0.7 TS       PID 2/k, 0.8 TS, 0.194 TS
"""

from simc_core.controllers.forms import IdealPid
from simc_core.plants.plant import Plant
from simc_core.plants.taylor import taylor
from simc_core.rules.domain import kind_of, positive
from simc_core.rules.self_regulating import self_regulating
from simc_core.wording import said


def kuhn(plant: Plant, kind: str = "PI") -> IdealPid:
    """The usual settings. [K95]"""
    k, TS = _gain_and_sum(plant, kind, said("Kuhn"))
    return IdealPid(0.5 / k, 0.5 * TS) if kind == "PI" else IdealPid(1 / k, 0.66 * TS, 0.167 * TS)


def kuhn_fast(plant: Plant, kind: str = "PI") -> IdealPid:
    """The fast settings. [K95]"""
    k, TS = _gain_and_sum(plant, kind, said("Kuhn, fast"))
    return IdealPid(1 / k, 0.7 * TS) if kind == "PI" else IdealPid(2 / k, 0.8 * TS, 0.194 * TS)


def _gain_and_sum(plant: Plant, kind: str, rule: str) -> tuple[float, float]:
    kind_of(kind, ("PI", "PID"), rule)
    k, slope = taylor(self_regulating(plant, rule), 2)
    return float(k), positive("T-sum", float(-slope / k), rule)
