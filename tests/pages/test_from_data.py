"""The page From data: from a record to a model, to its tuning; what cannot be fitted is told in words."""

import re

import pytest

from pages.common.from_data.work import work_on_example
from pages.common.session import links
from pages.common.session.record import Chosen
from simc_core import Loop, half_rule, margins, simc
from simc_core.identification.rank import USUAL
from tests.pages.from_data import TRUTH, html
from tests.pages.tools import address, run_page, texts


def test_without_a_record_the_page_says_what_to_do():
    app = run_page("from_data")
    assert "choose an example" in app.info[0].value
    assert not app.error


@pytest.mark.parametrize("key", TRUTH)
def test_the_process_of_an_example_is_within_the_intervals(key):
    work = work_on_example(key)
    chosen = Chosen()
    best = work.fitted(work.part(chosen)[0], chosen, USUAL).found[0]
    for name, value in TRUTH[key].items():
        low, high = best.intervals[name]
        room = 0.5 * (high - low)  # 95 % intervals of a dozen numbers: one or the other may just miss
        assert low - room <= value <= high + room, (name, best.intervals[name])


def test_another_structure_is_chosen_and_stays_in_the_address():
    app = run_page("from_data", example="step")
    app.segmented_control(key="structure").set_value("SOPDT").run()
    assert not app.exception
    assert address(app)["structure"] == "SOPDT"
    assert "τ₂" in html(app)


def test_a_part_is_fitted_and_both_ways_to_choose_it_agree():
    app = run_page("from_data", example="step")
    app.text_input(key="part_end").set_value("350").run()
    assert address(app)["end"] == "350"
    assert app.slider(key="part").value == (0.0, 350.0)
    assert "351 samples" in texts(app)
    app.slider(key="part").set_range(30.0, 300.0).run()
    assert float(address(app)["begin"]) == pytest.approx(30, abs=0.5)
    assert app.text_input(key="part_end").value.startswith("300")


def test_a_part_outside_the_record_is_refused_beside_its_field():
    app = run_page("from_data", example="step")
    app.text_input(key="part_end").set_value("9999").run()
    assert "To must be ≤ 699" in app.error[0].value
    assert "end" not in address(app)


def test_a_bad_piece_is_left_out_and_taken_back():
    app = run_page("from_data", example="step")
    app.text_input(key="bad_from").set_value("100").run()
    app.text_input(key="bad_to").set_value("120,5").run()
    app.button(key="leave_out").click().run()
    assert address(app)["bad"] == "100.0~120.5"
    assert "679 samples" in texts(app)  # 100 to 120
    app.button(key="take_back_0").click().run()
    assert "bad" not in address(app)
    assert "700 samples" in texts(app)


def test_half_of_a_bad_piece_is_refused():
    app = run_page("from_data", example="step")
    app.text_input(key="bad_from").set_value("100").run()
    app.button(key="leave_out").click().run()
    assert "both ends are needed" in app.error[0].value


def test_op_that_never_moves_gives_no_numbers():
    app = run_page("from_data", example="step")
    rows = "t;PV;OP\n" + "".join(f"{i};{20 + i % 3};5\n" for i in range(60))
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    assert "Parameters of the model" not in html(app)
    assert app.error


def test_a_slower_tuning_is_offered_for_what_is_not_known():
    """The tau_c that is named keeps Ms of the fitted plant well below the limit: the plants around it need the room."""
    app = run_page("from_data", example="integrating")
    said = next(item.value for item in app.markdown if "probability of 95 %" in item.value)
    tau_c = float(re.search(r"= ([\d.]+) s", said)[1])
    app.button(key="tune_robust").click().run()
    assert not app.exception
    design, ignored = links.decode(address(app))
    assert not ignored
    assert design.tuning.tau_c == pytest.approx(tau_c, rel=0.01)
    assert design.tuning.tau_c > design.plant.theta
    judged = margins(Loop(design.plant, simc(half_rule(design.plant).model, design.tuning.tau_c)))
    assert judged.Ms < 1.7


def test_a_part_with_nothing_in_it_leaves_the_figure_and_says_so():
    app = run_page("from_data", example="step", begin="10", end="11")
    assert "at least 3 samples" in app.error[0].value
    assert app.get("plotly_chart")
    app.text_input(key="part_end").set_value("600").run()
    assert not app.error
    assert "591 samples" in texts(app)
