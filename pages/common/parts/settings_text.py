"""A controller as it is typed into a control system: sizes of its settings, its action, their units. Pure."""

import math

from pages.common.parts.units import unit_of
from pages.common.session.sheet import Sheet
from simc_core.controllers.forms import Controller, IController
from simc_core.implementation.boxes.box import DIRECT, REVERSE
from simc_core.wording import said

STRUCTURE = {
    "series": r"K_c \frac{\tau_I s+1}{\tau_I s}(\tau_D s+1)",
    "ideal": r"K_c \left(1+\frac{1}{\tau_I s}+\tau_D s\right)",
    "parallel": r"K_p+\frac{K_i}{s}+K_d s",
}
UNITS = {
    **dict.fromkeys(("Kc", "Kp"), "OP/PV"),
    **dict.fromkeys(("Ki", "K_I"), "OP/(PV time)"),
    "Kd": "OP time/PV",
    **dict.fromkeys(("tau_I", "tau_D", "tau_F"), "time"),
}
FORMS_NAMED = {"series": said("series"), "ideal": said("ideal"), "parallel": said("parallel")}
NO_FORM = {
    "series": said("No series form: {error}", error=""),
    "ideal": said("No ideal form: {error}", error=""),
    "parallel": said("No parallel form: {error}", error=""),
}
ACTION_NAMED = {"reverse": REVERSE, "direct": DIRECT}
ACTION = {"reverse": said("reverse action"), "direct": said("direct action")}
ACTIONS = {"reverse": said("The output falls when PV rises."), "direct": said("The output rises when PV rises.")}


def structure(controller: Controller, form: str) -> str:
    """C(s) in this form, as LaTeX, with the sign that a control system calls direct action."""
    formula = r"\frac{K_I}{s}" if isinstance(controller, IController) else STRUCTURE[form]
    if controller.action == "reverse":
        return formula
    return rf"-\left({formula}\right)" if form == "parallel" and "+" in formula else f"-{formula}"


def sizes(controller: Controller) -> dict[str, float]:
    """The settings of its form with the gain positive; the action tells its sign."""
    sign = 1.0 if controller.action == "reverse" else -1.0
    return {name: sign * value if name.startswith("K") else value for name, value in controller.settings.items()}


def form_shown(controller: Controller, asked: str) -> str:
    """The form asked for; where the controller has none, the one in which it is still typed."""
    return next(form for form in (asked, "ideal", "parallel") if controller.has_form(form))


def as_text(controller: Controller, form: str, sheet: Sheet) -> str:
    """Settings as lines `name = value unit`, ten digits, and the action; for the control system, not for the eye.

    Raises FormError.
    """
    shown = controller.in_form(form)
    values = sizes(shown)
    if shown.OPTIONAL:
        values |= {"tau_F": shown.tau_F} if shown.tau_F else {}
        values |= {"b": shown.b} if shown.b != 1 else {}
    lines = [
        f"{name} = no integral" if math.isinf(value) else f"{name} = {value:.10g} {unit_of(UNITS.get(name, ''), sheet)}"
        for name, value in values.items()
    ]
    return "\n".join([*(line.rstrip() for line in lines), f"action = {controller.action}"])
