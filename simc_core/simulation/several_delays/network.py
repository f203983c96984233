"""Nested loops with every dead time pulled out, each on its own:

    x' = A x + B w + E v        z = C x + D w + F v        w_i(t) = z_i(t - theta_i)
    o  = Co x + Do w + Fo v     o = (y_1 .. y_N, u_1 .. u_N),  v = (r, d_1 .. d_N)

z_i is the input of block i: z_1 = u_1 + d_1, z_i = y_{i-1} + d_i; counted from the inside out as in nested.py, u_i the
output of controller i. The disturbance enters with the control signal, through the same states: responses to
it stay bounded where the loop is stable, also with unstable blocks. Controllers inside act on the error. A block
without dead time has its w eliminated.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from scipy.linalg import block_diag

from simc_core.algebra.state_space import chain
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.nested import NestedLoops
from simc_core.loops.well_posed import require_well_posed
from simc_core.wording import said


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """Matrices of the module docstring; theta (m,), all > 0.

    blocks: begin and end of blocks of states of which none needs a later block.
    """

    A: np.ndarray
    B: np.ndarray
    E: np.ndarray
    C: np.ndarray
    D: np.ndarray
    F: np.ndarray
    Co: np.ndarray
    Do: np.ndarray
    Fo: np.ndarray
    theta: np.ndarray
    blocks: tuple[tuple[int, int], ...] = field(init=False)

    def __post_init__(self) -> None:
        ends = [i for i in range(1, len(self.A) + 1) if not self.A[:i, i:].any()]
        object.__setattr__(self, "blocks", tuple(pairwise([0, *ends])))


def network(loops: NestedLoops) -> Network:
    """The loops as a Network.

    Raises InvalidParameter: derivative action without filter inside, or on what may jump; an ill-posed algebraic loop.
    """
    chains = [chain(block.factored) for block in loops.blocks]
    forms = [None if C is None else C.to_parallel() for C in loops.controllers]
    n_blocks, N = sum(len(each[1]) for each in chains), len(chains)
    n = n_blocks + sum((form.Ki != 0) + (form.tau_F > 0) for form in forms if form)
    width = n + N + 1 + N  # columns x, w, v
    states = np.zeros((n, width))  # rows of x'
    states[:n_blocks, :n_blocks] = block_diag(*(each[0] for each in chains))
    y, slopes, used = [], [], 0
    for i, (_, B, C, D) in enumerate(chains):
        here = slice(used, used + len(B))
        states[here, n + i] = B
        row = np.zeros(width)
        row[here], row[n + i] = C, D
        y.append(row)
        slopes.append(None if D else C @ states[here])
        used += len(B)
    u, v = [np.zeros(width)] * N, np.eye(width)[n + N :]
    set_point = v[0]
    for i in reversed(range(N)):
        form = forms[i]
        if form is not None:
            acting = form if i == N - 1 else _on_error(form)
            set_point, used = _controller(acting, set_point, y[i], slopes[i], states, used)
        u[i] = set_point
    z = np.array([(u[0] if i == 0 else y[i - 1]) + v[1 + i] for i in range(N)])
    theta = np.array([block.theta for block in loops.blocks])
    return _without(np.flatnonzero(theta == 0), _parts(states, z, np.array([*y, *u]), n, N, theta))


def integral_states(loops: NestedLoops) -> list[int | None]:
    """Which state of the Network holds the integral of controller i; None where it has none."""
    used = sum(block.order for block in loops.blocks)
    found: list[int | None] = [None] * len(loops.blocks)
    for i in reversed(range(len(loops.blocks))):
        controller = loops.controllers[i]
        if controller is None:
            continue
        form = controller.to_parallel()
        if form.Ki:
            found[i] = used
        used += (form.Ki != 0) + (form.tau_F > 0)
    return found


def _on_error(form: ParallelPid) -> ParallelPid:
    if form.Kd and not form.tau_F:
        raise InvalidParameter(
            said(
                "tau_F must be > 0 for derivative action of an inner controller, "
                "which differentiates what the outer one puts out, found 0"
            )
        )
    return ParallelPid(form.Kp, form.Ki, form.Kd, form.tau_F, 1.0, 1.0)


def _controller(
    form: ParallelPid, r: np.ndarray, y: np.ndarray, slope: np.ndarray | None, states: np.ndarray, used: int
) -> tuple[np.ndarray, int]:
    """Rows of the controller's states are entered from `used` on; the row of u and the next free state."""
    width = len(y)
    xi = np.zeros(width)
    if form.Ki:
        states[used] = form.Ki * (r - y)
        xi[used] = 1.0
        used += 1
    proportional = form.Kp * (form.b * r - y)
    if not form.tau_F:
        if not form.Kd:
            return xi + proportional, used
        if slope is None or form.c:
            raise InvalidParameter(said("tau_F must be > 0 for derivative action on a signal that may jump, found 0"))
        return xi + proportional - form.Kd * slope, used
    kick = form.Kd / form.tau_F * (form.c * r - y)
    filtered = np.zeros(width)
    filtered[used] = 1.0
    states[used] = (xi + proportional - kick - filtered) / form.tau_F
    return filtered + kick, used + 1


def _parts(states: np.ndarray, z: np.ndarray, outputs: np.ndarray, n: int, N: int, theta: np.ndarray) -> Network:
    (A, B, E), (C, D, F), (Co, Do, Fo) = (
        (rows[:, :n], rows[:, n : n + N], rows[:, n + N :]) for rows in (states, z, outputs)
    )
    return Network(A, B, E, C, D, F, Co, Do, Fo, theta)


def _without(gone: np.ndarray, system: Network) -> Network:
    """The w in `gone`, which have no delay, solved for: w_g = (I - D_gg)^-1 (C_g x + D_gk w_k + F_g v)."""
    if not gone.size:
        return system
    kept = np.setdiff1d(np.arange(len(system.theta)), gone)
    matrix = np.eye(len(gone)) - system.D[np.ix_(gone, gone)]
    require_well_posed(np.linalg.det(matrix))
    C, D, F = (np.linalg.solve(matrix, part[gone]) for part in (system.C, system.D[:, kept], system.F))
    rows = []
    for of_x, of_w, of_v in (
        (system.A, system.B, system.E),
        (system.C[kept], system.D[kept], system.F[kept]),
        (system.Co, system.Do, system.Fo),
    ):
        through = of_w[:, gone]
        rows.append((of_x + through @ C, of_w[:, kept] + through @ D, of_v + through @ F))
    (A, B, E), (C, D, F), (Co, Do, Fo) = rows
    return Network(A, B, E, C, D, F, Co, Do, Fo, system.theta[kept])
