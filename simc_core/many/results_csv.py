"""Results as a CSV file that grows row by row: a run that was stopped goes on where it was, with what is asked now.

One line a loop, whatever is in its cells; text that a spreadsheet would take for a formula has an apostrophe in front.
"""

import csv
import io
import math
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from simc_core.controllers.forms import IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.many.result import Result
from simc_core.metrics.performance import Performance
from simc_core.notation import plain
from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import Numeral, Text, joined, said

HEAD = (
    *("row", "tag", "refusal", "plant", "form", "Kc", "tau_I", "tau_D", "tau_F", "K_I"),
    *("Ms", "Mt", "GM", "PM_deg", "delay_margin", "IAE_load", "IAE_setpoint", "overshoot", "settling_time"),
    *("model", "model_k", "model_theta", "model_tau1", "model_tau2", "model_a", "model_tau0", "model_zeta"),
    *("now", "form_now", "settings_now", "tau_F_now", "Ms_now", "IAE_load_now", "IAE_setpoint_now", "load_ratio"),
    *("box", "typed", "action", "variants_stable", "variants_Ms_median", "variants_Ms_95", "advice", "asked"),
)
SOUND = "sound"
BETWEEN = " | "  # two advices
FORMULA = ("=", "+", "-", "@", "\t", "\r")
LONGEST_CELL = 2000  # characters
FORMS: dict[type, str] = {SeriesPid: "series", IdealPid: "ideal", ParallelPid: "parallel", IController: "I"}
GAINS = ("k", "k_prime", "k_double_prime")
MODELS: dict[type, str] = {
    FirstOrderDelay: "first order",
    SecondOrderDelay: "second order",
    IntegratingDelay: "integrating",
    DoubleIntegratingDelay: "double integrating",
    UnstableDelay: "unstable",
    OscillatingDelay: "oscillating",
}


def cells(result: Result) -> dict[str, str]:
    """A result by the names of HEAD; what is not known is empty."""
    row = result.row
    found = {"row": str(row.get("row", "")), "tag": safe(result.tag), "refusal": safe(result.refusal)}
    if result.plant is not None:
        found["plant"] = safe(plain(result.plant))
    if result.controller is not None:
        controller = result.controller
        found["form"] = FORMS[type(controller)]
        found |= {name: _number(getattr(controller, name)) for name in controller.SETTINGS if name in HEAD}
        found["tau_F"] = _number(getattr(controller, "tau_F", 0.0))
    if result.margins is not None:
        found |= _margins(result.margins)
    if result.performance is not None:
        found |= _performance(result.performance)
    if result.model is not None:
        found |= _model(result.model)
    if result.present is not None:
        now = result.present
        found["now"] = result.trouble or SOUND
        found["form_now"] = FORMS[type(now.controller)]
        found["tau_F_now"] = _number(getattr(now.controller, "tau_F", 0.0))
        found["settings_now"] = ", ".join(f"{name} = {value:.6g}" for name, value in now.controller.settings.items())
        found["Ms_now"] = _number(now.margins.Ms)
        if now.performance is not None:
            found["IAE_load_now"] = _number(now.performance.disturbance.IAE)
            found["IAE_setpoint_now"] = _number(now.performance.setpoint.IAE)
        found["load_ratio"] = _number(result.load_ratio)
    if result.typed is not None:
        found["box"] = safe(str(row.get("box", "")))
        found["typed"] = safe(typed_text(result))
        found["action"] = result.typed.action
    if result.robust is not None:
        found["variants_stable"] = _number(result.robust.stable)
        found["variants_Ms_median"] = _number(result.robust.Ms_median)
        found["variants_Ms_95"] = _number(result.robust.Ms_95)
    found["advice"] = safe(
        BETWEEN.join(f"{each.headline}: {each.text} {each.remedy}".strip() for each in result.advice)
    )
    found["asked"] = asked(row, "")
    return {name: found.get(name, "") for name in HEAD}


def asked(row: Mapping[str, Any], how: str) -> str:
    """A sum over what a row asks for, its number apart, and how the run does it: the same for the same question."""
    told = sorted((name, str(value)) for name, value in row.items() if name != "row")
    return f"x{zlib.crc32(repr((told, how)).encode(errors='replace')):08x}"


def typed_text(result: Result) -> Text:
    """What is typed into the box, on one line."""
    if result.typed is None:
        return joined(())
    shown = (
        (name, value if isinstance(value, str) else Numeral(f"{value:.10g}"))
        for name, value in result.typed.values.items()
    )
    return joined((joined(each, " = ") for each in shown), "; ")


def as_csv(results: Iterable[Result]) -> str:
    """All results in one text, with the headings."""
    text = io.StringIO()
    writer = csv.DictWriter(text, HEAD, lineterminator="\n")
    writer.writeheader()
    writer.writerows(cells(result) for result in results)
    return text.getvalue()


class ResultsFile:
    """A file of results of a list, written as they come.

    path: a new file, or one of an earlier run. A broken last line is cut off, and so are results of rows of this list
    that have changed since; those of other lists stay.
    left: rows that are not in the file yet; a question that is there n times covers the first n rows that ask it.
    changed: how many results were cut off.   how: the run does it; another way is another question.
    Raises InvalidParameter where there is a file of another kind.
    """

    def __init__(self, path: Path, rows: Iterable[Mapping[str, Any]], how: str = ""):
        self.path, self._how = path, how
        self.left = list(rows)
        self.changed = 0
        if self._begin():
            self._compare()

    def __enter__(self) -> "ResultsFile":
        self._file = self.path.open("a", encoding="utf-8", newline="")
        self._writer = csv.DictWriter(self._file, HEAD, lineterminator="\n")
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def write(self, result: Result) -> None:
        """One line, on the disk at once."""
        self._writer.writerow(cells(result) | {"asked": asked(result.row, self._how)})
        self._file.flush()

    def read(self) -> Iterator[dict[str, str]]:
        """All lines of the file."""
        with self.path.open(encoding="utf-8", newline="") as file:
            yield from csv.DictReader(file)

    def _begin(self) -> bool:
        """Whether there are whole lines of an earlier run."""
        head = ",".join(HEAD) + "\n"
        if not self.path.exists() or not self.path.stat().st_size:
            self.path.write_text(head, encoding="utf-8", newline="")
            return False
        content = self.path.read_bytes()
        whole = content[: content.rfind(b"\n") + 1]
        if not whole.startswith(head.encode()):
            raise InvalidParameter(
                said(
                    "{path} must be a file of results of this program, found another: move it, or take another folder",
                    path=self.path,
                )
            )
        if whole != content:
            self.path.write_bytes(whole)
        return True

    def _compare(self) -> None:
        """What is in the file, with what is asked now."""
        wanted = Counter((_key(row), asked(row, self._how)) for row in self.left)
        loops = {key for key, _ in wanted}
        done: Counter[tuple[str, str]] = Counter()
        kept = []
        for line in self.read():
            question = line["tag"] or f"#{line['row']}", line["asked"]
            if done[question] < wanted[question]:
                done[question] += 1
            elif question[0] in loops:
                self.changed += 1
                continue
            kept.append(line)
        if self.changed:
            self._rewrite(kept)
        left = []
        for row in self.left:
            question = _key(row), asked(row, self._how)
            if done[question]:
                done[question] -= 1
            else:
                left.append(row)
        self.left = left

    def _rewrite(self, lines: Iterable[Mapping[str, str]]) -> None:
        new = self.path.with_suffix(".new")
        with new.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, HEAD, lineterminator="\n")
            writer.writeheader()
            writer.writerows(lines)
        new.replace(self.path)


def _key(row: Mapping[str, Any]) -> str:
    return safe(Result(row).tag) or f"#{row.get('row', '')}"


def safe(text: str) -> str:
    """Text of a cell: one line, not too long, and no formula."""
    line = "".join(c if c.isprintable() else " " for c in text).strip()
    if len(line) > LONGEST_CELL:
        line = line[: LONGEST_CELL - 3] + "..."
    return f"'{line}" if line.startswith(FORMULA) else line


def _margins(found: Margins) -> dict[str, str]:
    return {name: _number(getattr(found, name)) for name in ("Ms", "Mt", "GM", "PM_deg", "delay_margin")}


def _performance(found: Performance) -> dict[str, str]:
    return {
        "IAE_load": _number(found.disturbance.IAE),
        "IAE_setpoint": _number(found.setpoint.IAE),
        "overshoot": _number(found.setpoint.overshoot),
        "settling_time": _number(found.setpoint.settling_time),
    }


def _model(model: Model) -> dict[str, str]:
    gain = next(getattr(model, name) for name in GAINS if hasattr(model, name))
    found = {"model": MODELS[type(model)], "model_k": _number(gain), "model_theta": _number(model.theta)}
    return found | {
        f"model_{name}": _number(getattr(model, name))
        for name in ("tau1", "tau2", "a", "tau0", "zeta")
        if hasattr(model, name)
    }


def _number(value: float) -> str:
    """All digits; empty for what does not exist."""
    return "" if math.isnan(value) else repr(value).removesuffix(".0")
