"""PID controllers as types, one per form; the form can never be mistaken.

    series     C(s) = Kc (tau_I s + 1)/(tau_I s) (tau_D s + 1)/(tau_F s + 1)
    ideal      C(s) = Kc (1 + 1/(tau_I s) + tau_D s)/(tau_F s + 1)
    parallel   C(s) = (Kp + Ki/s + Kd s)/(tau_F s + 1)
    I only     C(s) = K_I/s

Two degrees of freedom: b and c weigh the set point in the parallel representation,

    u = [Kp (b r - y) + Ki (r - y)/s + Kd s (c r - y)]/(tau_F s + 1).

Conversions [SG12 sect. 5.2]: series -> ideal with f = 1 + tau_D/tau_I: Kc' = f Kc, tau_I' = f tau_I,
tau_D' = tau_D/f. Back only if tau_I' >= 4 tau_D': f = (1 + sqrt(1 - 4 tau_D'/tau_I'))/2.
"""

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from simc_core import checks
from simc_core.algebra.factors import Factored, factors
from simc_core.controllers.any_form import AnyForm
from simc_core.controllers.in_factors import parallel_factors, series_factors
from simc_core.errors import FormError, InvalidParameter
from simc_core.wording import said

FORMS = ("series", "ideal", "parallel")
DOUBLE_ROOT = 1e-12  # tau_I' = 4 tau_D' up to rounding counts as equality


def _weights(controller: "SeriesPid | IdealPid | ParallelPid") -> None:
    put = object.__setattr__
    put(controller, "b", checks.real("b", controller.b, 0.0, 2.0))
    put(controller, "c", checks.real("c", controller.c, 0.0, 2.0))


def _standard_fields(controller: "SeriesPid | IdealPid") -> None:
    """Bounds shared by the series and the ideal form."""
    put = object.__setattr__
    put(controller, "Kc", checks.gain("Kc", controller.Kc))
    if controller.tau_I != math.inf:
        put(controller, "tau_I", checks.positive_time("tau_I", controller.tau_I))
    put(controller, "tau_D", checks.optional_time("tau_D", controller.tau_D))
    put(controller, "tau_F", checks.optional_time("tau_F", controller.tau_F))
    _weights(controller)


@dataclass(frozen=True, slots=True)
class SeriesPid(AnyForm):
    """Kc (tau_I s + 1)/(tau_I s) (tau_D s + 1)/(tau_F s + 1); tau_I = math.inf: no integral action.

    Parameters
    ----------
    Kc : float
        Gain, in input units per output unit, != 0.
    tau_I : float
        Integral time > 0, in the user's time unit.
    tau_D, tau_F : float
        Derivative time and time constant of the filter, >= 0, in the user's time unit.
    b, c : float
        Weights of the set point in P and in D, 0 to 2.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds.

    Examples
    --------
    The ideal form has f = 1 + tau_D/tau_I times Kc and tau_I [SG12 eq. 5.6]:

    >>> from simc_core import SeriesPid
    >>> SeriesPid(Kc=2, tau_I=8, tau_D=2).to_ideal().settings
    {'Kc': 2.5, 'tau_I': 10.0, 'tau_D': 1.6}
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("Kc", "tau_I", "tau_D")
    Kc: float
    tau_I: float
    tau_D: float = 0.0
    tau_F: float = 0.0
    b: float = 1.0
    c: float = 0.0

    def __post_init__(self) -> None:
        _standard_fields(self)

    @property
    def factored(self) -> Factored:
        """Feedback path as the engine sees it."""
        return series_factors(self.Kc, self.tau_I, self.tau_D, self.tau_F)

    def with_filter(self, ratio: float) -> "SeriesPid":
        """The same controller with tau_F = ratio tau_D."""
        tau_F = ratio * self.tau_D
        return self if tau_F == self.tau_F else replace(self, tau_F=tau_F)

    def with_weight(self, b: float) -> "SeriesPid":
        """The same controller with set-point weight b."""
        return replace(self, b=b)

    def to_series(self) -> "SeriesPid":
        """Itself."""
        return self

    def to_ideal(self) -> "IdealPid":
        """The same controller in ideal form [SG12 eq. 5.6]."""
        f = 1 + self.tau_D / self.tau_I
        return IdealPid(f * self.Kc, f * self.tau_I, self.tau_D / f, self.tau_F, self.b, self.c)

    def to_parallel(self) -> "ParallelPid":
        """The same controller in parallel form."""
        return self.to_ideal().to_parallel()


@dataclass(frozen=True, slots=True)
class IdealPid(AnyForm):
    """Kc (1 + 1/(tau_I s) + tau_D s)/(tau_F s + 1); tau_I = math.inf: no integral action.

    Parameters
    ----------
    Kc : float
        Gain, in input units per output unit, != 0.
    tau_I : float
        Integral time > 0, in the user's time unit.
    tau_D, tau_F : float
        Derivative time and time constant of the filter, >= 0, in the user's time unit.
    b, c : float
        Weights of the set point in P and in D, 0 to 2.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds.

    Examples
    --------
    It has a series form where tau_I >= 4 tau_D [SG12 eq. 5.7]:

    >>> from simc_core import IdealPid
    >>> IdealPid(Kc=2.5, tau_I=10, tau_D=1.6).to_series().settings
    {'Kc': 2.0, 'tau_I': 8.0, 'tau_D': 2.0}
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("Kc", "tau_I", "tau_D")
    Kc: float
    tau_I: float
    tau_D: float = 0.0
    tau_F: float = 0.0
    b: float = 1.0
    c: float = 0.0

    def __post_init__(self) -> None:
        _standard_fields(self)

    @property
    def factored(self) -> Factored:
        """Feedback path as the engine sees it, in real factors where there are any."""
        if self.tau_I >= 4 * self.tau_D:
            series = self.to_series()
            return series_factors(series.Kc, series.tau_I, series.tau_D, series.tau_F)
        return Factored(
            self.Kc / self.tau_I,
            factors((self.tau_I * self.tau_D, self.tau_I, 1.0)),
            factors((0.0, 1.0, 0.0), (0.0, self.tau_F, 1.0)),
        )

    def with_filter(self, ratio: float) -> "IdealPid":
        """The same controller with tau_F = ratio tau_D."""
        tau_F = ratio * self.tau_D
        return self if tau_F == self.tau_F else replace(self, tau_F=tau_F)

    def with_weight(self, b: float) -> "IdealPid":
        """The same controller with set-point weight b."""
        return replace(self, b=b)

    def to_series(self) -> SeriesPid:
        """The same controller in series form [SG12 eq. 5.7]; FormError if tau_I < 4 tau_D."""
        root = 1 - 4 * self.tau_D / self.tau_I
        if root < -DOUBLE_ROOT:
            raise FormError(
                said(
                    "a series form needs tau_I >= 4 tau_D = {tau_D:g}, found tau_I = {tau_I:g}: the zeros of the "
                    "controller are complex",
                    tau_D=4 * self.tau_D,
                    tau_I=self.tau_I,
                )
            )
        f = (1 + math.sqrt(max(root, 0.0))) / 2
        return SeriesPid(f * self.Kc, f * self.tau_I, self.tau_D / f, self.tau_F, self.b, self.c)

    def to_ideal(self) -> "IdealPid":
        """Itself."""
        return self

    def to_parallel(self) -> "ParallelPid":
        """The same controller in parallel form: Kp = Kc, Ki = Kc/tau_I, Kd = Kc tau_D."""
        return ParallelPid(self.Kc, self.Kc / self.tau_I, self.Kc * self.tau_D, self.tau_F, self.b, self.c)


@dataclass(frozen=True, slots=True)
class ParallelPid(AnyForm):
    """(Kp + Ki/s + Kd s)/(tau_F s + 1); not all three may be zero.

    Parameters
    ----------
    Kp, Ki, Kd : float
        Gains, in input units per output unit: Ki per time unit, Kd times the time unit.
    tau_F : float
        Time constant of the filter, >= 0, in the user's time unit.
    b, c : float
        Weights of the set point in P and in D, 0 to 2.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds, or all gains are zero.

    Examples
    --------
    >>> from simc_core import ParallelPid
    >>> ParallelPid(Kp=2, Ki=0.25, Kd=4).to_ideal().settings
    {'Kc': 2.0, 'tau_I': 8.0, 'tau_D': 2.0}
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("Kp", "Ki", "Kd")
    Kp: float
    Ki: float
    Kd: float = 0.0
    tau_F: float = 0.0
    b: float = 1.0
    c: float = 0.0

    def __post_init__(self) -> None:
        put = object.__setattr__
        for name in ("Kp", "Ki", "Kd"):
            put(self, name, checks.real(name, getattr(self, name), -1e15, 1e15))
        put(self, "tau_F", checks.optional_time("tau_F", self.tau_F))
        _weights(self)
        if self.Kp == self.Ki == self.Kd == 0:
            raise InvalidParameter(said("one of Kp, Ki, Kd must not be zero, found 0, 0, 0"))

    @property
    def factored(self) -> Factored:
        """Feedback path as the engine sees it."""
        return parallel_factors(self.Kp, self.Ki, self.Kd, self.tau_F)

    def with_filter(self, ratio: float) -> "ParallelPid":
        """The same controller with tau_F = ratio Kd/Kp. Raises FormError where there is no such time."""
        return replace(self, tau_F=ratio * self.to_ideal().tau_D if self.Kd else 0.0)

    def with_weight(self, b: float) -> "ParallelPid":
        """The same controller with set-point weight b."""
        return replace(self, b=b)

    def to_series(self) -> SeriesPid:
        """The same controller in series form; FormError where there is none."""
        return self.to_ideal().to_series()

    def to_ideal(self) -> IdealPid:
        """The same controller in ideal form: Kc = Kp, tau_I = Kp/Ki, tau_D = Kd/Kp.

        Raises FormError for Kp = 0 (no ideal form) and where tau_I or tau_D would be negative.
        """
        if self.Kp == 0:
            raise FormError(
                said("an ideal form needs Kp != 0, found Kp = 0 with Ki = {Ki:g}, Kd = {Kd:g}", Ki=self.Ki, Kd=self.Kd)
            )
        if self.Ki * self.Kp < 0 or self.Kd * self.Kp < 0:
            raise FormError(
                said(
                    "an ideal form needs Kp, Ki and Kd of one sign, found {Kp:g}, {Ki:g}, {Kd:g}",
                    Kp=self.Kp,
                    Ki=self.Ki,
                    Kd=self.Kd,
                )
            )
        tau_I = self.Kp / self.Ki if self.Ki else math.inf
        return IdealPid(self.Kp, tau_I, self.Kd / self.Kp, self.tau_F, self.b, self.c)

    def to_parallel(self) -> "ParallelPid":
        """Itself."""
        return self


@dataclass(frozen=True, slots=True)
class IController(AnyForm):
    """K_I/s, the SIMC controller of pure dead time [SK03 Table 1].

    Parameters
    ----------
    K_I : float
        Gain, in input units per output unit and time, != 0.

    Examples
    --------
    K_I = 1/(k (tau_c + theta)):

    >>> from simc_core import FirstOrderDelay, IController, simc
    >>> simc(FirstOrderDelay(k=1, theta=1, tau1=0)) == IController(K_I=1 / (1 * (1 + 1)))
    True
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("K_I",)
    OPTIONAL: ClassVar[tuple[str, ...]] = ()
    K_I: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "K_I", checks.gain("K_I", self.K_I))

    @property
    def factored(self) -> Factored:
        """Feedback path as the engine sees it."""
        return parallel_factors(0.0, self.K_I, 0.0, 0.0)

    def in_form(self, form: str) -> "IController":
        """Itself in every form: it has nothing but K_I."""
        return self

    def with_filter(self, ratio: float) -> "IController":
        """Itself: pure integral action has no filter."""
        return self

    def with_weight(self, b: float) -> "IController":
        """Itself: pure integral action has no set-point weight."""
        return self

    def to_series(self) -> SeriesPid:
        """Raises FormError: a pure integrator is the limit tau_I -> 0 of a series form, not one itself."""
        raise FormError(
            said("pure integral action has no series form with tau_I > 0, found K_I = {k_i:g}", k_i=self.K_I)
        )

    def to_ideal(self) -> IdealPid:
        """Raises FormError, as to_series does."""
        raise FormError(
            said("pure integral action has no ideal form with tau_I > 0, found K_I = {k_i:g}", k_i=self.K_I)
        )

    def to_parallel(self) -> ParallelPid:
        """The same controller in parallel form: Ki = K_I, Kp = Kd = 0."""
        return ParallelPid(0.0, self.K_I)


Controller = SeriesPid | IdealPid | ParallelPid | IController
