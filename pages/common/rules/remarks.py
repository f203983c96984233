"""A word on each rule: what it was made for, and what is wrong of it in circulation. Pure: no streamlit."""

from pages.common.rules.table import Question, value_of
from pages.common.session.compared import OPTIMAL
from pages.common.words import number, translated, words
from simc_core import RULES, Optimum
from simc_core.controllers.forms import IController
from simc_core.studies.comparison import Row
from simc_core.wording import said

DIGITS = 3
LIKE = 0.05  # relative: a setting, or an error, that is as that of the optimum
MADE_FOR = {
    "optimal": said("The smallest error that any controller of this kind has with this Mst; no rule lies below it."),
    "simc": said(
        "One knob, $\\tau_c$, for all reduced models: $\\tau_c = \\theta$ is tight and robust. For lags and "
        "integrators $\\tau_I \\le 4(\\tau_c + \\theta)$, so that slow processes get rid of a load."
    ),
    "improved_simc": said(
        "SIMC with $\\tau_1 + \\theta/3$ in place of $\\tau_1$: nearer to the optimum where dead time dominates."
    ),
    "isimc": said(
        "SIMC with $\\tau_D = \\theta/3$: derivative action against the dead time itself, and $\\tau_c$ down to "
        "$\\theta/2$."
    ),
    "lambda": said(
        "The closed loop is to be as slow as you like, often $\\lambda = 1 \\ldots 3\\,\\tau_1$: made for paper "
        "machines, where loops must not disturb each other. The lag is cancelled, so loads on a slow lag stay long."
    ),
    "imc_1986": said(
        "Internal model control with a first-order filter $\\epsilon$: the set point is followed well; the lag "
        "is cancelled, so loads on a slow lag stay long."
    ),
    "imc_1986_improved": said("The same for PI, with half of the dead time added to the lag."),
    "lee_1998": said("The controller that the desired closed loop asks for, expanded to a PID."),
    "desired_model": said(
        "Wanted is a first-order response with dead time; $\\beta = 2$ is SIMC, 1.944 has 5 % overshoot, "
        "$e$ none. The lag is cancelled."
    ),
    "amigo": said(
        "A fit to controllers of a large batch of plants, best for loads with $M_s$ and $M_t$ bounded by 1.4."
    ),
    "zn_step": said("Loads, with each swing a quarter of the one before: fast and lively by intent, not robust."),
    "zn_ultimate": said("The same aim from the loop at its limit: $K_u$ and $P_u$."),
    "tyreus_luyben": said(
        "Made for integrating and slow processes: less gain and much more integral time than Ziegler and Nichols."
    ),
    "pessen": said("A variant of Ziegler and Nichols for loads."),
    "some_overshoot": said("A softer variant of Ziegler and Nichols."),
    "no_overshoot": said("The softest variant of Ziegler and Nichols, for set points."),
    "chr_setpoint_0": said("Set points without overshoot; the integral time goes with the lag."),
    "chr_setpoint_20": said("Set points with 20 % overshoot; the integral time goes with the lag."),
    "chr_load_0": said("Loads without swinging beyond; the integral time goes with the dead time."),
    "chr_load_20": said("Loads with 20 % swing; the integral time goes with the dead time."),
    "cohen_coon": said("Loads with quarter decay also where dead time is long: as lively as Ziegler and Nichols."),
    "iae_load": said("Least IAE of loads, whatever the robustness: a fit on $\\theta/\\tau_1$ from 0.1 to 1."),
    "itae_load": said("Least ITAE of loads, whatever the robustness: a fit on $\\theta/\\tau_1$ from 0.1 to 1."),
    "iae_setpoint": said("Least IAE of set points: a fit on $\\theta/\\tau_1$ from 0.1 to 1."),
    "itae_setpoint": said("Least ITAE of set points: a fit on $\\theta/\\tau_1$ from 0.1 to 1."),
    "kuhn": said("Plants of many lags that come to rest, known by gain and sum of times $T_\\Sigma$ alone."),
    "kuhn_fast": said("The same, twice as strong."),
    "magnitude_optimum": said("Drives: $|T|$ stays at 1 to as high a frequency as it can."),
    "symmetrical_optimum": said("Drives with an integrator: the largest phase at the crossover."),
    "schaedel": said("Plants of many real lags: the damping of the loop is laid down by its first coefficients."),
    "spectral": said("Each lag is cancelled, the integral gain is free."),
}
IN_CIRCULATION = {
    "cohen_coon": said("In circulation: PI with 1.1 for 0.9, or $\\tau_I$ without its $\\theta$."),
    "imc_1986_improved": said("In circulation: $\\theta/4$ for $\\theta/2$."),
    "zn_ultimate": said(
        "In circulation: PI with $0.4\\,K_u$ for $0.45\\,K_u$; PID taken as a series form, which raises $K_c$ by 1.25."
    ),
    "zn_step": said(
        "In circulation: PID taken as a series form, which raises $K_c$ by 1.25. It was made for the tangent of "
        "a step response, not for a half-rule model."
    ),
    "chr_setpoint_0": said(
        "In circulation: $\\tau_I$ in dead times. It goes with the lag. Made for the tangent of a step response."
    ),
    "chr_setpoint_20": said(
        "In circulation: $\\tau_I$ in dead times. It goes with the lag. Made for the tangent of a step response."
    ),
    "spectral": said(
        "In circulation: $K_d = K_i T_1 T_2/(T_1 + T_2)$. It is $K_i T_1 T_2$; the quotient is the ideal $\\tau_D$."
    ),
    "isimc": said("Named iSIMC by its authors; improved SIMC [SG12] is another rule, for PI."),
}
WITHIN = {
    "load": said(
        "Here its IAE of the load is within {share} % of that of the best {kind} with the same Mst.", share="", kind=""
    ),
    "setpoint": said(
        "Here its IAE of the set point is within {share} % of that of the best {kind} with the same Mst.",
        share="",
        kind="",
    ),
    "J": said("Here its J is within {share} % of that of the best {kind} with the same Mst.", share="", kind=""),
}
ABOVE = {
    "load": said(
        "Here its IAE of the load is {share} % above that of the best {kind} with the same Mst.", share="", kind=""
    ),
    "setpoint": said(
        "Here its IAE of the set point is {share} % above that of the best {kind} with the same Mst.", share="", kind=""
    ),
    "J": said("Here its J is {share} % above that of the best {kind} with the same Mst.", share="", kind=""),
}
ITS_MODEL = said("Mst {peak} takes {F} times the dead time in its formula (F).", peak="", F="")
KNOBS = {
    "tau_c": said("Mst {peak} takes {F} times its $\\tau_c + \\theta$ (F).", peak="", F=""),
    "lambda_": said("Mst {peak} takes {F} times its $\\lambda$ (F).", peak="", F=""),
    "epsilon": said("Mst {peak} takes {F} times its $\\epsilon$ (F).", peak="", F=""),
    "beta": said("Mst {peak} takes {F} times its $\\beta$ (F).", peak="", F=""),
    "Ki": said("Mst {peak} takes its $K_i$ divided by {F} (F).", peak="", F=""),
}


def here(row: Row, best: Optimum | None, question: Question) -> str:
    """How the rule does on this plant, beside the optimum with the same Mst: numbers only, and what follows."""
    if row.controller is None or best is None or row.key == OPTIMAL:
        return ""
    behind = value_of(row, question.criterion) / best.value - 1
    if not behind > LIKE:
        return translated(WITHIN[question.criterion].put(share=number(100 * LIKE), kind=row.kind))
    above = translated(ABOVE[question.criterion].put(share=number(100 * behind, 2), kind=row.kind))
    return f"{above} {_settings_beside(row, best)}".rstrip()


def _settings_beside(row: Row, best: Optimum) -> str:
    """Ratios of the settings to those of the optimum."""
    if isinstance(row.controller, IController) or row.controller is None:
        return words("It has no proportional action.")
    own, other = row.controller.to_ideal(), best.controller.to_ideal()
    ratios = [("K_c", own.Kc / other.Kc), ("\\tau_I", own.tau_I / other.tau_I)]
    if own.tau_D and other.tau_D:
        ratios.append(("\\tau_D", own.tau_D / other.tau_D))
    told = [
        words("${setting}$ is {ratio} times", setting=name, ratio=number(ratio, DIGITS))
        for name, ratio in ratios
        if abs(ratio - 1) > LIKE
    ]
    return words("{ratios} that of the optimum.", ratios=", ".join(told)) if told else ""


def robustness(row: Row, question: Question) -> str:
    """What F says of the rule as published."""
    if row.factor is None or question.Ms is None or row.key == OPTIMAL:
        return ""
    peak, F = number(question.Ms, DIGITS), number(row.factor, DIGITS)
    if abs(row.factor - 1) <= LIKE:
        return words("As published it is about as robust as Mst {peak} asks.", peak=peak)
    fate = words("As published it is less robust.") if row.factor > 1 else words("As published it is more cautious.")
    return f"{fate} {translated(KNOBS.get(RULES[row.key].knob, ITS_MODEL).put(peak=peak, F=F))}"
