# make run    the app            make test   everything that is checked           make bench   speed and accuracy, as ratios
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PORT ?= 8501

.PHONY: run test lint bench bench-ui screenshots clean

run: $(VENV)/run.stamp
	@echo "SIMC: http://localhost:$(PORT)"
	$(BIN)/streamlit run app.py --server.port $(PORT)

# Browser tests last: they are the slowest, and the others say more exactly what broke.
test: $(VENV)/dev.stamp lint chromium
	$(BIN)/python -m pytest tests --ignore=tests/browser -n auto
	$(BIN)/python -m pytest tests/browser

lint: $(VENV)/dev.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-cache

bench: $(VENV)/dev.stamp
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.sweep
	$(BIN)/python -m benchmarks.cascade
	$(BIN)/python -m benchmarks.actuator

bench-ui: $(VENV)/dev.stamp chromium
	$(BIN)/python -m benchmarks.ui

screenshots: $(VENV)/dev.stamp chromium
	$(BIN)/python -m tests.browser.readme_picture

clean:
	rm -rf $(VENV) .pytest_cache .ruff_cache .hypothesis

$(VENV)/bin/python:
	$(PYTHON) -m venv $(VENV) || { echo "No venv here: apt-get install python3-venv"; exit 1; }

$(VENV)/run.stamp: requirements.txt | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"  # the first that knows --group
	$(BIN)/python -m pip install --quiet -r requirements.txt
	touch $@

$(VENV)/dev.stamp: pyproject.toml $(VENV)/run.stamp
	$(BIN)/python -m pip install --quiet --group dev
	touch $@

.PHONY: chromium
chromium:
	@command -v chromium >/dev/null && exit 0; \
	if [ "$$(id -u)" = 0 ]; then AS=; elif sudo -n true 2>/dev/null; then AS="sudo -n"; else AS=none; fi; \
	if [ "$$AS" != none ] && command -v apt-get >/dev/null; then \
	    $$AS apt-get update -q && $$AS apt-get install -y -q --no-install-recommends chromium && exit 0; fi; \
	echo "The browser tests need Chromium. Install it: apt-get install chromium (as root)"; exit 1
