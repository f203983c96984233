"""All results as one HTML file that needs nothing else: what it is worth to retune first, then a sheet a loop.

It is made from the lines of results.csv, so that a run in several parts has one report. Everything that came from a
list is escaped. No script, no address: it opens anywhere and prints.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path

from simc_core.figures.palette import css_variables
from simc_core.many.drawn import drawn
from simc_core.many.result import TROUBLES
from simc_core.many.results_csv import BETWEEN, SOUND
from simc_core.notation import number
from simc_core.reduction.records import LARGEST_MS
from simc_core.studies.bands import exceeds
from simc_core.wording import Text, counted, joined, said

Line = Mapping[str, str]

STYLE = Path(__file__).with_name("report.css").read_text(encoding="utf-8")
MOST_LINES, MOST_SHEETS, MOST_DRAWN = 20_000, 2_000, 300
WORTH = 1.5  # load IAE now over new, from which it is told
IN_SUMMARY = {
    "not stable": said("{n} not stable now", n=0),
    "fragile": said("{n} fragile now (Ms above {limit:g})", n=0, limit=LARGEST_MS),
    "slow oscillation": said("{n} oscillating slowly now", n=0),
}
TONES = {"not stable": "alarm", "fragile": "alarm", "slow oscillation": "attention"}
SETTINGS = {"Kc": "Kc", "tau_I": "τI", "tau_D": "τD", "tau_F": "τF", "K_I": "K_I"}
SHEET = {  # name of a line, what it is called
    "plant": "plant",
    "box": "box",
    "typed": "typed into it",
    "action": "action",
    "settings_now": "settings now",
}
MODEL = {"k": "k", "theta": "θ", "tau1": "τ1", "tau2": "τ2", "a": "a", "tau0": "τ0", "zeta": "ζ"}


def worth(line: Line) -> tuple[int, float]:
    """For sorting lines of results: what it is worth most to retune comes first.

    Loops that are not stable now, then fragile ones by their Ms, then those that oscillate slowly, then sound ones,
    these by how many times smaller the load IAE becomes; then loops without present settings, at last the refused.
    """
    if line["refusal"]:
        return len(TROUBLES) + 1, 0.0
    if not line["now"]:
        return len(TROUBLES), 0.0
    trouble = "" if line["now"] == SOUND else line["now"]
    size = _float(line["Ms_now" if trouble == "fragile" else "load_ratio"])
    return TROUBLES.index(trouble), 0.0 if math.isnan(size) else -size


def report(lines: Iterable[Line], title: str = "Many loops") -> str:
    """The report.

    Parameters
    ----------
    lines : iterable of mappings
        Lines of results.csv, or what `results_csv.cells` makes of results, in any order.
    title : str
        Its heading.

    Returns
    -------
    str
        HTML.
    """
    found = sorted(lines, key=worth)
    refused = [line for line in found if line["refusal"]]
    tuned = found[: len(found) - len(refused)]
    parts = [f"<h1>{escape(title)}</h1>", f"<p>{summary(found)}</p>", _list(tuned[:MOST_LINES])]
    if refused:
        parts.append(_refusals(refused[:MOST_LINES]))
    if tuned:
        parts.append("<h2>Loop by loop</h2>")
        if len(tuned) > MOST_SHEETS:
            parts.append(f"<p>The first {MOST_SHEETS}; all of them are in results.csv.</p>")
        parts += [
            _sheet(line, drawn(line, f"y{i}") if i < MOST_DRAWN else "") for i, line in enumerate(tuned[:MOST_SHEETS])
        ]
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{css_variables(':root')}{STYLE}</style></head><body>{''.join(parts)}</body></html>\n"
    )


def summary(lines: Sequence[Line]) -> Text:
    """How many loops there are, and how many of them need what."""
    refused = sum(bool(line["refusal"]) for line in lines)
    parts = [
        counted("{n} loop, {tuned} tuned", "{n} loops, {tuned} tuned", len(lines), tuned=len(lines) - refused),
    ]
    if refused:
        parts.append(said("{n} refused", n=refused))
    for trouble, told in IN_SUMMARY.items():
        if n := sum(line["now"] == trouble for line in lines):
            parts.append(told.put(n=n))
    faster = sum(line["now"] == SOUND and _float(line["load_ratio"]) >= WORTH for line in lines)
    if faster:
        parts.append(
            said("{n} sound now whose load IAE becomes at least {ratio:g} times smaller", n=faster, ratio=WORTH)
        )
    return joined((joined(parts), "."), "")


def _list(lines: Sequence[Line]) -> str:
    if not lines:
        return ""
    names = ("load IAE", "Ms now → new", *list(SETTINGS.values())[:3])
    head = "<th>loop</th><th class=words>now</th>" + "".join(f"<th>{name}</th>" for name in names)
    head += "<th class=words>typed into the box</th><th class=words>look at</th>"
    return f'<div class="wide"><table><tr>{head}</tr>{"".join(map(_entry, lines))}</table></div>'


def _entry(line: Line) -> str:
    gain = _shown(line["Kc"]) or (f"K_I {_shown(line['K_I'])}" if line["K_I"] else "")
    numbers = (_times(_float(line["load_ratio"])), _Ms(line), gain, _shown(line["tau_I"]), _shown(line["tau_D"]))
    cells = "".join(f"<td>{each}</td>" for each in numbers)
    look_at = escape(line["advice"].split(": ")[0])
    return (
        f"<tr><td>{_name(line)}</td><td class=words>{_now(line)}</td>{cells}"
        f"<td class=words>{escape(line['typed'])}</td><td class=words>{look_at}</td></tr>"
    )


def _refusals(lines: Sequence[Line]) -> str:
    entries = "".join(
        f"<tr><td>{_name(line)}</td><td>{escape(line['row'])}</td><td class=words>{escape(line['refusal'])}</td></tr>"
        for line in lines
    )
    head = "<tr><th>loop</th><th>row</th><th class=words>why</th></tr>"
    return f'<h2>Not tuned</h2><div class="wide"><table>{head}{entries}</table></div>'


def _sheet(line: Line, figure: str) -> str:
    """Everything that is known of a loop."""
    entries = {words: line[name] for name, words in SHEET.items() if line[name]}
    model = [f"{words} = {_shown(text)}" for name, words in MODEL.items() if (text := line[f"model_{name}"])]
    if model:
        entries["model"] = f"{line['model']}: {', '.join(model)}"
    settings = [f"{words} = {_shown(line[name])}" for name, words in SETTINGS.items() if line[name] not in ("", "0")]
    entries["new settings"] = f"{', '.join(settings)} ({line['form']} form)"
    entries["robustness"] = _robustness(line)
    entries["IAE"] = _integrals(line)
    if line["variants_stable"]:
        entries["variants"] = (
            f"{_float(line['variants_stable']):.0%} stable, Ms {_shown(line['variants_Ms_median'])} (median), "
            f"{_shown(line['variants_Ms_95'])} (95 %)"
        )
    rows = "".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in entries.items() if text)
    advice = "".join(f"<li>{escape(each)}</li>" for each in line["advice"].split(BETWEEN) if each)
    told = f"<dl>{rows}</dl>{figure}{f'<ul>{advice}</ul>' * bool(advice)}"
    return f"<details><summary>{_name(line)}</summary>{told}</details>"


def _robustness(line: Line) -> str:
    if not line["Ms"]:
        return "not stable"
    text = f"Ms {_shown(line['Ms'])}, gain margin {_shown(line['GM'])}, phase margin {_shown(line['PM_deg'])}°"
    return f"{text}, delay margin {_shown(line['delay_margin'])}" + (
        f"; now Ms {_shown(line['Ms_now'])}" if line["Ms_now"] else ""
    )


def _integrals(line: Line) -> str:
    if not line["IAE_load"]:
        return ""
    text = f"load {_shown(line['IAE_load'])}, set point {_shown(line['IAE_setpoint'])}"
    if line["IAE_load_now"]:
        text += f"; now load {_shown(line['IAE_load_now'])}, set point {_shown(line['IAE_setpoint_now'])}"
    return text


def _name(line: Line) -> str:
    return escape(line["tag"]) or f"row {escape(line['row'])}"


def _now(line: Line) -> str:
    now = line["now"] or "not told"
    return f'<span class="{TONES[now]}">{now}</span>' if now in TONES else escape(now)


def _Ms(line: Line) -> str:
    new = _toned(line["Ms"])
    return f"{_toned(line['Ms_now'])} → {new}" if line["now"] else new


def _toned(Ms: str) -> str:
    text = f"{_float(Ms):.2f}" if Ms else "not stable"
    return f'<span class="alarm">{text}</span>' if exceeds(_float(Ms), LARGEST_MS) else text


def _times(ratio: float) -> str:
    """A ratio of integrals in words."""
    if math.isnan(ratio):
        return ""
    return f"{number(ratio, 2)} times smaller" if ratio >= 1 else f"{number(1 / ratio, 2)} times larger"


def _float(text: str) -> float:
    """A number of a line; nan for an empty cell, or one that somebody has edited into something else."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def _shown(text: str) -> str:
    return number(_float(text)) if text else ""
