"""The models: all structures with their fit, the chosen one as a card, and what to think of it."""

import math
from html import escape
from time import monotonic

import streamlit as st

from pages.common.from_data import points_view
from pages.common.from_data.work import MORE, Fits, Work
from pages.common.parts.structures import sign_of, title_of
from pages.common.parts.symbols import sentence, symbols
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.words import number, numeral, translated, words
from simc_core import Identified, Trend
from simc_core.identification.judgement.gain_per_move import disagreement
from simc_core.identification.rank import USUAL
from simc_core.wording import counted

FORMULAS = {
    "FOPDT": r"\frac{k\,e^{-\theta s}}{\tau_1 s+1}",
    "SOPDT": r"\frac{k\,e^{-\theta s}}{(\tau_1 s+1)(\tau_2 s+1)}",
    "IPDT": r"\frac{k'e^{-\theta s}}{s}",
    "IPDT_lag": r"\frac{k'e^{-\theta s}}{s(\tau_2 s+1)}",
    "DIPDT": r"\frac{k''e^{-\theta s}}{s^2}",
    "inverse": r"\frac{k(Ts+1)e^{-\theta s}}{(\tau_1 s+1)(\tau_2 s+1)}",
    "oscillating": r"\frac{k\,e^{-\theta s}}{\tau_0^2s^2+2\zeta\tau_0 s+1}",
    "unstable": r"\frac{k'e^{-\theta s}}{s-a}",
}
LONG = 1.0  # s, from when on progress is told
UNKNOWN = 100.0  # ends of an interval that far apart tell nothing
UNITS = {"k": (1, 0), "k_prime": (1, -1), "k_double_prime": (1, -2), "zeta": (0, 0), "a": (0, -1)}


def fits_of(work: Work, part: Trend | None, design: Design, why: str) -> Fits:
    """All structures fitted; none, and why, where there is nothing to fit."""
    if part is None:
        return Fits((), why=why)
    more = state.widget("more_structures") or design.record.structure in MORE
    wanted = USUAL + (MORE if more else ())
    if work.is_fitted(design.record, wanted):
        return work.fitted(part, design.record, wanted)
    place, begun = st.empty(), monotonic()

    def progress(done: int, of: int) -> None:
        if monotonic() - begun > LONG:
            place.progress(done / of, words("Fitting: {done} of {n} structures", done=done, n=of))

    with st.spinner(words("Fitting"), show_time=True):
        found = work.fitted(part, design.record, wanted, progress)
    place.empty()
    return found


def chosen_of(fits: Fits, design: Design) -> Identified | None:
    """The model that is chosen, else the best."""
    return next((each for each in fits.found if each.structure == design.record.structure), None) or next(
        iter(fits.found), None
    )


def ranking(fits: Fits, model: Identified, trend: Trend) -> None:
    """All structures, the best first; one is chosen."""
    keys = [each.structure for each in fits.found]
    state.set_widget("structure", model.structure)
    st.segmented_control(
        words("Model, the best first"),
        keys,
        format_func=title_of,
        key="structure",
        required=True,
        on_change=_take,
    )
    st.toggle(
        words("More structures"),
        key="more_structures",
        help=words("A zero, oscillating, double integrating, unstable."),
    )
    unit = trend.units.get("t", "")
    rows = [
        {
            words("model"): title_of(each.structure),
            words("fit [%]"): numeral(f"{100 * each.fit:.1f}"),
            words("behind"): number(each.criterion) if each.criterion else words("best"),
            f"θ [{unit}]" if unit else "θ": number(each.parameters["theta"]),
            words("others"): ", ".join(
                f"{sign_of(name)} = {number(value)}" for name, value in each.parameters.items() if name != "theta"
            ),
        }
        for each in fits.found
    ]
    with st.expander(words("All fits")):
        st.dataframe(rows, hide_index=True, width="stretch", height="content")
        st.caption(
            words(
                "Behind: difference of the information criterion from the best. Up to 6 a structure fits nearly as "
                "well, and the simpler one is the safer choice."
            )
        )


def card(model: Identified, trend: Trend, names: list[str]) -> None:
    """The model with its 95 % intervals, and the verdicts.   names: of the records it was fitted to."""
    st.markdown(f"$\\displaystyle G(s) = {FORMULAS[model.structure]}$")
    cells = "".join(_cell(name, model, trend) for name in model.parameters)
    slope = ""
    if model.slope is not None and "tau1" in model.parameters:
        value, error = model.slope
        slope = _cell_html(
            "k/τ₁", number(value), f"± {number(model.estimate.half_width * error, 2)}", _unit("k_prime", trend)
        )
    label = escape(words("Parameters of the model with 95 % intervals"))
    st.html(f'<div class="typed model" role="group" aria-label="{label}">{cells}{slope}</div>')
    facts = [
        words("fit {share:.1f} %", share=100 * model.fit),
        translated(counted("{n} sample", "{n} samples", model.predicted.size)),
        words("noise {noise}", noise=number(model.noise, 2)),
    ]
    if model.correlation > 0.05:
        facts.append(
            words("correlation of neighbouring residuals {correlation}", correlation=number(model.correlation, 2))
        )
    st.caption(words("{facts}. Intervals: 95 %.", facts=", ".join(facts)))
    if model.verdicts:
        with st.container(key="verdicts"):
            st.warning("\n".join(f"- {sentence(verdict)}" for verdict in model.verdicts))
    apart = disagreement(model.gains)
    if apart is not None and apart.kind == "gain":
        st.button(
            words("A model for each operating point"),
            key="to_points",
            icon=":material/arrow_forward:",
            type="tertiary",
            on_click=lambda: state.set_widget("ways", points_view.TITLE),
        )
    if len(model.gains) > 1:
        _gains(model, trend, names)


def _gains(model: Identified, trend: Trend, names: list[str]) -> None:
    with st.expander(words("Gain of each move")):
        unit = trend.units.get("t", "")
        rows = [
            ({words("record"): f"{each.record + 1}: {names[each.record]}"} if len(names) > 1 else {})
            | {
                f"t [{unit}]" if unit else "t": number(each.t),
                "OP": f"{number(each.before)} → {number(each.after)}",
                words("gain"): number(each.gain),
                "± (95 %)": number(model.estimate.half_width * each.standard_error, 2),
            }
            for each in model.gains
        ]
        st.dataframe(rows, hide_index=True, width="stretch", height="content")
        st.caption(words("A linear process has the same gain at every move."))


def _take() -> None:
    if not state.overtaken("structure"):
        state.change(structure=state.widget("structure") or "")


def _cell(name: str, model: Identified, trend: Trend) -> str:
    low, high = model.intervals[name]
    return _cell_html(sign_of(name), number(model.parameters[name]), _between(low, high), _unit(name, trend))


def _cell_html(label: str, value: str, spread: str, unit: str) -> str:
    value, spread = symbols(value), symbols(spread)
    return f"<div><small>{label}</small><b>{value}</b> <i>{escape(unit)}</i><small>{spread}</small></div>"


def _unit(name: str, trend: Trend) -> str:
    """Of a parameter, empty where one of its units has no name."""
    gain, power = UNITS.get(name, (0, 1))
    t, y, u = (trend.units.get(each, "") for each in "tyu")
    if (gain and not (y and u)) or (power and not t):
        return ""
    first = ("1" if y == u else f"{y}/{u}") if gain else ""
    if not power:
        return "" if first == "1" else first
    if power == 1:
        return t
    below = t if power == -1 else f"{t}²"
    return f"{first or 1}/{below}" if "/" not in first else f"{y}/({u} {below})"


def _between(low: float, high: float) -> str:
    """An interval with as many digits as its width deserves."""
    size, width = max(abs(low), abs(high)), high - low
    if low > 0 and high > UNKNOWN * low:
        return words("not resolved")
    digits = 3 if not 0 < width < size else min(max(3, 1 + math.ceil(math.log10(size / width))), 8)
    return f"{number(low, digits)} … {number(high, digits)}"
