"""Settings that follow a scheduling value, and how robust they are between the rows they were made for.

Between two rows either the MODEL is interpolated and then tuned, or the settings are, with 1/Kc (the proportional band)
in the place of Kc: where the gain of the plant grows in a straight line, so must 1/Kc. Kc itself is not interpolated:
half way it would be too large. Beyond the first and the last row their settings hold.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.plants.models import Model
from simc_core.rules.domain import in_words
from simc_core.rules.simc import simc
from simc_core.sensitivity.margins import margins_many
from simc_core.wording import Numeral, Text, joined, said

MOST_ROWS = 50
POINTS = 121
TOO_HIGH = 1.1  # Ms between rows over the highest one at a row, above which a warning is due
BETWEEN = ("model", "PB")
GAIN_OF_PLANT = ("linear", "exponential")
PEAKS = {
    "linear": said(
        "Ms is {Ms:.3g} at {x:g} if the gain of the plant is linear between rows, {design:.3g} at the rows: add a row "
        "there",
        Ms=math.nan,
        x=math.nan,
        design=math.nan,
    ),
    "exponential": said(
        "Ms is {Ms:.3g} at {x:g} if the gain of the plant is exponential between rows, {design:.3g} at the rows: add a "
        "row there",
        Ms=math.nan,
        x=math.nan,
        design=math.nan,
    ),
}
FORM_OF: dict[type, str] = {
    SeriesPid: said("the series form"),
    IdealPid: said("the ideal form"),
    IController: said("pure integral action"),
}


@dataclass(frozen=True, slots=True, eq=False)
class GainSchedule:
    """A table of operating points, settings made of it, and what they do in between.

    Parameters
    ----------
    values : sequence of float, n of them
        Scheduling value of each row, increasing: set point or load rather than PV, filtered, limited in its rate.
    models : sequence of models, n of them
        The plant there, all of one kind, gains of one sign.
    rule : callable
        Settings of a model; SIMC with tau_c = theta by default.
    between : {"model", "PB"}
        What is interpolated between rows.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay, GainSchedule
    >>> rows = GainSchedule((20, 80), (FirstOrderDelay(1, 4, 20), FirstOrderDelay(5, 2, 8)))
    >>> rows.settings(20).Kc, rows.settings(80).Kc
    (2.5, 0.4)
    """

    values: Sequence[float]
    models: Sequence[Model]
    rule: Callable[[Model], Controller] = simc
    between: str = "model"

    def __post_init__(self) -> None:
        values = checks.items("values", self.values, MOST_ROWS)
        models = checks.items("models", self.models, MOST_ROWS)
        object.__setattr__(self, "values", tuple(checks.real(f"values[{i}]", x) for i, x in enumerate(values)))
        object.__setattr__(self, "models", models)
        if len(values) != len(models) or len(values) < 2:
            raise InvalidParameter(
                said(
                    "values and models must be as many, 2 at least, found {values} and {models}",
                    values=len(values),
                    models=len(models),
                )
            )
        if not all(one < other for one, other in zip(self.values, self.values[1:], strict=False)):
            raise InvalidParameter(
                said("values must increase, found {values}", values=joined([Numeral(f"{x:g}") for x in self.values]))
            )
        for i, model in enumerate(models):
            if not isinstance(model, Model) or type(model) is not type(models[0]):
                raise InvalidParameter(
                    said(
                        "models must be reduced models of one kind, found {first} in row 1 and {other} in row {row}",
                        first=in_words(models[0]),
                        other=in_words(model),
                        row=i + 1,
                    )
                )
            if model.plant.k * models[0].plant.k < 0:
                raise InvalidParameter(
                    said("gains must have one sign, found {k:g} in row {row}", k=model.plant.k, row=i + 1)
                )
        checks.one_of("between", self.between, BETWEEN)

    @property
    def rows(self) -> tuple[Controller, ...]:
        """Settings at the rows."""
        return tuple(self.rule(model) for model in self.models)

    def model(self, x: float, gain: str = "linear") -> Model:
        """The plant at the scheduling value x, its gain linear or exponential between rows, the rest linear."""
        checks.one_of("gain", gain, GAIN_OF_PLANT)
        row, part = self._place(x)
        one, other = self.models[row], self.models[row + 1]

        def middle(name: str) -> float:
            first, last = getattr(one, name), getattr(other, name)
            if gain == "exponential" and name.startswith("k"):
                return first * (last / first) ** part
            return _mixed(first, last, part)

        return type(one)(*(middle(field.name) for field in fields(one)))

    def settings(self, x: float) -> Controller:
        """The controller at the scheduling value x."""
        if self.between == "model":
            return self.rule(self.model(x))
        row, part = self._place(x)
        one, other = (_with_times(self.rule(self.models[i])) for i in (row, row + 1))
        if type(one) is not type(other):
            raise InvalidParameter(
                said(
                    "settings of one form can be interpolated only, found {first} in row {row} and {second} in "
                    "row {next_row}: interpolate the model",
                    first=FORM_OF[type(one)],
                    row=row + 1,
                    second=FORM_OF[type(other)],
                    next_row=row + 2,
                )
            )

        def middle(name: str) -> float:
            first, last = getattr(one, name), getattr(other, name)
            return 1 / _mixed(1 / first, 1 / last, part) if name in ("Kc", "K_I") else _mixed(first, last, part)

        return type(one)(*(middle(field.name) for field in fields(one)))

    def peaks(self, gain: str = "linear", points: int = POINTS) -> tuple[np.ndarray, np.ndarray]:
        """Scheduling values from the first to the last row, and Ms there.

        Parameters
        ----------
        gain : {"linear", "exponential"}
            How the gain of the plant goes from row to row.
        points : int
            How many.

        Returns
        -------
        x, Ms : arrays of shape (points,)
            Ms is inf where the loop is not stable.
        """
        x = np.linspace(self.values[0], self.values[-1], checks.whole("points", points, 2, 10_000))
        found = margins_many([Loop(self.model(at, gain).plant, self.settings(at)) for at in x.tolist()])
        return x, np.array([each.Ms if each.stable else math.inf for each in found])

    def worst_Ms(self, gain: str = "linear", points: int = POINTS) -> float:
        """The largest of `peaks`."""
        return float(self.peaks(gain, points)[1].max())

    def warnings(self) -> tuple[Text, ...]:
        """Where Ms between rows is more than a tenth above that at the rows."""
        at_rows = margins_many([Loop(m.plant, c) for m, c in zip(self.models, self.rows, strict=True)])
        design = max(each.Ms if each.stable else math.inf for each in at_rows)
        told = []
        for gain in GAIN_OF_PLANT:
            x, Ms = self.peaks(gain)
            if Ms.max() > TOO_HIGH * design:
                told.append(PEAKS[gain].put(Ms=float(Ms.max()), x=float(x[np.argmax(Ms)]), design=design))
        return tuple(told)

    def _place(self, x: float) -> tuple[int, float]:
        """Row before x, and how far x is on the way to the next, 0 to 1."""
        x = min(max(checks.real("x", x), self.values[0]), self.values[-1])
        row = min(int(np.searchsorted(self.values, x, side="right")) - 1, len(self.values) - 2)
        return row, (x - self.values[row]) / (self.values[row + 1] - self.values[row])


def _mixed(first: float, last: float, part: float) -> float:
    """Linear between first and last; exact at both, also where they are infinite."""
    return first if first == last or part == 0 else last if part == 1 else first + part * (last - first)


def _with_times(controller: Controller) -> Controller:
    """The controller by its times rather than by its gains."""
    return controller.to_ideal() if isinstance(controller, ParallelPid) else controller
