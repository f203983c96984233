"""A loop with limits on u and back-calculation, by solve_ivp from one dead time to the next."""

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp


def by_steps(k, tau, theta, Kc, tau_I, limits, T_t, t_end, load_at, load):
    """y of k e^{-theta s}/(tau s + 1) under PI with back calculation, r = 1, from one dead time to the next."""
    low, high = limits
    former, state, t, y = None, [0.0, 0.0], [], []

    def u_of(y, integral):
        v = Kc * (1 - y) + integral
        return v, min(max(v, low), high)

    for k_theta in np.arange(0.0, t_end, theta):
        edges = sorted({k_theta, k_theta + theta, *(x for x in (load_at + theta,) if 0 < x - k_theta < theta)})
        parts = []
        for begin, end in pairwise(edges):
            d = load if begin >= load_at + theta else 0.0

            def right(now, x, d=d, former=former):
                v, u = u_of(*x)
                late = 0.0 if former is None else u_of(*former(now - theta))[1]
                return [(k * (late + d) - x[0]) / tau, Kc / tau_I * (1 - x[0]) + (u - v) / T_t]

            found = solve_ivp(right, (begin, end), state, rtol=1e-9, atol=1e-11, max_step=theta / 40, dense_output=True)
            parts.append((begin, found.sol))
            state = found.y[:, -1]
        t.append(end)
        y.append(state[0])

        def former(now, parts=parts):
            return next(sol for begin, sol in reversed(parts) if now >= begin or begin == parts[0][0])(now)

    return np.array(t), np.array(y)
