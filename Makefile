# make run    the app            make test   everything that is checked           make bench   speed and accuracy, as ratios
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PORT ?= 8501
HOST ?= 127.0.0.1
UV := uv==0.13.9

.PHONY: run test prepared programs installed lint doctest docs bench bench-ui screenshots lock catalogue licences clean

run: $(VENV)/run.stamp
	@echo "SIMC: http://localhost:$(PORT)"
	@if [ "$(HOST)" = 127.0.0.1 ]; then echo "For this machine only. To share it with your network: make run HOST=0.0.0.0"; \
	else echo "Open to everybody who reaches this machine: http://$$(hostname):$(PORT). For a class see deploy/README.md"; fi
	$(BIN)/streamlit run app.py --server.address $(HOST) --server.port $(PORT)

# Browser tests last: the others say more exactly what broke. Each worker has a server and a browser of its own.
test:
	@$(MAKE) --no-print-directory --jobs --output-sync=target prepared
	$(BIN)/python -m pytest tests simc_core --doctest-modules --ignore=tests/browser --ignore=tests/server/outgoing \
		-n auto --dist worksteal
	$(BIN)/python -m pytest tests/browser -n auto --dist loadgroup

# Environments and Debian's programs come from the network, side by side.
prepared: lint programs

lint: $(VENV)/dev.stamp node_modules/.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-cache
	$(BIN)/mypy
	node_modules/.bin/biome check

doctest: $(VENV)/dev.stamp
	$(BIN)/python -m pytest --doctest-modules simc_core -q

# In an environment of its own: what builds the pages is neither needed to run the app nor to test it.
docs: $(VENV)/docs.stamp
	$(VENV)/docs/bin/sphinx-build -q -W -b html docs docs/_build
	@echo "docs/_build/index.html"

bench: $(VENV)/dev.stamp
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.sweep
	$(BIN)/python -m benchmarks.cascade
	$(BIN)/python -m benchmarks.actuator
	$(BIN)/python -m benchmarks.optimum
	$(BIN)/python -m benchmarks.identification
	$(BIN)/python -m benchmarks.many
	$(BIN)/python -m benchmarks.fuzz
	$(BIN)/python -m benchmarks.bounds

bench-ui: $(VENV)/dev.stamp chromium-headless-shell
	$(BIN)/python -m benchmarks.ui
	$(BIN)/python -m benchmarks.switches
	$(BIN)/python -m benchmarks.pages

screenshots: $(VENV)/dev.stamp chromium-headless-shell
	$(BIN)/python -m tests.browser.readme_picture

# All versions with the hashes of their files, from requirements.txt and pyproject.toml: what run, test and images install.
lock: $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet $(UV)
	$(COMPILE) requirements.txt -o requirements.lock
	$(COMPILE) -c requirements.lock requirements.txt --group pyproject.toml:dev -o requirements-dev.lock
	printf 'numpy\nscipy\n' | $(COMPILE) -c requirements.lock - --group pyproject.toml:docs -o requirements-docs.lock
COMPILE = $(BIN)/uv pip compile --quiet --no-config --no-header --universal --python-version 3.11 --generate-hashes \
	--default-index https://pypi.org/simple

# What is to be translated, into pages/locale: docs/languages.md
catalogue: $(VENV)/run.stamp
	$(BIN)/python -m pages.common.words.make

licences: $(VENV)/run.stamp
	$(BIN)/python -m deploy.licences

clean:
	rm -rf $(VENV) node_modules .mypy_cache .pytest_cache .ruff_cache .hypothesis docs/_build

$(VENV)/bin/python:
	$(PYTHON) -m venv $(VENV) || { echo "No venv here: apt-get install python3-venv"; exit 1; }

# Python compiles what it imports; pip would compile all of it, half of the time here.
INSTALL := $(BIN)/python -m pip install --quiet --no-compile --require-hashes

$(VENV)/run.stamp: requirements.lock | $(VENV)/bin/python
	$(INSTALL) -r requirements.lock
	touch $@

# Holds all of requirements.lock, in the same versions.
$(VENV)/dev.stamp: requirements-dev.lock requirements.lock | $(VENV)/bin/python
	$(INSTALL) -r requirements-dev.lock
	touch $(VENV)/run.stamp $@

node_modules/.stamp: package-lock.json | npm
	npm ci --silent --no-audit --no-fund
	touch $@

$(VENV)/docs.stamp: requirements-docs.lock | $(VENV)/bin/python
	$(BIN)/python -m venv $(VENV)/docs
	$(VENV)/docs/bin/python -m pip install --quiet --require-hashes -r requirements-docs.lock
	touch $@

# Programs of Debian that tests need, installed where that is allowed: as root, or by sudo that asks nothing.
PROGRAMS := chromium-headless-shell nginx systemd-analyze node npm gcc g++ avr-gcc octave
DEBIAN_chromium-headless-shell := chromium-headless-shell
DEBIAN_nginx := nginx
DEBIAN_systemd-analyze := systemd
DEBIAN_node := nodejs
DEBIAN_npm := npm
DEBIAN_gcc := gcc libc6-dev
DEBIAN_g++ := g++
DEBIAN_avr-gcc := gcc-avr binutils-avr avr-libc
DEBIAN_octave := octave
programs: npm  # first and alone: lint waits for it beside, and two apt-get would meet
	@$(MAKE) --no-print-directory installed

installed:
	@PATH="$$PATH:/usr/sbin"; MISSING=; \
	$(foreach each,$(PROGRAMS),command -v $(each) >/dev/null || MISSING="$$MISSING $(DEBIAN_$(each))";) \
	[ "$$MISSING" ] || exit 0; \
	if [ "$$(id -u)" = 0 ]; then AS=; elif sudo -n true 2>/dev/null; then AS="sudo -n"; else AS=none; fi; \
	if [ "$$AS" != none ] && command -v apt-get >/dev/null; then \
	    $$AS apt-get update -q && $$AS apt-get install -y -q --no-install-recommends $$MISSING && exit 0; fi; \
	echo "The tests need programs that are not here. Install them: apt-get install$$MISSING (as root)"; exit 1

# make chromium-headless-shell: that one alone
.PHONY: $(PROGRAMS)
$(PROGRAMS):
	@$(MAKE) --no-print-directory installed PROGRAMS=$@
