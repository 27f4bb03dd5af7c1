# Plain verbs. On a bare Debian or Ubuntu with python3 (3.11 or later) and make, each of them sets up
# what it needs by itself, once; `make` alone lists them.

PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
READY := $(VENV)/.ready
CLIENTS_READY := .venv/.clients-ready
PEERS_READY := .venv-bench/.ready
WORKERS := -n auto --maxprocesses 8 --dist worksteal

# The tools' own state must not depend on who calls.
export PYTHON VENV
unexport PYTHONPATH PYTHONHOME VIRTUAL_ENV

.PHONY: help demo test test-clients test-long test-pythons test-lowest test-bare lint format bench golden docs setup clean

help: ## list these verbs
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 22

demo: $(READY) ## compile samples/four-square.toml to SVG, PDF, DXF and PNG in out/
	$(BIN)/batik-vector compile samples/four-square.toml -o out -f svg,pdf,dxf,png

test: $(READY) ## run the tests
	$(PY) -m pytest $(WORKERS) -rs

test-clients: $(READY) $(CLIENTS_READY) ## open the files in Inkscape, LibreCAD, Chromium, poppler, mupdf, qpdf
	$(PY) -m pytest $(WORKERS) -rs -m clients

test-long: $(READY) ## run the random tests with many more examples
	BATIK_LONG=1 $(PY) -m pytest $(WORKERS) -rs -m 'long and not clients'

test-pythons: ## lint and test on every Python from 3.11 on that this machine has
	@tools/pythons.sh lint test

test-lowest: ## test with the oldest versions of all that pyproject.toml asks for
	@$(MAKE) --no-print-directory VENV=.venv-lowest KIND=lowest test

test-bare: $(READY) ## README's two commands on bare systems: SUITE="bookworm trixie" (the default), or sid
	@tools/setup.sh bare
	@tools/bare.sh $(or $(SUITE),bookworm trixie)

lint: $(READY) ## check style and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: $(READY) ## mend the style
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(READY) $(PEERS_READY) ## time everything beside its peers, and write the tables into benchmarks/README.md
	$(PY) -m benchmarks.run

golden: $(READY) ## draw the samples' pictures and the gallery again
	$(PY) tools/golden.py

docs: $(READY) ## write docs/recipe.md and docs/architecture.md from the program
	$(PY) tools/reference.py
	$(PY) -m tools.house

setup: $(READY) ## set up without doing anything else

$(READY): pyproject.toml tools/setup.sh tools/lowest.py
	@tools/setup.sh $(or $(KIND),python)
	@touch $@

$(CLIENTS_READY): tools/setup.sh | $(READY)
	@tools/setup.sh clients
	@touch $@

$(PEERS_READY): benchmarks/requirements.txt tools/setup.sh
	@tools/setup.sh peers
	@touch $@

clean: ## remove what was made here, the environment included
	rm -rf .venv .venv-* out dist .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
