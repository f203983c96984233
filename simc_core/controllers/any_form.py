"""What a controller can do whatever its form: settings by name, change of form and of units, its transfer functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from simc_core.algebra.factors import Factored
from simc_core.controllers.in_factors import parallel_factors
from simc_core.errors import FormError

if TYPE_CHECKING:
    from simc_core.controllers.forms import Controller, IdealPid, ParallelPid, SeriesPid


@dataclass(frozen=True, slots=True)
class AnyForm:
    """What all forms share, by way of the parallel one."""

    SETTINGS: ClassVar[tuple[str, ...]]  # names of what is set in this form
    OPTIONAL: ClassVar[tuple[str, ...]] = ("tau_F", "b", "c")  # filter and weights, which come on top

    @property
    def settings(self) -> dict[str, float]:
        """The settings of this form by name, filter and weights apart."""
        return {name: getattr(self, name) for name in self.SETTINGS}

    @property
    def action(self) -> str:
        """reverse, where the output falls when the measurement rises, or direct: by the sign of the gain."""
        form = self.to_parallel()
        return "reverse" if (form.Kp or form.Ki or form.Kd) > 0 else "direct"

    @property
    def derivative(self) -> bool:
        """Whether it has derivative action."""
        return any(getattr(self, name) for name in self.SETTINGS if name in ("tau_D", "Kd"))

    def in_form(self, form: str) -> Controller:
        """The same controller in one of FORMS; pure integral action stays what it is. Raises FormError."""
        forms: dict[str, Callable[[], Controller]] = {
            "series": self.to_series,
            "ideal": self.to_ideal,
            "parallel": self.to_parallel,
        }
        return forms[form]()

    def has_form(self, form: str) -> bool:
        """Whether `in_form` has an answer."""
        try:
            self.in_form(form)
        except FormError:
            return False
        return True

    def rescaled(self, time: Fraction = Fraction(1), gain: float = 1.0) -> Self:
        """The same controller in other units.

        Parameters
        ----------
        time : Fraction
            Times are multiplied by it: 1/60 from seconds to minutes.
        gain : float
            The gain of the controller is multiplied by it: 1/g for a plant whose gain is multiplied by g.

        Returns
        -------
        Controller
            In the same form, weights unchanged.
        """
        power = {"Kc": 0, "Kp": 0, "tau_I": 1, "tau_D": 1, "tau_F": 1, "Ki": -1, "K_I": -1, "Kd": 1}
        values: dict[str, float] = {}
        for name in (*self.SETTINGS, *(name for name in self.OPTIONAL if name in power)):
            value = getattr(self, name) * (1.0 if name.startswith("tau") else gain)
            ratio = time ** power[name]
            values[name] = value * ratio.numerator / ratio.denominator
        return replace(self, **values)

    def response(self, s: ArrayLike) -> np.ndarray:
        """C(s) of the feedback path, from -y to u; any shape of s."""
        return self.factored(s)

    def setpoint_response(self, s: ArrayLike) -> np.ndarray:
        """Transfer function from r to u, (b Kp + Ki/s + c Kd s)/(tau_F s + 1); any shape of s."""
        return self.setpoint_factored(s)

    @property
    def factored(self) -> Factored:
        """Feedback path as the engine sees it."""
        raise NotImplementedError

    def to_series(self) -> SeriesPid:
        """The same controller in series form."""
        raise NotImplementedError

    def to_ideal(self) -> IdealPid:
        """The same controller in ideal form."""
        raise NotImplementedError

    def to_parallel(self) -> ParallelPid:
        """The same controller in parallel form."""
        raise NotImplementedError

    @property
    def setpoint_factored(self) -> Factored:
        """Set-point path as the engine sees it."""
        form = self.to_parallel()
        return parallel_factors(form.b * form.Kp, form.Ki, form.c * form.Kd, form.tau_F)
