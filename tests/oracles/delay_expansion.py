"""Loops in many digits, by methods that share no code with simc_core: what its numbers are tested against.

The dead time is taken out of the loop by the geometric series, of which only the terms with k theta < t matter:

    y_r = sum_{k>=1} (-1)^{k+1} Laplace^{-1}[(g C)^k/s](t - k theta)             unit step of the set point
    y_d = sum_{k>=0} (-1)^k Laplace^{-1}[g (g C)^k/s](t - (k+1) theta)           unit step of the load

each a rational function, inverted by its Taylor series in t or on a Talbot contour. Without dead time the closed loop
itself is rational. The controller has one degree of freedom, b = c = 1. Call them inside mp.workdps.
"""

from itertools import pairwise

import mpmath as mp


def by_series(plant, C, until, terms=24):
    """y of the unit set-point step and of the unit load step at `until`, theta > 0; C: the controller's Factored."""
    g, theta = plant.factored, mp.mpf(plant.theta)

    def rational(F, power):
        num, den = [mp.mpf(F.gain) ** power], [mp.mpf(1)]
        for _ in range(power):
            for row in F.num:
                num = multiply(num, row)
            for row in F.den:
                den = multiply(den, row)
        return num, den

    answer = []
    for load in (False, True):
        total, k = mp.mpf(0), 0 if load else 1
        while (k + load) * theta < until and k <= terms:
            t = mp.mpf(until) - (k + load) * theta
            n1, d1 = rational(g, k + load)
            n2, d2 = rational(C, k)
            series = taylor(multiply(n1, n2), multiply(multiply(d1, d2), [1, 0]), t)
            total += (-1) ** (k if load else k + 1) * series
            k += 1
        answer.append(total)
    return answer


def multiply(p, q):
    """Product of polynomials, descending powers."""
    q = [mp.mpf(float(c)) for c in q]
    out = [mp.mpf(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def taylor(num, den, t, most=900):
    """Inverse Laplace transform of num/den at t by its series sum_j c_j t^j/j!, where c_j are the Markov parameters."""
    while num and num[0] == 0:
        num = num[1:]
    while den[0] == 0:
        den = den[1:]
    shift = len(den) - len(num)
    lead, c, total, j = den[0], [], mp.mpf(0), 0
    power = t ** (shift - 1) / mp.factorial(shift - 1)
    while j < most:
        value = (num[j] if j < len(num) else mp.mpf(0)) - sum(
            den[i] * c[j - i] for i in range(1, min(j, len(den) - 1) + 1)
        )
        c.append(value / lead)
        term = c[-1] * power
        total += term
        if j > 4 * len(den) and abs(term) < mp.mpf(10) ** -30 and abs(c[-1] * power) < mp.mpf(10) ** -30:
            break
        j += 1
        power = power * t / (j + shift - 1)
    return total


def by_contour(plant, controller, until):
    """The same for any theta >= 0, from time constants and settings (series form) alone."""

    def g(s):
        value = mp.mpf(plant.k) / s**plant.integrators
        for T in plant.leads:
            value *= mp.mpf(T) * s + 1
        for tau in plant.lags:
            value /= mp.mpf(tau) * s + 1
        for tau, zeta in plant.lag_pairs:
            value /= mp.mpf(tau) ** 2 * s**2 + 2 * mp.mpf(zeta) * mp.mpf(tau) * s + 1
        return value

    def C(s):
        Kc, tau_I, tau_D, tau_F = map(mp.mpf, (controller.Kc, controller.tau_I, controller.tau_D, controller.tau_F))
        return Kc * (tau_I * s + 1) / (tau_I * s) * (tau_D * s + 1) / (tau_F * s + 1)

    theta, t = mp.mpf(plant.theta), mp.mpf(until)
    if not theta:
        closed = (lambda s: g(s) * C(s) / (1 + g(s) * C(s)) / s, lambda s: g(s) / (1 + g(s) * C(s)) / s)
        return [talbot(F, t) for F in closed]
    answer = []
    for load in (0, 1):
        total, k = mp.mpf(0), 1 - load
        while (k + load) * theta < t:
            sign = (-1) ** (k + 1 - load)
            total += sign * talbot(lambda s, k=k, load=load: g(s) ** (k + load) * C(s) ** k / s, t - (k + load) * theta)
            k += 1
        answer.append(total)
    return answer


def talbot(F, t, nodes=110):
    """Fixed Talbot method (Abate and Valko 2004): about 0.6 digits a node, working digits the same number."""
    r = mp.mpf(2 * nodes) / (5 * t)
    total = mp.exp(r * t) * F(r) / 2
    for j in range(1, nodes):
        angle = j * mp.pi / nodes
        cot = mp.cot(angle)
        s = r * angle * (cot + mp.j)
        total += mp.re(mp.exp(s * t) * F(s) * (1 + mp.j * (angle + (angle * cot - 1) * cot)))
    return total * r / nodes


def delayed_integrator_metrics(K, intervals):
    """IAE, ISE, ITAE, TV of u, overshoot, peak time of L = K e^{-s}/s after a unit set-point step.

    u' = K (1 - y), y(t) = u(t - 1): on each unit of time u is a polynomial in tau = t - i (ascending here), one order
    higher than on the one before. e = 1 - y is split at its roots. What lies behind `intervals` is left out.
    """
    K, u = mp.mpf(K), [[mp.mpf(0), mp.mpf(K)]]
    e = [[mp.mpf(1)]]
    for i in range(1, intervals):
        y = u[i - 1]
        e.append([1 - y[0], *(-c for c in y[1:])])
        rising = [K * c / (j + 1) for j, c in enumerate(e[i])]
        u.append([_at(u[i - 1], 1), *rising])
    IAE = ISE = ITAE = TV = mp.mpf(0)
    peak, peak_time = mp.mpf(0), mp.mpf(0)
    for i, p in enumerate(e):
        cuts = [mp.mpf(0), *_roots(p), mp.mpf(1)]
        for a, b in pairwise(cuts):
            size = abs(_integral(p, a, b))
            IAE += size
            ITAE += abs(_integral(_times(p, [mp.mpf(i), mp.mpf(1)]), a, b))
            TV += K * size
            if b < 1 and _at(u[i], b) > peak:
                peak, peak_time = _at(u[i], b), i + 1 + b  # u' = K e is 0: y has its peak a unit later
        ISE += _integral(_times(p, p), mp.mpf(0), mp.mpf(1))
    return {"IAE": IAE, "ISE": ISE, "ITAE": ITAE, "TV": TV, "overshoot": peak - 1, "peak_time": peak_time}


def _at(p, x):
    value = mp.mpf(0)
    for c in reversed(p):
        value = value * x + c
    return value


def _times(p, q):
    out = [mp.mpf(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def _integral(p, a, b):
    return sum(c / (j + 1) * (b ** (j + 1) - a ** (j + 1)) for j, c in enumerate(p))


def _roots(p):
    """Sign changes in (0, 1), by halving where samples differ in sign."""
    places = [mp.mpf(i) / 64 for i in range(65)]
    values = [_at(p, x) for x in places]
    found = []
    for a, b, fa, fb in zip(places[:-1], places[1:], values[:-1], values[1:], strict=True):
        if fa * fb < 0:
            for _ in range(mp.mp.prec + 8):
                middle = (a + b) / 2
                a, b = (middle, b) if _at(p, middle) * fa > 0 else (a, middle)
            found.append(a)
    return found


def peak_of_S(L, near):
    """max |1/(1 + L(j omega))| and its omega, for the peak `near`."""

    def slope(omega):
        return mp.diff(lambda x: abs(1 + L(mp.j * x)), omega)

    omega = mp.findroot(slope, near)
    return 1 / abs(1 + L(mp.j * omega)), omega


def crossing_margins(L, near_180, near_c):
    """GM, PM in degrees, and delay margin of the crossings near omega_180 and omega_c."""
    omega_180 = mp.findroot(lambda x: mp.im(L(mp.j * x)) / abs(L(mp.j * x)), near_180)
    omega_c = mp.findroot(lambda x: abs(L(mp.j * x)) - 1, near_c)
    PM = mp.arg(-L(mp.j * omega_c))
    return 1 / abs(L(mp.j * omega_180)), mp.degrees(PM), PM / omega_c
