"""A row of a list as a design, to go on with it on the other pages. Pure: no streamlit."""

from pages.common.session.design import Design
from pages.common.session.fields import put
from pages.common.session.sheet import LONGEST
from simc_core import Result, SimcError
from simc_core.many.request import number, read_request


def design_of(result: Result) -> Design:
    """Plant, tuning, settings now, box, tag and ranges of a row. What another page does not take is left out.

    Raises SimcError where the row has no plant.
    """
    request = read_request(result.row)
    design = put(Design(), "plant", request.plant)
    given: dict[str, object] = {
        "tag": result.tag[: LONGEST["tag"]],
        "unit": request.time_unit if result.row.get("time_unit") else "",
        "order": 2 if request.kind == "PID" else 1,
        "filter": request.filter,
        "tau_c": request.tau_c,
        "now": request.present,
        "box": request.box,
    }
    for signal, name in (("PV", "pv_span"), ("OP", "out_span")):
        if (span := number(result.row, name)) is not None:
            given |= {f"{signal}_high": span, f"{signal}_low": 0.0}
    if result.controller is not None and result.model is None:  # another rule, or an Ms asked for
        given |= {"own": result.controller, "controller": "own"}
    for name, value in given.items():
        try:
            design = put(design, name, value)
        except SimcError:
            continue
    return design
