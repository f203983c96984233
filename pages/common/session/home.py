"""How a design is taken home: what is decided beside the box itself. Pure: no streamlit."""

from dataclasses import dataclass, replace
from fractions import Fraction

from simc_core import FirstOrderDelay, GainSchedule, IntegratingDelay, SecondOrderDelay, checks
from simc_core.errors import InvalidParameter
from simc_core.implementation.exports.export import LANGUAGES
from simc_core.implementation.gain_schedule import BETWEEN
from simc_core.plants.models import Model
from simc_core.wording import said

ROUNDINGS = ("safe", "none")
EXPORTED = ("design", "typed")
MODELS = {3: IntegratingDelay, 4: FirstOrderDelay, 5: SecondOrderDelay}  # by the numbers of a point
MOST_POINTS = 20  # whose numbers a link can hold
Point = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Home:
    """rounding: of what is typed into a box, to its safe side, or none.   language: of the exported controller.

    exported: whether that is the design, or what is typed into the box.
    points: of a gain schedule: scheduling value, k, theta, and tau1, tau2 where the model has them; none without one.
    between: what is interpolated between them.
    """

    rounding: str = "safe"
    language: str = "python"
    exported: str = "design"
    points: tuple[Point, ...] = ()
    between: str = "model"

    def __post_init__(self):
        checks.one_of("rounding", self.rounding, ROUNDINGS)
        checks.one_of("language", self.language, LANGUAGES)
        checks.one_of("exported", self.exported, EXPORTED)
        checks.one_of("between", self.between, BETWEEN)
        rows = checks.items("points", self.points, MOST_POINTS)
        object.__setattr__(self, "points", tuple(_point(i, row) for i, row in enumerate(rows, start=1)))
        if rows:
            GainSchedule(self.values, self.models)  # which has bounds of its own

    @property
    def values(self) -> tuple[float, ...]:
        """Scheduling values of the points."""
        return tuple(point[0] for point in self.points)

    @property
    def models(self) -> tuple[Model, ...]:
        """The plant at the points."""
        return tuple(MODELS[len(point)](*point[1:]) for point in self.points)

    def in_time(self, time: Fraction) -> "Home":
        """The same with times multiplied."""

        def scaled(point: Point) -> Point:
            k = MODELS[len(point)](*point[1:]).plant.rescaled(time).k  # a slope, without tau1
            return (point[0], k, *(value * time.numerator / time.denominator for value in point[2:]))

        return replace(self, points=tuple(map(scaled, self.points)))


def _point(i: int, row: Point) -> Point:
    name = said("row {i}", i=i)
    values = checks.items(name, row, 5)
    if len(values) not in MODELS:
        raise InvalidParameter(
            said(
                "{name} must have 3 to 5 numbers, scheduling value, k, theta, tau1, tau2, found {n}",
                name=name,
                n=len(values),
            )
        )
    found = tuple(checks.real(name, value) for value in values)
    try:
        MODELS[len(found)](*found[1:])
    except InvalidParameter as error:
        raise InvalidParameter(said("{name}: {error}", name=name, error=str(error))) from None
    return found
