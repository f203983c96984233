"""The loop, and the one block diagram that fixes all signs.

                                      d
                                      |
    r ---->[ C_r ]--->(+)---- u --->(+)--->[ G = g e^{-theta s} ]----+---> y
                       ^ -                                           |
                       |                                             |
                       +-----------------[ C ]<----------------------+

    u = C_r r - C y        y = G (u + d)        L = G C
    S = 1/(1+L)   T = L/(1+L)   KS = C/(1+L)   GS = G/(1+L)

C is `controller.response`, C_r `controller.setpoint_response`. With b = c = 1 C_r = C.
"""

from dataclasses import dataclass
from functools import lru_cache

from simc_core.algebra.factors import Factored
from simc_core.controllers.forms import Controller
from simc_core.plants.plant import Plant


@dataclass(frozen=True, slots=True)
class Loop:
    """A plant under feedback: the block diagram in the module docstring fixes all signs.

    Parameters
    ----------
    plant : Plant
        G, dead time exact.
    controller : SeriesPid, IdealPid, ParallelPid or IController
        C in the feedback path, with its set-point weights.

    Examples
    --------
    L = G C, here e^{-s}/(2 s):

    >>> from simc_core import Loop, Plant, SeriesPid
    >>> complex(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)).L(0.5j).round(6))
    (-0.479426-0.877583j)
    """

    plant: Plant
    controller: Controller

    @property
    def L(self) -> Factored:
        """Loop transfer function G C, exact dead time."""
        return transfer_function(self)


TOGETHER = 1024  # of a list of loops as many are worked on together


@lru_cache(maxsize=TOGETHER)
def transfer_function(loop: Loop) -> Factored:
    """G C: the certificate and the margins ask for it."""
    return factored_plant(loop.plant) * loop.controller.factored


@lru_cache(maxsize=TOGETHER)
def factored_plant(plant: Plant) -> Factored:
    """One plant meets many controllers."""
    return plant.factored
