"""Nested loops, each block with its own dead time; a cascade is two of them.

    r -->[C_N]--> ... -->[C_1]-->(+)-->[G_1]--+-->(+)-->[G_2]--+--> ... -->[G_N]--+--> y_N
                                  ^           |    ^           |                  |
                                 d_1         y_1  d_2         y_2                y_N

Counted from the inside out. Controller i sees y_i, and its set point is what controller i + 1 puts out. Only the
outermost one uses its set-point weights; the others act on the error, so that with the loops inside closed

    L_i = C_i G_i T_{i-1}      T_i = L_i/(1 + L_i)      T_0 = 1

Closed-loop poles: 1 + L_1 = 0 with the loops 1..i closed becomes 1 + A_1 + ... + A_i = 0, A_i = prod_{j<=i} C_j G_j.
A controller may be missing: y_i is then not fed back, C_i = 1 and T_i = G_i T_{i-1}.
"""

from dataclasses import dataclass

from simc_core import checks
from simc_core.algebra.factors import Factored, factors
from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter, WrongType
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.wording import said

MOST_LOOPS = 6
ONE = Factored(1.0, factors(), factors())


@dataclass(frozen=True, slots=True)
class NestedLoops:
    """Loops within loops, blocks and controllers from the inside out; see the module docstring.

    Parameters
    ----------
    blocks : tuple of Plant
        G_1 to G_N, N from 1 to 6.
    controllers : tuple of controllers or None
        C_1 to C_N. None: y_i is not fed back. The outermost one must be given.

    Raises
    ------
    InvalidParameter
        Lists of different length, no block or more than MOST_LOOPS, no outermost controller.

    Examples
    --------
    >>> from simc_core import NestedLoops, Plant, SeriesPid, stability
    >>> loops = NestedLoops((Plant(1, 0.1, (1,)), Plant(1, 1, (8,))), (SeriesPid(5, 1), SeriesPid(2, 8)))
    >>> stability(loops).sound
    True
    """

    blocks: tuple[Plant, ...]
    controllers: tuple[Controller | None, ...]

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "blocks", checks.items("blocks", self.blocks, MOST_LOOPS))
        put(self, "controllers", checks.items("controllers", self.controllers, MOST_LOOPS))
        if len(self.blocks) != len(self.controllers) or not self.blocks:
            raise InvalidParameter(
                said(
                    "blocks and controllers must be as many, at least one, found {blocks} and {controllers}",
                    blocks=len(self.blocks),
                    controllers=len(self.controllers),
                )
            )
        if self.controllers[-1] is None:
            raise InvalidParameter(said("the outermost controller must be given, found None"))

    @property
    def outermost(self) -> Controller:
        """The controller of the outermost loop."""
        controller = self.controllers[-1]
        assert controller is not None  # refused at construction
        return controller

    @property
    def inside(self) -> "NestedLoops | None":
        """The next feedback loop inside the outermost one; None where there is none."""
        for count in range(len(self.blocks) - 1, 0, -1):
            if self.controllers[count - 1] is not None:
                return NestedLoops(self.blocks[:count], self.controllers[:count])
        return None

    @property
    def own(self) -> Factored:
        """What the outermost loop has in series with the closed loop inside it: controller and blocks between."""
        count = len(self.inside.blocks) if self.inside else 0
        product = self.outermost.factored
        for block in self.blocks[count:]:
            product = product * block.factored
        return product

    @property
    def terms(self) -> list[Factored]:
        """A_i of all controllers: 1 + their sum = 0 holds the closed-loop poles."""
        product, found = ONE, []
        for block, controller in zip(self.blocks, self.controllers, strict=True):
            product = product * block.factored
            if controller is not None:
                product = product * controller.factored
                found.append(product)
        return found


@dataclass(frozen=True, slots=True)
class CascadeLoop:
    """Two nested loops: primary = Ga under `outer`, secondary = Gb under `inner`.

    d2 enters at the input of Gb, d1 at the input of Ga.

    Parameters
    ----------
    primary, secondary : Plant
        Ga and Gb; Gb stands nearer to the actuator.
    outer : controller
        Sees the output of Ga; what it puts out is the set point of the inner loop.
    inner : controller or None
        Sees the output of Gb. None: no inner loop, `outer` drives Gb directly, which is the single-loop alternative
        with the same disturbances.

    Examples
    --------
    >>> from simc_core import CascadeLoop, Plant, SeriesPid, margins
    >>> loop = CascadeLoop(Plant(1, 1, (8,)), Plant(1, 0.1, (1,)), outer=SeriesPid(2, 8), inner=SeriesPid(5, 1))
    >>> margins(loop.outer_loop).stable
    True
    """

    primary: Plant
    secondary: Plant
    outer: Controller
    inner: Controller | None

    @property
    def nested(self) -> NestedLoops:
        """The same from the inside out."""
        return NestedLoops((self.secondary, self.primary), (self.inner, self.outer))

    @property
    def inner_loop(self) -> Loop:
        """The inner loop on its own. Raises InvalidParameter where there is none."""
        if self.inner is None:
            raise InvalidParameter(said("inner must be a controller for the inner loop to exist, found None"))
        return Loop(self.secondary, self.inner)

    @property
    def outer_loop(self) -> NestedLoops:
        """The outer loop with the inner one closed: margins of it are those of La = Ca Ga Tb."""
        return self.nested


def not_a_loop(given: object) -> WrongType:
    """The refusal of whatever works on all kinds of loops."""
    return WrongType(f"loop must be a Loop, CascadeLoop or NestedLoops, found {type(given).__name__}")
