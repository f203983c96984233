"""Rules that make |T(j omega)| flat at omega = 0. PI in ideal form.

    magnitude optimum [K54]     G = A0 - A1 s + A2 s^2 - A3 s^3 ...    Kc = A3/(2 (A1 A2 - A0 A3))    tau_I = A3/A2
    symmetrical optimum [K54]   G = k'/(s (tau s + 1))                 Kc = 1/(2 k' tau)              tau_I = 4 tau
    Schaedel PI [SCH97]         1/G = (1 + T1 s + T2^2 s^2 ...)/k      Kc = TN/(2 k (T1 - TN))        tau_I = TN
                                TN = T1 - T2^2/T1

The German names are Betragsoptimum and symmetrisches Optimum.
"""

from simc_core.controllers.forms import IdealPid
from simc_core.errors import OutOfDomain
from simc_core.plants.plant import Plant
from simc_core.plants.taylor import taylor
from simc_core.rules.domain import kind_of, positive
from simc_core.rules.self_regulating import self_regulating
from simc_core.wording import said


def magnitude_optimum(plant: Plant, kind: str = "PI") -> IdealPid:
    """The first two derivatives of |T|^2 with respect to omega^2 vanish at 0. For self-regulating plants. [K54]"""
    rule = said("magnitude optimum")
    kind_of(kind, ("PI",), rule)
    A = taylor(self_regulating(plant, rule), 4) * (1, -1, 1, -1) / plant.k
    below = positive("A1 A2 - A0 A3", float(A[1] * A[2] - A[0] * A[3]), rule)
    A2, A3 = positive("A2", float(A[2]), rule), positive("A3", float(A[3]), rule)
    return IdealPid(A3 / (2 * below * plant.k), A3 / A2)


def symmetrical_optimum(plant: Plant, kind: str = "PI") -> IdealPid:
    """tau is the sum of all small times: lags and dead time less zeros. For plants with one integrator. [K54]"""
    rule = said("symmetrical optimum")
    kind_of(kind, ("PI",), rule)
    if plant.integrators != 1:
        raise OutOfDomain(
            said(
                "integrators must be 1 for the rule {rule}, found {integrators}",
                rule=rule,
                integrators=plant.integrators,
            )
        )
    rest = Plant(plant.k, plant.theta, plant.lags, plant.leads, 0, plant.lag_pairs, plant.lead_pairs)
    k, slope = taylor(self_regulating(rest, rule), 2)
    tau = positive("tau", float(-slope / k), rule)
    return IdealPid(1 / (2 * float(k) * tau), 4 * tau)


def schaedel(plant: Plant, kind: str = "PI") -> IdealPid:
    """For self-regulating plants with real poles, PI. [SCH97]"""
    rule = said("Schaedel PI")
    kind_of(kind, ("PI",), rule)
    _, a1, a2 = taylor(self_regulating(plant, rule), 3) / plant.k
    T1 = positive("T1", float(-a1), rule)
    T2_squared = positive("T2^2", float(a1 * a1 - a2), rule)
    TN = positive("T1 - T2^2/T1", T1 - T2_squared / T1, rule)
    return IdealPid(TN / (2 * plant.k * (T1 - TN)), TN)
