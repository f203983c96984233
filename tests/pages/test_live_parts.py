"""The pure parts of what runs in the browser, in node: numbers to compare with come from scipy and from the core."""

import base64
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import BarycentricInterpolator

from pages.common.live.kit.packing import pack
from pages.common.live.modules import bundled
from pages.common.live.spoken import spoken
from simc_core import Loop, Plant, margins
from simc_core.cascade.by_simc import simc_cascade
from simc_core.loops.frequency_grid import omega_grid
from simc_core.studies.tau_table import first_rows, stencil
from tests.pages.wrapped import BRACKETS, offer_brackets

SCRIPT = Path(__file__).with_name("live_parts.test.mjs")
KIT = Path(__file__).parents[2] / "pages" / "common" / "live" / "kit"
NAMES = ("Ms", "GM", "PM_deg", "delay_margin")


def stencils() -> list[dict]:
    """Values of a curve with kinks at the rows, and the polynomial of scipy through those that may be mixed."""
    rows = first_rows(0.1, 100.0, [1.7, 30.0])
    values = np.sin(2 * rows.x) + np.exp(rows.x / 4)
    found = []
    for x in np.linspace(rows.x[0], rows.x[-1], 301):
        first, weights = stencil(rows, x)
        taken = slice(first, first + len(weights))
        wanted = float(BarycentricInterpolator(rows.x[taken], values[taken])(x))
        case = {"nodes": rows.x.tolist(), "breaks": list(rows.breaks), "x": float(x), "first": int(first)}
        found.append(case | {"values": values.tolist(), "wanted": wanted})
    return found


def loops() -> list[dict]:
    """L of a first-order and an integrating loop, and the margins of the core."""
    found = []
    for plant, Ki in ((Plant(2, 1, (8,)), 4.0), (Plant(1, 0.3, (1,), integrators=1), 0.4)):
        loop = Loop(plant, simc_cascade(plant, Plant(1, Ki / 20, (Ki / 10,))).outer)
        omega = omega_grid([loop.L])
        L = loop.L(1j * omega)
        judged = margins(loop)
        curves = {"omega": omega, "re": L.real, "im": L.imag, "S": abs(1 / (1 + L)), "T": abs(L / (1 + L))}
        case = {name: values.tolist() for name, values in curves.items()}
        found.append(case | {"margins": {name: getattr(judged, name) for name in NAMES}})
    return found


def numbers() -> list[tuple[float, int, str]]:
    """Values with their digits, written by Python's own %g."""
    rng = np.random.default_rng(3)
    values = [*(rng.uniform(-1, 1, 40) * 10.0 ** rng.integers(-2, 5, 40)).tolist(), 0.0, 1.0, 20.0]
    return [(v, d, f"{float(f'{v:.{d}g}'):.17g}".replace("-", "−")) for v in values for d in (3, 4) if _plain(v, d)]


def _plain(value: float, digits: int) -> bool:
    """Whether %g writes it without exponent, and its 17 digits are those of the rounded number."""
    short = f"{value:.{digits}g}"
    return "e" not in short and f"{float(short):.17g}" == short


def test_pure_parts_in_node(tmp_path):
    y = [[1.0, 2.0, -0.5], [0.25, 4.0, 8.0]]
    packed = {"base64": base64.b64encode(pack({"kind": "table"}, {"y": np.array(y)})).decode(), "y": y}
    ranges = [(0.0, 1.05), (-0.3, 1.7), (12.0, 13.0), (0.0, 1e-4), (-250.0, 4000.0)]
    cases = {"stencils": stencils(), "loops": loops(), "packed": packed, "numbers": numbers(), "ranges": ranges}
    file = tmp_path / "cases.json"
    file.write_text(json.dumps(cases))
    run = subprocess.run(
        ["node", "--test", SCRIPT],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ | {"SIMC_CASES": str(file)},
    )
    assert run.returncode == 0, run.stdout[-4000:]


@pytest.mark.parametrize("shape", ["chain", "diamond"])
def test_modules_in_one_text_do_what_the_modules_do(tmp_path, shape):
    """Names that two files use for different things stay apart; a module that two files import runs once."""
    (tmp_path / "low.js").write_text("globalThis.runs = (globalThis.runs ?? 0) + 1;\nexport const size = 2;\n")
    (tmp_path / "left.js").write_text(
        'import { size } from "./low.js";\n\nconst own = 10;\n\nexport function left() {\n  return own * size;\n}\n'
    )
    (tmp_path / "right.js").write_text(
        'import { size as length } from "./low.js";\n\nconst own = 1;\n\n'
        "export class Right {\n  value = own + length;\n}\n"
    )
    both = 'import { Right } from "./right.js";\n' if shape == "diamond" else "class Right { value = 3; }\n"
    (tmp_path / "main.js").write_text(
        f'import {{\n  left,\n}} from "./left.js";\n{both}\n'
        "export default [left(), new Right().value, globalThis.runs];\n"
    )
    one = tmp_path / "one.mjs"
    one.write_text(bundled(tmp_path / "main.js"))
    script = f'import found from "{one.as_uri()}"; console.log(JSON.stringify(found));'
    run = subprocess.run(["node", "--input-type=module", "-e", script], capture_output=True, text=True, timeout=60)
    assert json.loads(run.stdout) == [20, 3, 1], run.stderr


def test_scripts_speak_the_language_that_stands_before_them(tmp_path, monkeypatch):
    offer_brackets(monkeypatch)
    (tmp_path / "main.js").write_text(
        f'import {{ plain, text }} from "{KIT}/format.js";\nimport {{ listed, said }} from "{KIT}/words.js";\n\n'
        'export default [said("Key {n}", { n: text(1.5) }), said("not ours {n}", { n: 2 }), text(-1234.5, 5), '
        "plain(0.5), text(1e-9), listed([text(0.5), text(2)])];\n"
    )
    one = tmp_path / "one.mjs"
    found = {}
    for language in ("en", BRACKETS):
        one.write_text(spoken(language) + bundled(tmp_path / "main.js"))
        script = f'import found from "{one.as_uri()}"; console.log(JSON.stringify(found));'
        run = subprocess.run(["node", "--input-type=module", "-e", script], capture_output=True, text=True, timeout=60)
        assert not run.stderr
        found[language] = json.loads(run.stdout)
    assert found["en"] == ["Key 1.5", "not ours 2", "−1234.5", "0.5", "1e−9", "0.5, 2"]
    assert found[BRACKETS] == ["⟦Key 1,5⟧", "not ours 2", "−1234,5", "0.5", "1e−9", "0,5; 2"]
