"""A list to try: a small plant, seeded; settings that are good, sluggish, fragile or slow, and two mistakes."""

import numpy as np

LOOPS = 60
SEED = 7
KINDS = ("FC", "PC", "TC", "LC", "AC")
TIMES = {"FC": (0.5, 3.0), "PC": (1.0, 10.0), "TC": (10.0, 60.0), "AC": (30.0, 120.0)}  # dead times in s
FACTORS = (0.15, 0.4, 0.8, 1.0, 1.0, 1.1, 2.2, 3.6)  # of the SIMC gain


def example() -> str:
    """A list of LOOPS loops as CSV."""
    rng = np.random.default_rng(SEED)
    lines = ["tag,k,theta,tau1,tau2,k_prime,Kc,tau_I", ",PV/OP,s,s,s,PV/(OP s),OP/PV,s"]
    for i in range(LOOPS):
        kind = KINDS[i % len(KINDS)]
        lines.append(f"{kind}-{101 + i}," + (_level(rng) if kind == "LC" else _lag(rng, *TIMES[kind])))
    lines.append("TC-900,1.2,20,,,,3,60")
    lines.append("FC-901,0.8,1;5,4,,,1,4")
    return "\n".join(lines) + "\n"


def _lag(rng: np.random.Generator, low: float, high: float) -> str:
    theta, k = float(rng.uniform(low, high)), float(rng.uniform(0.3, 3))
    tau1 = theta * float(rng.uniform(0.5, 10))
    tau2 = f"{theta * rng.uniform(0.2, 0.8):.2g}" if rng.random() < 0.4 else ""
    Kc = float(rng.choice(FACTORS)) * tau1 / (2 * k * theta)
    return f"{k:.2g},{theta:.2g},{tau1:.2g},{tau2},,{Kc:.2g},{tau1 if rng.random() < 0.7 else min(tau1, 4 * theta):.2g}"


def _level(rng: np.random.Generator) -> str:
    theta, k = float(rng.uniform(1, 10)), 10 ** float(rng.uniform(-3, -1))
    Kc = float(rng.choice(FACTORS[1:])) / (2 * k * theta)
    return f",{theta:.2g},,,{k:.2g},{Kc:.2g},{float(rng.uniform(6, 25)) * theta:.2g}"
