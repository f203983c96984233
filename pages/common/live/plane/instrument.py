"""PI settings as a point in their plane: dragged, it takes the responses along; released, it becomes my settings."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from pages.common.live.hand import table
from pages.common.live.hand.turned import Turned, moved, shown
from pages.common.session import state
from pages.common.session.excitation import Excitation
from pages.common.studies.single import Study
from simc_core.controllers.forms import IdealPid
from simc_core.plants.plant import Plant

KEY = "live_plane"


@dataclass(frozen=True, slots=True)
class Ground:
    """What the point stands on.

    plane: what is drawn there, as panel.js has it.   Kc, tau_I: limits of the sizes.   mine: whether this is the plant
    of the design, so that a release becomes its settings; else the point is a question, and nobody's.
    """

    plant: Plant
    controller: IdealPid
    mine: bool
    Kc: tuple[float, float]
    tau_I: tuple[float, float]
    plane: Mapping[str, object]


def plane_instrument(
    ground: Ground, behind: list[tuple[str, Study]], excitation: Excitation, picked: Callable[[str], None]
) -> None:
    """The plane with its point, and the responses beside it. behind: designs that are drawn behind, by name.

    picked: hears of a rule that was clicked.
    """
    held = state.memory(KEY, Turned)
    if not held.stands_on(ground.plant, ground.controller if ground.mine else None):
        within = ("Kc", *ground.Kc), ("tau_I", *ground.tau_I)
        held.put(table.Subject(ground.plant, ground.controller, True, within))

    def heard(release: Mapping) -> None:
        if "pick" in release:
            picked(str(release["pick"]))
        else:
            moved(KEY, release, ground.mine)

    shown("plane", KEY, behind, excitation, heard, {"plane": ground.plane, "moves_settings": ground.mine})
