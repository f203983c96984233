"""Trends made by the program, to try the page at once: honest noise, always the same. Pure: no streamlit.

Each is the text of a file, which is read as any other.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simc_core.wording import Numeral, said

Array = NDArray[np.float64]
Control = Callable[[int, float], float]


@dataclass(frozen=True, slots=True)
class Example:
    """title, note: for the choice.   truth: the process that made it, in words.   make: gives the text of the file."""

    title: str
    note: str
    truth: str
    make: Callable[[], str]


@dataclass(frozen=True, slots=True)
class Process:
    """k e^{-theta s}/(tau s + 1), or k' e^{-theta s}/s where tau is inf; exact for an input that is held over h."""

    k: float
    theta: float
    tau: float
    h: float = 1.0

    def run(self, n: int, control: Control, noise: Array, y0: float, u0: float) -> tuple[Array, Array]:
        """PV as measured and OP, shape (n,). control: OP from the sample's number and the measured PV."""
        decay = 0.0 if np.isinf(self.tau) else np.exp(-self.h / self.tau)
        late, x = round(self.theta / self.h), 0.0
        y, u = np.empty(n), np.empty(n)
        for i in range(n):
            y[i] = y0 + x + noise[i]
            u[i] = control(i, y[i])
            moved = (u[i - late] if i >= late else u0) - u0
            x = x + self.k * self.h * moved if np.isinf(self.tau) else decay * x + self.k * (1 - decay) * moved
        return y, u


def _noise(n: int, sigma: float, seed: int) -> Array:
    return sigma * np.random.default_rng(seed).standard_normal(n)


def _steps(u0: float, *moves: tuple[int, float]) -> Control:
    def control(i: int, y: float) -> float:
        return next((value for at, value in reversed(moves) if i >= at), u0)

    return control


def _text(header: str, columns: tuple[Array, ...], digits: tuple[int, ...]) -> str:
    rows = zip(
        *([f"{value:.{many}f}" for value in column] for column, many in zip(columns, digits, strict=True)), strict=True
    )
    return header + "\n" + "\n".join(map(";".join, rows)) + "\n"


def _open_loop(
    process: Process, n: int, control: Control, sigma: float, seed: int, y0: float, u0: float, digits: int = 3
) -> str:
    y, u = process.run(n, control, _noise(n, sigma, seed), y0, u0)
    return _text("Time [s];PV [°C];OP [%]", (process.h * np.arange(n), y, u), (1, digits, 1))


def _step() -> str:
    return _open_loop(Process(1.5, 12, 60), 700, _steps(40, (60, 46), (380, 40)), 0.06, 11, 62, 40)


def _noisy() -> str:
    return _open_loop(Process(0.8, 20, 45), 900, _steps(30, (90, 40), (360, 30), (620, 35)), 0.7, 12, 85, 30)


def _integrating() -> str:
    process = Process(0.002, 16, np.inf)
    y, u = process.run(600, _steps(50, (60, 60), (200, 40), (340, 50)), _noise(600, 0.05, 13), 48, 50)
    return _text("Time [s];Level [%];Valve [%]", (np.arange(600.0), y, u), (1, 3, 1))


def _closed_loop() -> str:
    Kc, tau_I, level = 1.1, 40.0, 55.0
    r = np.where(np.arange(900) < 60, 70.0, np.where(np.arange(900) < 480, 75.0, 68.0))
    integral = 0.0

    def control(i: int, y: float) -> float:
        nonlocal integral
        integral += (r[i] - y) / tau_I
        return level + Kc * (r[i] - y + integral)

    y, u = Process(1.5, 10, 40).run(900, control, _noise(900, 0.05, 14), 70, level)
    return _text("Time [s];SP [°C];PV [°C];OP [%]", (np.arange(900.0), r, y, u), (1, 1, 3, 2))


def _relay() -> str:
    up = True

    def control(i: int, y: float) -> float:
        nonlocal up
        if i < 40:
            return 50.0
        up = y < 60 + 0.3 if up else y < 60 - 0.3
        return 56.0 if up else 46.0

    y, u = Process(1.2, 15, 80).run(900, control, _noise(900, 0.05, 15), 60, 50)
    return _text("Time [s];PV [°C];OP [%]", (np.arange(900.0), y, u), (1, 3, 1))


def _sticking() -> str:
    """The valve stands still until OP has gone 1 % beyond where it stands."""
    stem = 40.0
    told = np.empty(1100)
    moves = _steps(40, (60, 46), (300, 52), (540, 46), (800, 40))

    def control(i: int, y: float) -> float:
        nonlocal stem
        told[i] = moves(i, y)
        stem = told[i] - np.clip(told[i] - stem, -1.0, 1.0)
        return stem

    y, _ = Process(2.0, 10, 35).run(1100, control, _noise(1100, 0.05, 16), 50, 40)
    return _text("Time [s];Flow [m3/h];OP [%]", (np.arange(1100.0), y, told), (1, 3, 1))


def _day() -> str:
    moves = tuple((3600 * hour, 45.0 + 5 * (hour % 2)) for hour in range(1, 23, 3))
    return _open_loop(Process(1.2, 90, 700), 86_400, _steps(45, *moves), 0.15, 17, 120, 45, digits=2)


EXAMPLES: dict[str, Example] = {
    "step": Example(
        said("Step test, up and down"),
        said("A heater, a sample a second."),
        Numeral("k = 1.5 °C/%, θ = 12 s, τ₁ = 60 s"),
        _step,
    ),
    "noisy": Example(
        said("Noisy measurement"),
        said("Noise of a tenth of the response."),
        Numeral("k = 0.8 °C/%, θ = 20 s, τ₁ = 45 s"),
        _noisy,
    ),
    "integrating": Example(
        said("Level that integrates"), said("Up, down and back."), Numeral("k' = 0.002 1/s, θ = 16 s"), _integrating
    ),
    "closed_loop": Example(
        said("Closed loop, set point moved"),
        said("PI control, SP is there too."),
        Numeral("k = 1.5 °C/%, θ = 10 s, τ₁ = 40 s"),
        _closed_loop,
    ),
    "relay": Example(
        said("Relay test"),
        said("OP switches between 46 and 56 %."),
        Numeral("k = 1.2 °C/%, θ = 15 s, τ₁ = 80 s"),
        _relay,
    ),
    "sticking": Example(
        said("Valve that sticks"),
        said("The stem follows OP with 1 % of play."),
        said("k = 2, θ = 10 s, τ₁ = 35 s behind the play"),
        _sticking,
    ),
    "day": Example(
        said("A day at one second"), said("86 400 samples."), Numeral("k = 1.2 °C/%, θ = 90 s, τ₁ = 700 s"), _day
    ),
}


@cache
def text_of(key: str) -> str:
    """The file of an example."""
    return EXAMPLES[key].make()
