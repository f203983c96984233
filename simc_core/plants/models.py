"""The reduced models that SIMC has a rule for. Each is a small plant with a name.

Gains: k is the steady-state gain, k_prime the slope of an integrating response (lim s G(s)),
k_double_prime the curvature of a double integrating one.
"""

from dataclasses import dataclass, fields

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.plants.plant import Plant
from simc_core.wording import said


@dataclass(frozen=True, slots=True)
class _Model:
    """Bounds by field name, checked at construction."""

    def __post_init__(self) -> None:
        for field in fields(self):
            value = _CHECKS[field.name](field.name, getattr(self, field.name))
            object.__setattr__(self, field.name, value)

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        raise NotImplementedError


_CHECKS = {
    "k": checks.gain,
    "k_prime": checks.gain,
    "k_double_prime": checks.gain,
    "theta": checks.optional_time,
    "tau1": checks.optional_time,
    "tau2": checks.optional_time,
    "a": checks.positive_time,
    "tau0": checks.positive_time,
    "zeta": lambda name, value: checks.real(name, value, 0.0, 10.0),
}


def _lags(*times: float) -> tuple[float, ...]:
    return tuple(tau for tau in times if tau)


@dataclass(frozen=True, slots=True)
class FirstOrderDelay(_Model):
    """k e^{-theta s}/(tau1 s + 1); tau1 = 0 is pure dead time.

    Parameters
    ----------
    k : float
        Steady-state gain, in output units per input unit.
    theta, tau1 : float
        Dead time and time constant >= 0, in the user's time unit.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay
    >>> FirstOrderDelay(k=1, theta=1, tau1=8).plant.lags
    (8.0,)
    """

    k: float
    theta: float
    tau1: float

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return Plant(self.k, self.theta, _lags(self.tau1))


@dataclass(frozen=True, slots=True)
class SecondOrderDelay(_Model):
    """k e^{-theta s}/((tau1 s + 1)(tau2 s + 1)), tau1 >= tau2.

    Parameters
    ----------
    k : float
        Steady-state gain, in output units per input unit.
    theta, tau1, tau2 : float
        Dead time and time constants >= 0, in the user's time unit.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds, or tau2 > tau1.

    Examples
    --------
    SIMC makes it a PID with tau_D = tau2 [SK03]:

    >>> from simc_core import SecondOrderDelay, simc
    >>> simc(SecondOrderDelay(k=1, theta=1, tau1=8, tau2=2)).tau_D
    2.0
    """

    k: float
    theta: float
    tau1: float
    tau2: float

    def __post_init__(self) -> None:
        _Model.__post_init__(self)
        if self.tau2 > self.tau1:
            raise InvalidParameter(
                said("tau2 must be <= tau1 = {tau1:g}, found {tau2:g}", tau1=self.tau1, tau2=self.tau2)
            )

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return Plant(self.k, self.theta, _lags(self.tau1, self.tau2))


@dataclass(frozen=True, slots=True)
class IntegratingDelay(_Model):
    """k' e^{-theta s}/(s (tau2 s + 1)).

    Parameters
    ----------
    k_prime : float
        Slope of the response to a unit step, in output units per input unit and time.
    theta, tau2 : float
        Dead time and time constant >= 0, in the user's time unit.

    Examples
    --------
    SIMC has Kc = 1/(2 k' theta) and tau_I = 8 theta for tau_c = theta [SK03]:

    >>> from simc_core import IntegratingDelay, simc
    >>> pi = simc(IntegratingDelay(k_prime=0.1, theta=1))
    >>> pi.Kc, pi.tau_I
    (5.0, 8.0)
    """

    k_prime: float
    theta: float
    tau2: float = 0.0

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return Plant(self.k_prime, self.theta, _lags(self.tau2), integrators=1)


@dataclass(frozen=True, slots=True)
class DoubleIntegratingDelay(_Model):
    """k'' e^{-theta s}/s^2.

    Parameters
    ----------
    k_double_prime : float
        Curvature of the response to a unit step, in output units per input unit and time squared.
    theta : float
        Dead time >= 0, in the user's time unit.

    Examples
    --------
    SIMC is a series PID with tau_I = tau_D = 8 theta for tau_c = theta [SK03]:

    >>> from simc_core import DoubleIntegratingDelay, simc
    >>> pid = simc(DoubleIntegratingDelay(k_double_prime=1, theta=1))
    >>> pid.tau_I, pid.tau_D
    (8.0, 8.0)
    """

    k_double_prime: float
    theta: float

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return Plant(self.k_double_prime, self.theta, integrators=2)


@dataclass(frozen=True, slots=True)
class UnstableDelay(_Model):
    """k' e^{-theta s}/((s - a)(tau2 s + 1)), a > 0 [SK98 eq. 23].

    Parameters
    ----------
    k_prime : float
        Gain, in output units per input unit and time.
    theta, tau2 : float
        Dead time and time constant >= 0, in the user's time unit.
    a : float
        The unstable pole > 0, in rad per time unit.

    Examples
    --------
    >>> from simc_core import UnstableDelay
    >>> UnstableDelay(k_prime=1, theta=0.2, a=0.5).plant.poles.real.tolist()
    [0.5]
    """

    k_prime: float
    theta: float
    a: float
    tau2: float = 0.0

    @property
    def plant(self) -> Plant:
        """The model as a plant: k'/(s - a) = (-k'/a)/(-s/a + 1)."""
        return Plant(-self.k_prime / self.a, self.theta, (-1 / self.a, *_lags(self.tau2)))


@dataclass(frozen=True, slots=True)
class OscillatingDelay(_Model):
    """k e^{-theta s}/(tau0^2 s^2 + 2 zeta tau0 s + 1), zeta >= 0.

    Parameters
    ----------
    k : float
        Steady-state gain, in output units per input unit.
    theta : float
        Dead time >= 0, in the user's time unit.
    tau0 : float
        Inverse of the undamped natural frequency, > 0, in the user's time unit.
    zeta : float
        Damping, 0 to 10.

    Examples
    --------
    >>> from simc_core import OscillatingDelay
    >>> OscillatingDelay(k=1, theta=1, tau0=2, zeta=0.1).plant.lag_pairs
    ((2.0, 0.1),)
    """

    k: float
    theta: float
    tau0: float
    zeta: float

    @property
    def plant(self) -> Plant:
        """The model as a plant."""
        return Plant(self.k, self.theta, lag_pairs=((self.tau0, self.zeta),))


Model = (
    FirstOrderDelay | SecondOrderDelay | IntegratingDelay | DoubleIntegratingDelay | UnstableDelay | OscillatingDelay
)
