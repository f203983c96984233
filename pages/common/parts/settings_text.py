"""A controller in the form chosen: its structure for the eye, its settings as text to copy."""

import math

from simc_core.controllers.forms import Controller

STRUCTURE = {
    "series": r"K_c \frac{\tau_I s+1}{\tau_I s}(\tau_D s+1)",
    "ideal": r"K_c \left(1+\frac{1}{\tau_I s}+\tau_D s\right)",
    "parallel": r"K_p+\frac{K_i}{s}+K_d s",
}


def as_text(controller: Controller, form: str) -> str:
    """Settings as lines `name = value`, ten digits; for the control system, not for the eye.

    Raises FormError.
    """
    shown = controller.in_form(form)
    values = shown.settings
    if shown.OPTIONAL:
        values |= {"tau_F": shown.tau_F} if shown.tau_F else {}
        values |= {"b": shown.b} if shown.b != 1 else {}
    return "\n".join(
        f"{name} = {'no integral' if math.isinf(value) else f'{value:.10g}'}" for name, value in values.items()
    )
