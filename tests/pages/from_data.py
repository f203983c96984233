"""The page From data in tests: what its examples were made with, and what is done on it again and again."""

from pages.common.from_data.experiments import TITLES
from tests.pages.tools import run_page

TRUTH = {  # what the examples were made with
    "step": {"k": 1.5, "theta": 12.0, "tau1": 60.0},
    "noisy": {"k": 0.8, "theta": 20.0, "tau1": 45.0},
    "integrating": {"k_prime": 0.002, "theta": 16.0},
    "closed_loop": {"k": 1.5, "theta": 10.0, "tau1": 40.0},
    "relay": {"k": 1.2, "theta": 15.0, "tau1": 80.0},
}


def html(app) -> str:
    return " ".join(str(block.proto.body) for block in app.get("html"))


def experiment(app, title: str, **values: str):
    app.segmented_control(key="experiment").set_value(TITLES[TITLES.index(title)]).run()  # which knows its language
    for name, text in values.items():
        app.text_input(key=name).set_value(text).run()
    assert not app.exception
    return app


def pasted(rows: str):
    app = run_page("from_data")
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label.strip("⟦⟧") == "Read").click().run()
    assert not app.exception
    return app
