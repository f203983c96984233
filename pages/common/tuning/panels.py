"""The figures of the tuning page: four panels side by side, on a narrow screen one at a time; Bode beside them."""

from pages.common.parts.panel import Panel, field, show
from pages.common.session.excitation import Excitation
from pages.common.studies.single import Study, common_grid, frequency_responses, time_responses
from pages.common.words import words
from simc_core.figures import (
    input_figure,
    nyquist_figure,
    open_loop_figure,
    output_figure,
    sensitivity_figure,
)
from simc_core.figures.curves import bode_curve
from simc_core.sensitivity.margins import crossings

HEIGHT, TALL = 250, 480  # px


def panels(studies: list[tuple[str, Study]], excitation: Excitation) -> None:
    """y, u, Nyquist, |S| and |T| of the present design (first) and the pinned ones."""
    names, records = [name for name, _ in studies], [each for _, each in studies]
    present = records[0]
    times = list(zip(names, time_responses(records, excitation), strict=True))
    frequencies = list(zip(names, frequency_responses(records), strict=True))
    y, u = output_figure(times, HEIGHT, present.stable), input_figure(times, HEIGHT, present.stable)
    nyquist = nyquist_figure(frequencies, present.margins, HEIGHT)
    sensitivity = sensitivity_figure(frequencies, present.margins, HEIGHT)
    field(
        (
            Panel("y", "y", words("Output y after a set-point step and a load step"), y),
            Panel("u", "u", words("Controller output u after a set-point step and a load step"), u),
            Panel("nyquist", words("Nyquist"), words("Nyquist curve of L with Ms and Mt circles"), nyquist),
            Panel("sensitivity", "|S| |T|", words("Magnitude of S and T over frequency"), sensitivity),
        )
    )


def open_loop(studies: list[tuple[str, Study]]) -> None:
    """Bode diagram of L with the margins drawn in."""
    omega = common_grid([each for _, each in studies])
    curves = [(name, bode_curve(each.loop.L, omega)) for name, each in studies]
    present = studies[0][1]
    figure = open_loop_figure(curves, present.margins, crossings(present.loop), TALL)
    show(figure, "open_loop", words("Bode diagram of the open loop L"))
