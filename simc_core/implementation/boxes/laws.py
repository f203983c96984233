"""The laws of the boxes: from a controller to the quantities that a law is written with, and back.

A controller comes in seconds and with positive gain; what its law cannot filter is left to a filter of the measurement.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from simc_core.controllers.forms import Controller, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import BoxError
from simc_core.implementation.boxes.box import Box
from simc_core.implementation.boxes.filters import (
    DerivativeFiltered,
    derivative_filtered,
    fixed_ratio_filter,
    unfiltered,
    whole_filtered,
)
from simc_core.wording import Text, said

SAME_NUMBER = 1e-12  # relative; what differs by less is the same number
Quantities = dict[str, float]  # of the law, in seconds and in units of output and PV, all gains positive
Pid = SeriesPid | IdealPid | ParallelPid


class _IdealOrParallel:
    """Kp + Ki/s + Kd s/(Tf s + 1), by its times or by its gains."""

    def forward(self, design: Controller, box: Box, N: float | None) -> tuple[Quantities, float, list[Text]]:
        """Quantities of the law, time of a PV filter, warnings."""
        whole = design.to_parallel()
        warnings: list[Text] = []
        if box.form == "ideal" or (box.filter in ("ratio", "fixed") and whole.Kd):
            design.to_ideal()  # raises FormError
        if box.filter == "none" or not whole.Kd:
            own, pv_filter = unfiltered(whole), whole.tau_F
        elif box.filter == "time":
            filtered = derivative_filtered(whole)
            own, pv_filter = (unfiltered(whole), whole.tau_F) if filtered is None else (filtered, 0.0)
        else:
            own, pv_filter = self._with_ratio(whole, box, N, warnings), 0.0
        law = {"gain": own.Kp, "Ki": own.Ki, "Kd": own.Kd, "Tf": own.Tf, "b": own.b, "c": own.c, "factor": 1.0}
        if own.Kp:
            law |= {"Ti": own.Kp / own.Ki if own.Ki else math.inf, "Td": own.Kd / own.Kp}
        if box.N:
            law["N"] = own.Kd / own.Kp / own.Tf if own.Tf else box.N
        return law, pv_filter, warnings

    def _with_ratio(self, whole: ParallelPid, box: Box, N: float | None, warnings: list[Text]) -> DerivativeFiltered:
        """The design behind the filter that the box can have, that of the design if there is a choice."""
        if box.filter == "ratio" and N is None and whole.tau_F:
            own = derivative_filtered(whole)
            if own is not None and own.Kd:
                N = _within(box, own.Kd / own.Kp / own.Tf)
                if N is None:
                    return own
            else:
                N = _smallest(box)
        N = N or box.own_N
        tau_F = fixed_ratio_filter(whole, N)
        if tau_F is None:
            needed = 4 * whole.Kd * whole.Ki / whole.Kp**2 - 1
            raise BoxError(
                said(
                    "N must be >= 4 tau_D/tau_I - 1 = {needed:g} in {box}, found {N:g}",
                    needed=needed,
                    box=box.title,
                    N=N,
                ),
                "N",
                N,
                needed,
            )
        if abs(tau_F - whole.tau_F) > SAME_NUMBER * tau_F:
            warnings.append(
                said(
                    "the filter of the box, N = {N:g}, makes tau_F = {made:g} s, the design has {tau_F:g} s",
                    N=N,
                    made=tau_F,
                    tau_F=whole.tau_F,
                )
            )
        own = derivative_filtered(replace(whole, tau_F=tau_F))
        assert own is not None  # tau_F <= tau_I/2, so Kp' >= Kp/2, and Kd' = N Kp' tau_F
        return own

    def back(self, law: Quantities, box: Box) -> Pid:
        """The controller that quantities of the law make."""
        factor, Kp = law.get("factor", 1.0), law["gain"]
        Ki = law["Ki"] if "Ki" in law else Kp / law.get("Ti", math.inf)
        Kd = law["Kd"] if "Kd" in law else Kp * law.get("Td", 0.0)
        Tf = law.get("Tf", 0.0)
        if box.filter in ("ratio", "fixed") and Kd:
            if not Kp:
                raise BoxError(
                    said("{box} filters D by a ratio to P, which must not be 0 then, found 0", box=box.title), "", 0.0
                )
            Tf = Kd / Kp / _ratio(law, box)
        own = DerivativeFiltered(factor * Kp, factor * Ki, factor * Kd, Tf, law.get("b", 1.0), law.get("c", 0.0))
        whole = whole_filtered(own)
        return whole.to_ideal() if box.form == "ideal" else whole


class _Series:
    """Kc (1 + 1/(Ti s)) (Td s + 1)/(Tf s + 1), Tf = Td/N."""

    def forward(self, design: Controller, box: Box, N: float | None) -> tuple[Quantities, float, list[Text]]:
        """Quantities of the law, time of a PV filter, warnings."""
        series = design.to_series()
        warnings: list[Text] = []
        tau_D, tau_F, pv_filter = series.tau_D, series.tau_F, 0.0
        if box.filter == "none" or not tau_D:
            ratio, pv_filter = box.N, tau_F
        else:
            asked = self.ratio(series, tau_F) if tau_F else box.own_N
            ratio = chosen = box.own_N if box.filter == "fixed" else N or _within(box, asked) or asked
            made = self.filter_time(series.tau_I, tau_D, chosen)
            if abs(made - tau_F) > SAME_NUMBER * made:
                warnings.append(
                    said(
                        "the filter of the box, N = {N:g}, makes tau_F = {made:g} s, the design has {tau_F:g} s",
                        N=chosen,
                        made=made,
                        tau_F=tau_F,
                    )
                )
        law = {"gain": series.Kc, "Ti": series.tau_I, "Td": tau_D, "b": series.b, "c": series.c}
        return law | ({"N": ratio} if ratio else {}), pv_filter, warnings

    def ratio(self, series: SeriesPid, tau_F: float) -> float:
        """N that makes tau_F."""
        return series.tau_D / tau_F

    def filter_time(self, Ti: float, Td: float, N: float) -> float:
        """tau_F that N makes."""
        return Td / N

    def back(self, law: Quantities, box: Box) -> SeriesPid:
        """The controller that quantities of the law make."""
        Ti, Td = law.get("Ti", math.inf), law.get("Td", 0.0)
        tau_F = self.filter_time(Ti, Td, _ratio(law, box)) if Td and box.filter != "none" else 0.0
        b, c = self.weights(law, Ti, Td)
        return SeriesPid(law["gain"], Ti, Td, tau_F, b, c)

    def weights(self, law: Quantities, Ti: float, Td: float) -> tuple[float, float]:
        """b and c."""
        return law.get("b", 1.0), law.get("c", 0.0)


class _Interacting(_Series):
    """The same with Tf = 1/(N (1/Ti + 1/Td)), of PV only: u = Kc (1 + 1/(Ti s)) [r - (Td s + 1) PV]."""

    def ratio(self, series: SeriesPid, tau_F: float) -> float:
        return 1 / tau_F / (1 / series.tau_I + 1 / series.tau_D)

    def filter_time(self, Ti: float, Td: float, N: float) -> float:
        return 1 / N / (1 / Ti + 1 / Td)

    def weights(self, law: Quantities, Ti: float, Td: float) -> tuple[float, float]:
        return 1 / (1 + Td / Ti), 0.0


LAWS: Mapping[str, _IdealOrParallel | _Series] = MappingProxyType(
    {
        "ideal": _IdealOrParallel(),
        "parallel": _IdealOrParallel(),
        "series": _Series(),
        "interacting": _Interacting(),
    }
)


def _ratio(law: Quantities, box: Box) -> float:
    """N as typed, else the box's own."""
    return law["N"] if "N" in law else box.own_N  # noqa: SIM401 the default may not exist


def _within(box: Box, N: float) -> float | None:
    """None if N can be typed, else the nearest that can."""
    field = box.field_of("N", "1/N")
    if field is None:
        return None
    number = N if field.quantity == "N" else 1 / N
    nearest = min(max(number, field.low), field.high)
    if abs(nearest - number) <= SAME_NUMBER * number:
        return None
    return nearest if field.quantity == "N" else 1 / nearest


def _smallest(box: Box) -> float:
    """The smallest N that can be typed: the most filtering."""
    field = box.field_of("N", "1/N")
    assert field is not None  # where a ratio can be chosen
    return (field.low if field.quantity == "N" else 1 / field.high) or box.own_N
