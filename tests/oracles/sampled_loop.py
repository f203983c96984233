"""A plant k e^{-theta s}/prod(tau s + 1) under any sampled controller, one sample after another, exact between them."""

import math

import numpy as np
from scipy.linalg import expm
from scipy.signal import tf2ss


def driven(k, theta, lags, h, controller, r):
    """y and u at 0, h, 2h, ...: controller(r, y) -> u, for the set points r.

    With theta = (n + f) h, 0 <= f < 1, the input of the plant is u[j - n - 1] for f h after sample j, then u[j - n].
    """
    A, B, C, _ = tf2ss([k], np.poly([-1 / tau for tau in lags]) * math.prod(lags))
    n = math.floor(theta / h + 1e-9)
    late = max(theta - n * h, 0.0)

    def hold(x, u, dt):
        M = np.zeros((len(A) + 1, len(A) + 1))
        M[:-1, :-1], M[:-1, -1:] = A * dt, B * dt
        return (expm(M) @ [*x, u])[:-1]

    x, inputs, outputs = np.zeros(len(A)), [0.0] * (n + 1), []
    for j, now in enumerate(r):
        outputs.append((C @ x).item())
        inputs.append(controller(now, outputs[-1]))
        x = hold(x, inputs[j], late)
        x = hold(x, inputs[j + 1], h - late)
    return np.array(outputs), np.array(inputs[n + 1 :])
