"""All tuning rules by name. Each is a cited pure function in a module of this room; here is what is said of it.

Rules without a verified formula are not here: Schaedel PID, Hagglund's one-third rule, Shamsuzzoha-Yoon, kappa-tau.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from simc_core.controllers.forms import IController, IdealPid, SeriesPid
from simc_core.plants.models import FirstOrderDelay, Model
from simc_core.rules.amigo import amigo
from simc_core.rules.chien_hrones_reswick import chr_load_0, chr_load_20, chr_setpoint_0, chr_setpoint_20
from simc_core.rules.cohen_coon import KINDS as COHEN_COON
from simc_core.rules.cohen_coon import cohen_coon
from simc_core.rules.desired_model import desired_model
from simc_core.rules.error_integrals import iae_load, iae_setpoint, itae_load, itae_setpoint
from simc_core.rules.imc_1986 import PI_EPSILON, PID_EPSILON, imc_1986, imc_1986_improved
from simc_core.rules.kuhn import kuhn, kuhn_fast
from simc_core.rules.lambda_tuning import lambda_tuning
from simc_core.rules.lee_1998 import lee_1998
from simc_core.rules.magnitude_optimum import magnitude_optimum, schaedel, symmetrical_optimum
from simc_core.rules.simc import simc
from simc_core.rules.simc_variants import improved_simc, isimc
from simc_core.rules.spectral import spectral
from simc_core.rules.ultimate_rules import no_overshoot, pessen, some_overshoot, tyreus_luyben
from simc_core.rules.ziegler_nichols import zn_step, zn_ultimate
from simc_core.wording import said

Within = Callable[[Model, str, float | None], bool]


def _anywhere(model: Model, kind: str, knob: float | None) -> bool:
    return True


@dataclass(frozen=True, slots=True)
class Rule:
    """A tuning rule.

    Attributes
    ----------
    key : str
        Its name in RULES.
    title : str
        Its name on a page.
    source : str
        Where it was published: a key of docs/sources.md in square brackets, or words.
    kinds : tuple of str
        Controllers it has settings for: "P", "PI", "PD", "PID".
    needs : str
        What the settings are made from: "model" (a reduced model), "ultimate" (Ku, Pu) or "plant".
    domain : str
        What it was made for, in words.
    knob : str or None
        Name of the rule's own parameter, None if it has none.
    settings : callable
        The rule: settings(subject, kind) or settings(subject, kind, knob).
    within : callable
        Whether a model, kind and knob lie in the domain that the source recommends. Beyond it the formula still has an
        answer; where it has none, `settings` raises OutOfDomain.
    """

    key: str
    title: str
    source: str
    kinds: tuple[str, ...]
    needs: str
    domain: str
    knob: str | None
    settings: Callable[..., SeriesPid | IdealPid | IController]
    within: Within = _anywhere


def _simc(model: Model, kind: str, tau_c: float | None = None) -> SeriesPid | IdealPid | IController:
    return simc(model, tau_c)


def _ratio(model: Model) -> float:
    """theta/tau1; an integrating process counts as 0."""
    return model.theta / model.tau1 if isinstance(model, FirstOrderDelay) and model.tau1 else 0.0


def _fits(model: Model, kind: str, knob: float | None) -> bool:
    return 0.1 <= _ratio(model) <= 1


def _short_delay(model: Model, kind: str, knob: float | None) -> bool:
    return _ratio(model) < 1


def _epsilon(model: Model, kind: str, epsilon: float | None) -> bool:
    factor = PID_EPSILON if kind == "PID" else PI_EPSILON
    used = factor * model.theta if epsilon is None else epsilon
    return isinstance(model, FirstOrderDelay) and used >= max(factor * model.theta, 0.1 * model.tau1)


def _amigo(model: Model, kind: str, knob: float | None) -> bool:
    return kind == "PI" or not isinstance(model, FirstOrderDelay) or model.theta > 0.3 * (model.theta + model.tau1)


_PI, _PID, _PI_PID, _P_PI_PID = ("PI",), ("PID",), ("PI", "PID"), ("P", "PI", "PID")
_LAG, _LAG_OR_INTEGRATOR = said("first order with dead time"), said("first order with dead time, integrating")
_CURVE, _FITS = said("tangent at the steepest point of a step response"), said("theta/tau1 from 0.1 to 1")
_CURVE_FITS = said("tangent at the steepest point of a step response; theta/tau1 from 0.1 to 1")
_LIMIT, _REST = said("a loop with an ultimate gain"), said("plants that come to rest")
_MANY_LAGS, _REAL_POLES = said("plants that come to rest, many lags"), said("plants that come to rest, real poles")
_EPS = said("epsilon >= 1.7 theta and 0.1 tau1")
_EPS_BOTH = said("epsilon >= 1.7 theta and 0.1 tau1; PID: 0.8 theta")
_HANDBOOKS = said("handbooks")
_TABLE = [
    Rule("simc", said("SIMC"), "[SK03]", _PI_PID, "model", said("all reduced models"), "tau_c", _simc),
    Rule("improved_simc", said("improved SIMC"), "[SG12]", _PI, "model", _LAG_OR_INTEGRATOR, "tau_c", improved_simc),
    Rule("isimc", said("iSIMC"), "[GS18]", _PID, "model", _LAG_OR_INTEGRATOR, "tau_c", isimc),
    Rule("lambda", said("Lambda"), said("paper industry"), _PI, "model", _LAG_OR_INTEGRATOR, "lambda_", lambda_tuning),
    Rule("imc_1986", said("IMC 1986"), "[RMS86]", _PI_PID, "model", _EPS_BOTH, "epsilon", imc_1986, _epsilon),
    Rule(
        "imc_1986_improved",
        said("IMC improved PI"),
        "[RMS86]",
        _PI,
        "model",
        _EPS,
        "epsilon",
        imc_1986_improved,
        _epsilon,
    ),
    Rule("lee_1998", said("Lee, Park, Lee, Brosilow"), "[LPLB98]", _PID, "model", _LAG, "lambda_", lee_1998),
    Rule("desired_model", said("desired model"), "[V06]", _PI, "model", _LAG, "beta", desired_model),
    Rule(
        "amigo", said("AMIGO"), "[AH04]", _PI_PID, "model", said("PID: theta/(theta + tau1) > 0.3"), None, amigo, _amigo
    ),
    Rule("zn_step", said("Ziegler-Nichols, step"), "[ZN42]", _P_PI_PID, "model", _CURVE_FITS, None, zn_step, _fits),
    Rule("zn_ultimate", said("Ziegler-Nichols, ultimate"), "[ZN42]", _P_PI_PID, "ultimate", _LIMIT, None, zn_ultimate),
    Rule(
        "tyreus_luyben",
        said("Tyreus-Luyben"),
        "[TL92]",
        _PI_PID,
        "ultimate",
        said("integrating, slow"),
        None,
        tyreus_luyben,
    ),
    Rule("pessen", said("Pessen"), _HANDBOOKS, _PID, "ultimate", _LIMIT, None, pessen),
    Rule("some_overshoot", said("some overshoot"), _HANDBOOKS, _PID, "ultimate", _LIMIT, None, some_overshoot),
    Rule("no_overshoot", said("no overshoot"), _HANDBOOKS, _PID, "ultimate", _LIMIT, None, no_overshoot),
    Rule(
        "chr_setpoint_0",
        said("Chien-Hrones-Reswick, set point, 0 %"),
        "[CHR52]",
        _P_PI_PID,
        "model",
        _CURVE,
        None,
        chr_setpoint_0,
    ),
    Rule(
        "chr_setpoint_20",
        said("Chien-Hrones-Reswick, set point, 20 %"),
        "[CHR52]",
        _P_PI_PID,
        "model",
        _CURVE,
        None,
        chr_setpoint_20,
    ),
    Rule(
        "chr_load_0", said("Chien-Hrones-Reswick, load, 0 %"), "[CHR52]", _P_PI_PID, "model", _CURVE, None, chr_load_0
    ),
    Rule(
        "chr_load_20",
        said("Chien-Hrones-Reswick, load, 20 %"),
        "[CHR52]",
        _P_PI_PID,
        "model",
        _CURVE,
        None,
        chr_load_20,
    ),
    Rule(
        "cohen_coon",
        said("Cohen-Coon"),
        "[CC53]",
        COHEN_COON,
        "model",
        said("theta/tau1 < 1"),
        None,
        cohen_coon,
        _short_delay,
    ),
    Rule("iae_load", said("IAE, load"), "[M67]", _PI_PID, "model", _FITS, None, iae_load, _fits),
    Rule("itae_load", said("ITAE, load"), "[M67]", _PI_PID, "model", _FITS, None, itae_load, _fits),
    Rule("iae_setpoint", said("IAE, set point"), "[R69]", _PI_PID, "model", _FITS, None, iae_setpoint, _fits),
    Rule("itae_setpoint", said("ITAE, set point"), "[R69]", _PI_PID, "model", _FITS, None, itae_setpoint, _fits),
    Rule("kuhn", said("Kuhn T-sum"), "[K95]", _PI_PID, "plant", _MANY_LAGS, None, kuhn),
    Rule("kuhn_fast", said("Kuhn T-sum, fast"), "[K95]", _PI_PID, "plant", _MANY_LAGS, None, kuhn_fast),
    Rule("magnitude_optimum", said("magnitude optimum"), "[K54]", _PI, "plant", _REST, None, magnitude_optimum),
    Rule(
        "symmetrical_optimum",
        said("symmetrical optimum"),
        "[K54]",
        _PI,
        "plant",
        said("integrating"),
        None,
        symmetrical_optimum,
    ),
    Rule("schaedel", said("Schaedel PI"), "[SCH97]", _PI, "plant", _REAL_POLES, None, schaedel),
    Rule(
        "spectral",
        said("pole cancelling"),
        said("textbooks"),
        _PI_PID,
        "model",
        said("first or second order"),
        "Ki",
        spectral,
    ),
]
RULES: Mapping[str, Rule] = MappingProxyType({rule.key: rule for rule in _TABLE})
