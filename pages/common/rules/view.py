"""The page of rules: what is asked, the table as it comes, two pictures, and the rule that was picked."""

from collections.abc import Sequence

import streamlit as st

from pages.common.live import plane_instrument
from pages.common.parts.large import roomy
from pages.common.parts.number_field import design_number
from pages.common.parts.panel import show
from pages.common.parts.sources import linked
from pages.common.rules import curves
from pages.common.rules.plane import ground as ground_of
from pages.common.rules.table import Question, frame, key_of, rows_of, shown, title_of
from pages.common.session import state
from pages.common.session.compared import KINDS, OPTIMAL, PRESENT, USUAL
from pages.common.session.design import Design
from pages.common.session.excitation import Excitation
from pages.common.studies.measures import EXAMPLES, MEANINGS, MEASURES, NAMES
from pages.common.studies.measures import told as name_of_measure
from pages.common.studies.single import Study, study_of_settings
from pages.common.words import number, translated, typeset, words
from simc_core.figures import trade_off_figure
from simc_core.figures.palette import TIME_UNIT, UNIT_OF_Y
from simc_core.figures.rules import Point
from simc_core.notation import latex, plain
from simc_core.studies.comparison import Row
from simc_core.wording import joined, said

KIND_NAMES = {kind: said("both") if kind == "both" else kind for kind in KINDS}
CRITERIA = {"load": said("IAE load"), "setpoint": said("IAE set point"), "J": "J"}
AXES = {
    "load": said("IAE load  [{y} · {time}]", y=UNIT_OF_Y, time=TIME_UNIT),
    "setpoint": said("IAE set point  [{y} · {time}]", y=UNIT_OF_Y, time=TIME_UNIT),
    "J": "J  [–]",
}
ROBUSTNESS = {False: said("as published"), True: said("at equal Mst")}
EQUAL = 1.59
SG12 = {"compared_kind": "PI", "compared_Ms": EQUAL, "compared_criterion": "J"}
AT_ONCE = 4  # rows between two pictures of the table while it grows
TALL, HEIGHT, ROW, WIDE = 340, 380, 27, 185  # px
PICTURES = (said("Error over Mst"), said("Kc and τI"))
J_HELP = said(
    "J is the mean of the IAE of set point and of load, each over that of the PI controller that is best for it at "
    "$M_s$ = 1.59 [SG12]."
)


def ask(design: Design) -> None:
    """What is compared: plant, controllers, robustness, criterion, filter."""
    with st.container(key="rules_question", horizontal=True, vertical_alignment="bottom", gap="small"):
        plants = {PRESENT: words("the plant of this design")} | {
            name: f"{plain(usual.plant)}, {translated(usual.name)}" for name, usual in USUAL.items()
        }
        st.selectbox(
            words("Plant"), list(plants), format_func=plants.get, width=roomy(260), **state.bound("compared_plant")
        )
        st.segmented_control(
            words("Controllers"),
            KINDS,
            format_func=lambda kind: translated(KIND_NAMES[kind]),
            required=True,
            **state.bound("compared_kind"),
        )
        st.segmented_control(
            words("Rules"),
            list(ROBUSTNESS),
            format_func=lambda equal: translated(ROBUSTNESS[equal]),
            required=True,
            help=words(
                "As published, or each made as robust as the others: its own parameter, or else the dead time in its "
                "formula, is multiplied by the F nearest to 1 with which Mst = max(Ms, Mt) is the one asked for."
            ),
            **state.bound(
                "compared_Ms",
                key="rules_equal",
                show=lambda Ms: Ms is not None,
                read=lambda equal: EQUAL if equal else None,
                optional=True,
            ),
        )
        if design.compared.Ms is not None:
            design_number("compared_Ms", words("Mst"), width=64)
        st.segmented_control(
            words("Best for"),
            list(CRITERIA),
            format_func=lambda criterion: translated(CRITERIA[criterion]),
            required=True,
            help=linked(translated(J_HELP)),
            **state.bound("compared_criterion"),
        )
        if design.compared.kind != "PI":
            design_number(
                "compared_tau_F",
                "τF",
                quantity="time",
                optional=True,
                placeholder=f"{number(0.1)} θ",
                width=76,
                help=words(
                    "Filter of all controllers with derivative action; empty for a tenth of the effective dead time."
                ),
            )

        st.button(
            words("as in [SG12]"),
            key="rules_SG12",
            type="tertiary",
            help=words("PI controllers at Mst = 1.59, judged by J, on one of the plants compared there."),
            on_click=state.change,
            kwargs=SG12 | {"compared_plant": design.compared.plant or "lag"},
        )
    if design.compared.plant != PRESENT:
        usual = USUAL[design.compared.plant]
        told = [
            words("Compared on $G(s) = {plant}$, not on the plant of this design.", plant=typeset(latex(usual.plant)))
        ]
        if usual.printed:
            printed = joined([f"${typeset(latex(each))}$" for each in usual.printed], said(" and "))
            told.append(linked(words("Settings printed in [SK98]: {printed}.", printed=printed)))
        st.markdown(" ".join(told))


def open_asked(view: str) -> None:
    """The picture that a link names."""
    if view == "plane":
        state.set_widget("rules_picture", PICTURES[1])


def table(question: Question) -> list[Row]:
    """All rows; while they are computed the table grows."""
    made, rows = rows_of(question), []
    sheet = state.design_now().sheet
    bar, place, growing = st.container(), st.container(), not made.complete
    if growing:  # a table that is there stays there: emptied for a moment, it would move the page under the hand
        bar, place = bar.empty(), place.empty()
    more = st.multiselect(
        words("More columns"),
        list(MEASURES),
        format_func=name_of_measure,
        key="rules_measures",
        persist_state="session",
        placeholder=translated(EXAMPLES),
        help=translated(MEANINGS),
    )
    for row in made:
        rows.append(row)
        if growing and len(rows) % AT_ONCE == 0:
            bar.progress(len(rows) / question.total, words("{n} of {total} rules", n=len(rows), total=question.total))
            place.dataframe(
                shown(frame(rows, question, sheet)), hide_index=True, height=roomy(TALL), row_height=roomy(ROW)
            )
    if growing:
        bar.empty()
    state.remember("rules_rows", [key_of(row) for row in rows])
    found = frame(rows, question, sheet, more)
    place.dataframe(
        shown(found),
        hide_index=True,
        height=roomy(TALL),
        row_height=roomy(ROW),
        key="rules_table",
        on_select=_picked_in_table,
        selection_mode="single-row",
        column_config=_columns(list(found.columns)),
        placeholder="–",
        alt=words("Tuning rules: settings in ideal form, Mst, errors and distance to the optimum"),
    )
    return rows


COLUMNS = NAMES | {
    name: name
    for name in (
        said("rule"),
        said("kind"),
        said("as published"),
        said("IAE load"),
        said("IAE set point"),
        said("behind, %"),
        said("TV load"),
        said("high-freq. gain"),
        said("in domain"),
        said("source"),
        said("remark"),
    )
}
HELP = {
    "Kc": said(
        "Settings in ideal form; Kc as its size, the action has the sign: reverse where k > 0, direct where k < 0."
    ),
    "Mst": said("max(Ms, Mt) of the loop round the plant."),
    "as published": said("max(Ms, Mt) of the rule as published."),
    "F": said("The rule's own parameter, or the dead time in its formula, is multiplied by this."),
    "J": J_HELP,
    "behind, %": said("How much the criterion is above that of the best controller of this kind with the same Mst."),
    "TV load": said("Total variation of u after a unit step of the load."),
    "high-freq. gain": said("|C| at high frequency: Kc τD/τF, Kc for PI."),
    "in domain": said("Whether the source recommends the rule for this plant."),
    "remark": said("Why there is no loop, where there is none."),
}


def _columns(names: list[str]) -> dict:
    config = {}
    for name in names:
        label, bracket, unit = name.partition(" [")
        config[name] = st.column_config.Column(
            f"{translated(COLUMNS.get(label, label))}{bracket}{unit}", help=translated(HELP.get(label, "")) or None
        )
    config["rule"] |= {"pinned": True, "width": roomy(WIDE)}
    return config


def _picked_in_table() -> None:
    rows = state.widget("rules_table")["selection"]["rows"]
    known = state.memory("rules_rows", list)
    if rows and rows[0] < len(known):
        state.change(compared_rule=known[rows[0]])


def _picked_in_picture(key: str) -> None:
    for point in state.widget(key)["selection"]["points"]:
        if point.get("customdata"):
            state.change(compared_rule=str(point["customdata"]))


def chosen_of(rows: Sequence[Row], design: Design) -> Row | None:
    """The rule that is drawn: the one picked, else SIMC, else the first that has settings."""
    by_key = {key_of(row): row for row in rows}
    for key in (design.compared.rule, *(f"simc-{kind}" for kind in design.compared.kinds)):
        if key in by_key and (by_key[key].controller or key == design.compared.rule):
            return by_key[key]
    return next((row for row in rows if row.controller and row.key != OPTIMAL), None)


def which_picture() -> str:
    """One of PICTURES."""
    state.begin_widget("rules_picture", PICTURES[0])
    return st.segmented_control(
        words("Picture"),
        PICTURES,
        format_func=lambda picture: translated(PICTURES[PICTURES.index(picture)]),
        required=True,
        key="rules_picture",
        persist_state="session",
        label_visibility="collapsed",
    )


def trade_off(question: Question, rows: Sequence[Row], chosen: Row | None, present: Study | None) -> None:
    """The error over the peak; a click picks a rule."""
    points = curves.rule_points(question, rows)
    figure = trade_off_figure(
        curves.fronts(question),
        curves.simc_over_tau_c(question),
        points,
        _of(points, chosen),
        present and curves.trade_off_point(question, present),
        AXES[question.criterion],
        HEIGHT,
    )
    show(
        figure,
        "rules_trade_off",
        words("Error of each rule over its Mst, with the best that PI and PID can do"),
        _picked_in_picture,
    )
    st.caption(words("No controller of its kind lies below a front. Click a rule to draw it; double-click shows all."))


def plane(question: Question, rows: Sequence[Row], chosen: Row | None, present: Study | None, design: Design) -> None:
    """PI settings in their plane: a point to drag, the responses beside it."""
    behind = []
    if chosen is not None and chosen.controller is not None:
        behind.append((translated(title_of(chosen)), study_of_settings(question.plant, chosen.controller)))
    with st.spinner(words("Computing contours and the best settings")):
        ground = ground_of(question, rows, chosen, present, question.plant == design.plant)
    excitation = design.excitation if ground.mine else Excitation()
    plane_instrument(ground, behind, excitation, lambda key: state.change(compared_rule=key))
    st.caption(
        words(
            "PI controllers. Drag the point, or move it by its arrow keys: released, it is my settings. "
            "Click a rule to draw it."
        )
        if ground.mine
        else words(
            "PI controllers. Drag the point, or move it by its arrow keys: this plant is not that of the design, which "
            "stays. Click a rule to draw it."
        )
    )


def _of(points: Sequence[Point], row: Row | None) -> Point | None:
    return next((each for each in points if row is not None and each.key == key_of(row)), None)
