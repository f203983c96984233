"""The names that claims and printed numbers of lessons may use, and what they are of an opened case. No streamlit.

Steps are unit steps; overshoot and errors are in percent of them; angles in degrees. `docs/lessons.md` lists them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pages.common.lessons.opened import Opened
from pages.common.parts.settings_text import form_shown
from pages.common.studies.cascade import attempt
from simc_core import dominant_poles
from simc_core.errors import InvalidParameter
from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.optimal.imc_figures import ImcPoint, imc_point
from simc_core.studies.built_advice import error_integral
from simc_core.wording import said


@dataclass(frozen=True, slots=True)
class Quantity:
    """meaning: in words.   of: from an opened case to the number."""

    meaning: str
    of: Callable[[Opened], float]


def _setting(name: str) -> Callable[[Opened], float]:
    def of(case: Opened) -> float:
        controller = case.study.controller
        settings = controller.in_form(form_shown(controller, case.design.form)).settings
        if name not in settings:
            raise InvalidParameter(
                said("this controller has no {name}, but {names}", name=name, names=", ".join(settings))
            )
        return settings[name]

    return of


def _parameter(name: str) -> Callable[[Opened], float]:
    def of(case: Opened) -> float:
        model = case.reduction.model
        if not hasattr(model, name):
            raise InvalidParameter(said("the model has no {name}", name=name))
        return float(getattr(model, name))

    return of


def _margin(name: str) -> Callable[[Opened], float]:
    return lambda case: getattr(case.stable.margins, name)


def _step(which: str, name: str, factor: float = 1.0) -> Callable[[Opened], float]:
    return lambda case: factor * getattr(getattr(case.stable.performance, which), name)


def _nested(name: str, metric: str, single: bool = False) -> Callable[[Opened], float]:
    def of(case: Opened) -> float:
        study = case.cascade
        found: NestedPerformance | None = study.performance
        if single:
            found = None if study.single is None else study.single.performance
        if found is None:
            raise InvalidParameter(study.unsettled or study.no_single or said("the cascade is not stable"))
        return getattr(getattr(found, name), metric)

    return of


def _fitted(name: str, error: bool = False) -> Callable[[Opened], float]:
    def of(case: Opened) -> float:
        found = case.fit.standard_errors if error else case.fit.parameters
        if name not in found:
            raise InvalidParameter(said("the model has no {name}, but {names}", name=name, names=", ".join(found)))
        return found[name]

    return of


def _behind(structure: str) -> Callable[[Opened], float]:
    def of(case: Opened) -> float:
        if structure not in case.fits:
            raise InvalidParameter(said("{structure} cannot be fitted to this record", structure=structure))
        return case.fits[structure].criterion

    return of


def _possible(case: Opened) -> float:
    return float(attempt(case.design.cascade)[0] is not None)


def _imc(case: Opened) -> ImcPoint:
    """Of L = (1 + beta s) e^{-s}/((epsilon + beta) s), which the case must be."""
    form = case.study.controller.to_parallel()
    beta = form.Kd / form.Kp
    return imc_point(1 / form.Kp - beta, "PID" if beta else "PI")


def _swing(case: Opened) -> float:
    turning = [pole for pole in dominant_poles(case.stable.loop) if pole.s.imag]
    if not turning:
        raise InvalidParameter(said("no pole of this loop swings"))
    return 2 * math.pi / turning[0].s.imag


def _unprotected(case: Opened) -> float:
    found = case.built.unprotected
    if found is None:
        raise InvalidParameter(said("the input has no limits"))
    return error_integral(found.t, found.r, found.y)


def _built(name: str) -> Callable[[Opened], float]:
    return lambda case: getattr(case.built.numbers, name)


def _peak_y(of: str) -> Callable[[Opened], float]:
    def peak(case: Opened) -> float:
        course = getattr(case.built, of)
        if course is None:
            raise InvalidParameter(said("the input has no limits"))
        before = (course.t < course.t[np.argmax(course.d != 0)]) if np.any(course.d) else course.t >= 0
        if not before.any() or not course.r.max() > 0:
            raise InvalidParameter(said("an overshoot needs a step of the set point upwards, and time before the load"))
        return 100 * (float(course.y[before].max()) / float(course.r.max()) - 1)

    return peak


QUANTITIES: dict[str, Quantity] = {
    **{name: Quantity("of the controller, in the form of the design", _setting(name)) for name in ("Kc", "K_I")},
    **{name: Quantity("of the controller, in the form of the design", _setting(name)) for name in ("tau_I", "tau_D")},
    **{name: Quantity("of the parallel form", _setting(name)) for name in ("Kp", "Ki", "Kd")},
    "tau_c": Quantity("closed-loop time constant in use", lambda case: case.study.tau_c or math.nan),
    **{
        name: Quantity("of the model that the half rule gives", _parameter(name))
        for name in ("k", "theta", "tau1", "tau2")
    },
    "stable": Quantity("1 where the loop is stable, else 0", lambda case: float(case.study.stable)),
    "Ms": Quantity("largest |S|", _margin("Ms")),
    "Mt": Quantity("largest |T|", _margin("Mt")),
    "GM": Quantity("gain margin", _margin("GM")),
    "GM_lower": Quantity("lower gain margin, 0 for none", _margin("GM_lower")),
    "PM": Quantity("phase margin, degrees", _margin("PM_deg")),
    "delay_margin": Quantity("dead time that may be added", _margin("delay_margin")),
    "omega_180": Quantity("frequency of the gain margin", _margin("omega_180")),
    "omega_c": Quantity("frequency of the phase margin", _margin("omega_c")),
    "IAE_load": Quantity("IAE after a load step", _step("disturbance", "IAE")),
    "IAE_setpoint": Quantity("IAE after a set-point step", _step("setpoint", "IAE")),
    "ISE_setpoint": Quantity("ISE after a set-point step", _step("setpoint", "ISE")),
    "TV_load": Quantity("total variation of u after a load step", _step("disturbance", "TV")),
    "TV_setpoint": Quantity("total variation of u after a set-point step", _step("setpoint", "TV")),
    "peak_load": Quantity("largest y after a load step", _step("disturbance", "peak")),
    "overshoot": Quantity("overshoot of a set-point step, percent", _step("setpoint", "overshoot", 100.0)),
    "rise": Quantity("from 10 to 90 %", _step("setpoint", "rise_time")),
    "settling_2": Quantity("settling to 2 %, set point", _step("setpoint", "settling_time")),
    "settling_5": Quantity("settling to 5 %, set point", _step("setpoint", "settling_5")),
    "settling_1": Quantity("settling to 1 %, set point", _step("setpoint", "settling_1")),
    "arrival": Quantity("when y first reaches the set point", _step("setpoint", "first_arrival")),
    "period": Quantity("from the first peak to the second, set point", _step("setpoint", "period")),
    "period_load": Quantity("the same after a load step", _step("disturbance", "period")),
    "swing": Quantity("period of the closed-loop pole that swings longest", _swing),
    "decay": Quantity("second peak over the first, set point", _step("setpoint", "decay_ratio")),
    "largest_u": Quantity("largest |u| after a set-point step", _step("setpoint", "largest_u")),
    "offset": Quantity("error left after a set-point step, percent", lambda case: 100 * case.rest.step),
    "ramp_error": Quantity("error behind a set-point ramp of 1 per time", lambda case: case.rest.ramp),
    "noise_gain": Quantity("largest |K S|, inf for a derivative without filter", _margin("max_KS")),
    "Ku": Quantity("ultimate gain of the plant", lambda case: case.ultimate.Ku),
    "omega_u": Quantity("frequency of the ultimate point", lambda case: 2 * math.pi / case.ultimate.Pu),
    "gain_u": Quantity("gain of the plant there, 1/Ku", lambda case: 1 / case.ultimate.Ku),
    "relay_omega": Quantity("frequency of a relay test", lambda case: 2 * math.pi / case.relay.Pu),
    "relay_gain": Quantity("gain there by describing function", lambda case: 1 / case.relay.Ku),
    "imc_J": Quantity("ISE over the smallest possible, of an IMC loop", lambda case: _imc(case).J),
    "imc_M": Quantity("largest |T| of an IMC loop", lambda case: _imc(case).M),
    "sampled_Ms": Quantity("Ms with the sampled controller", lambda case: case.sampled.Ms),
    "built_IAE": Quantity("IAE as built, over the time shown", _built("IAE")),
    "built_IAE_linear": Quantity("of the linear loop over the same time", _built("IAE_linear")),
    "wound_up_IAE": Quantity("the same without anti-windup", _unprotected),
    "built_overshoot": Quantity("overshoot as built before the load, percent", _peak_y("built")),
    "wound_up_overshoot": Quantity("the same without anti-windup", _peak_y("unprotected")),
    "built_noise_u": Quantity("standard deviation of what noise adds to u", _built("noise_u")),
    "IAE_d1": Quantity("IAE of the load on the outer block", _nested("disturbance", "IAE")),
    "IAE_d2": Quantity("IAE of the load on the inner block", _nested("disturbance2", "IAE")),
    "single_IAE_d1": Quantity("the same with one controller", _nested("disturbance", "IAE", single=True)),
    "single_IAE_d2": Quantity("the same with one controller", _nested("disturbance2", "IAE", single=True)),
    "Ms_outer": Quantity("Ms of the outer loop", lambda case: case.cascade.outer.Ms),
    "Ms_inner": Quantity("Ms of the inner loop", lambda case: case.cascade.inner.Ms),
    "Mt_outer": Quantity("Mt of the outer loop", lambda case: case.cascade.outer.Mt),
    "Mt_inner": Quantity("Mt of the inner loop", lambda case: case.cascade.inner.Mt),
    "possible": Quantity("1 where there is a cascade as it is asked for, else 0", _possible),
    "cascade_stable": Quantity("1 where the cascade is stable, else 0", lambda case: float(case.cascade.sound)),
    **{f"fit_{name}": Quantity("of the fitted model", _fitted(name)) for name in ("k", "theta", "tau1", "tau2")},
    **{
        f"error_{name}": Quantity("its standard error", _fitted(name, error=True))
        for name in ("k", "theta", "tau1", "tau2")
    },
    "fit": Quantity("how much of PV the model explains, percent", lambda case: 100 * case.fit.fit),
    **{
        f"behind_{name}": Quantity("how far the structure is behind the best", _behind(name))
        for name in ("FOPDT", "SOPDT", "IPDT", "IPDT_lag")
    },
    "rule_load": Quantity("IAE load of the rule that is compared", lambda case: case.row.load),
    "rule_setpoint": Quantity("IAE set point of that rule", lambda case: case.row.setpoint),
    "rule_Ms": Quantity("its larger one of Ms and Mt", lambda case: case.row.Mst),
    "rule_published_Ms": Quantity("the same as published", lambda case: case.row.published_Ms),
    "rule_behind": Quantity("how far it is behind the optimum, percent", lambda case: 100 * case.row.behind),
}
