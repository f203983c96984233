"""SIMC settings [SK03 Table 1; SK98 eq. 23-24; V06 Tables 1-2], one rule per model.

    series form  C(s) = Kc (tau_I s + 1)/(tau_I s) (tau_D s + 1),   q = tau_c + theta

    k e^{-theta s}                              I only: K_I = 1/(k q)
    k e^{-theta s}/(tau1 s+1)                   Kc = tau1/(k q)      tau_I = min(tau1, 4 q)
    k e^{-theta s}/((tau1 s+1)(tau2 s+1))       the same, tau_D = tau2
    k' e^{-theta s}/(s (tau2 s+1))              Kc = 1/(k' q)        tau_I = 4 q     tau_D = tau2
    k'' e^{-theta s}/s^2                        Kc = 1/(4 k'' q^2)   tau_I = 4 q     tau_D = 4 q
    k' e^{-theta s}/((s-a)(tau2 s+1))           Kc = 0.5/(k' theta)  tau_I = 8 theta f  tau_D = tau2; tau_c = theta only
    k e^{-theta s}/(tau0^2 s^2 + 2 zeta tau0 s + 1)
                                    IDEAL form: Kc = 2 zeta tau0/(k q)   tau_I = 2 zeta tau0   tau_D = tau0/(2 zeta)

tau_c, the closed-loop time constant, is the only tuning parameter; tau_c = theta is "tight".
"""

import math

from simc_core import checks
from simc_core.controllers.forms import IController, IdealPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.wording import said

TIGHT = said("tight")
A_THETA_LIMIT = 0.5  # the rule for unstable poles ends here; the plant itself can be stabilised up to a theta = 1
MULTIPLES = (1.0, 1.5, 2.0, 3.0)
SAME_TAU_C = 1e-6  # relative; a tau_c that came through a link's decimal text still counts as theta


def simc(model: Model, tau_c: float | None = None) -> SeriesPid | IdealPid | IController:
    """SIMC settings of `model`; the module docstring has the table.

    Parameters
    ----------
    model : Model
        Reduced model, as `half_rule` makes it.
    tau_c : float, optional
        Closed-loop time constant, > 0, in the user's time unit. None: theta, the tight choice.

    Returns
    -------
    SeriesPid, IdealPid or IController
        Ideal for an oscillating model, integral action only for pure dead time, series for all others.

    Raises
    ------
    InvalidParameter
        tau_c <= 0 or not above -theta; tau_c=None for a model without dead time; and where the rule of the model ends
        (a theta >= 0.5, undamped oscillation).

    References
    ----------
    [SK03 Table 1], [SK98 eq. 23-24] for unstable models, [V06].

    Examples
    --------
    The first example of [V06] prints Kc = 0.57 and tau_I = 8:

    >>> from simc_core import FirstOrderDelay, simc
    >>> pi = simc(FirstOrderDelay(k=1, theta=7, tau1=8))
    >>> round(pi.Kc, 2), pi.tau_I
    (0.57, 8.0)
    """
    if not isinstance(model, Model):
        raise InvalidParameter(
            said("model must be a reduced model, as half_rule makes it, found {kind}", kind=type(model).__name__)
        )
    if isinstance(model, UnstableDelay):
        return _unstable(model, tau_c)
    q = _tau_c(model.theta, tau_c) + model.theta
    match model:
        case FirstOrderDelay(k, _, tau1):
            return _stable(k, tau1, 0.0, q)
        case SecondOrderDelay(k, _, tau1, tau2):
            return _stable(k, tau1, tau2, q)
        case IntegratingDelay(k_prime, _, tau2):
            return SeriesPid(1 / (k_prime * q), 4 * q, tau2)
        case DoubleIntegratingDelay(k_double_prime, _):
            return SeriesPid(1 / (4 * k_double_prime * q**2), 4 * q, 4 * q)
        case _:
            return _oscillating(model, q)


def tau_c_presets(model: Model) -> dict[str, float]:
    """Named choices of tau_c: tight, aggressive, moderate, conservative.

    tight is theta [SK03]. The others are those of Arbogast, Cooper and Rice: aggressive max(0.1 tau1, 0.8 theta),
    moderate max(tau1, 8 theta), conservative max(10 tau1, 80 theta) [V06 eq. 7].

    Parameters
    ----------
    model : Model
        Reduced model. tau1 counts as 0 for integrating models.

    Returns
    -------
    dict of str to float
        In the user's time unit. Choices that would be 0 are left out; an unstable model has the tight one only.

    References
    ----------
    [SK03], [V06 eq. 7]. What [V06] prints there is a misprint, see docs/theory.md.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay, tau_c_presets
    >>> tau_c_presets(FirstOrderDelay(k=1, theta=1, tau1=20))
    {'tight': 1.0, 'aggressive': 2.0, 'moderate': 20.0, 'conservative': 200.0}
    """
    if isinstance(model, UnstableDelay):
        return {TIGHT: model.theta} if model.theta else {}
    match model:
        case FirstOrderDelay() | SecondOrderDelay():
            tau1 = model.tau1
        case OscillatingDelay():
            tau1 = model.tau0
        case _:
            tau1 = 0.0
    presets = {
        TIGHT: model.theta,
        said("aggressive"): max(0.1 * tau1, 0.8 * model.theta),
        said("moderate"): max(tau1, 8 * model.theta),
        said("conservative"): max(10 * tau1, 80 * model.theta),
    }
    return {name: tau_c for name, tau_c in presets.items() if tau_c > 0}


def default_tau_c(model: Model) -> float:
    """tau_c where none is given: tight; for a model without dead time the first choice there is, else 1."""
    return model.theta or next(iter(tau_c_presets(model).values()), 1.0)


def tau_c_multiples(model: Model) -> dict[float, float]:
    """Choices of tau_c that engineers use: 1, 1.5, 2 and 3 theta, by their factor.

    Without dead time there are none; an unstable model has theta alone.
    """
    if not model.theta:
        return {}
    factors = (1.0,) if isinstance(model, UnstableDelay) else MULTIPLES
    return {factor: factor * model.theta for factor in factors}


def unstable_factor(a_theta: float) -> float:
    """f(a theta) = (1 + a theta/(2 (1 - 2 a theta)))/(1 - 2 a theta) [SK98 eq. 24], 0 <= a theta < 0.5."""
    a_theta = checks.real("a theta", a_theta, low=0.0)
    if a_theta >= A_THETA_LIMIT:
        raise InvalidParameter(
            said(
                "a theta must be < {a_theta_limit:g} for the SIMC rule of an unstable pole, found {a_theta:g}: "
                "the dead time is too long for it",
                a_theta_limit=A_THETA_LIMIT,
                a_theta=a_theta,
            )
        )
    rest = 1 - 2 * a_theta
    return (1 + a_theta / (2 * rest)) / rest


def _tau_c(theta: float, tau_c: float | None) -> float:
    """tau_c checked; None becomes theta."""
    if tau_c is None:
        if theta == 0:
            raise InvalidParameter(said("tau_c must be given for a model without dead time (theta = 0), found None"))
        return theta
    number = checks.real("tau_c", tau_c, high=checks.LONGEST_TIME)
    if number <= -theta < 0:
        raise InvalidParameter(
            said(
                "tau_c must be > 0, and above -theta = {theta:g} in any case, found {number:g}",
                theta=-theta,
                number=number,
            )
        )
    if number <= 0:
        raise InvalidParameter(said("tau_c must be > 0, found {number:g}", number=number))
    return checks.positive_time("tau_c", number)


def _stable(k: float, tau1: float, tau2: float, q: float) -> SeriesPid | IController:
    if tau1 == 0:
        return IController(1 / (k * q))
    return SeriesPid(tau1 / (k * q), min(tau1, 4 * q), tau2)


def _oscillating(model: OscillatingDelay, q: float) -> IdealPid:
    if model.zeta == 0:
        raise InvalidParameter(
            said(
                "zeta must be > 0 for the SIMC rule, found 0: it cancels the poles, and undamped ones would ring"
                " for ever; damp them by an inner loop first (cascade)"
            )
        )
    twice = 2 * model.zeta
    return IdealPid(twice * model.tau0 / (model.k * q), twice * model.tau0, model.tau0 / twice)


def _unstable(model: UnstableDelay, tau_c: float | None) -> SeriesPid:
    if model.theta == 0:
        raise InvalidParameter(
            said("theta must be > 0 for the SIMC rule of an unstable pole (Kc = 0.5/(k' theta)), found 0")
        )
    if tau_c is not None and not math.isclose(
        checks.real("tau_c", tau_c), model.theta, rel_tol=SAME_TAU_C, abs_tol=0.0
    ):
        raise InvalidParameter(
            said(
                "tau_c must be theta = {theta:g} for an unstable pole, found {tau_c:g}: the rule knows no other",
                theta=model.theta,
                tau_c=tau_c,
            )
        )
    f = unstable_factor(model.a * model.theta)
    return SeriesPid(0.5 / (model.k_prime * model.theta), 8 * model.theta * f, model.tau2)
