# Plain verbs. On a bare Debian or Ubuntu with python3 (3.11 or later) and make, each of them sets up
# what it needs by itself, once; `make` alone lists them.

PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
READY := $(VENV)/.ready
TOOLS_READY := $(VENV)/.tools-ready
STUDIO_READY := $(VENV)/.studio-ready
SITE_READY := $(VENV)/.site-ready
CLIENTS_READY := .venv/.clients-ready
PEERS_READY := .venv-bench/.ready
WORKERS := -n auto --maxprocesses 8 --dist worksteal

# The tools' own state must not depend on who calls.
export PYTHON VENV LOWEST
unexport PYTHONPATH PYTHONHOME VIRTUAL_ENV

.PHONY: help demo studio inkscape-extension sbom site test test-clients test-long test-pythons test-lowest test-bare test-wheel lint format bench golden docs setup clean

help: ## list these verbs
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 22

demo: $(READY) ## compile samples/four-square.toml to SVG, PDF, DXF and PNG in out/
	$(BIN)/batik-vector compile samples/four-square.toml -o out -f svg,pdf,dxf,png

studio: $(STUDIO_READY) ## open the studio in the browser
	$(BIN)/batik-vector studio

inkscape-extension: ## pack the extension for Inkscape: out/batik-vector-inkscape.zip
	@mkdir -p out
	cd inkscape && $(PYTHON) -m zipfile -c ../out/batik-vector-inkscape.zip *.inx *.py

site: $(SITE_READY) ## make the documentation site, and follow its links: out/site/index.html
	$(PY) -m tools.site

sbom: $(TOOLS_READY) ## write the bill of materials (CycloneDX): out/batik-vector.cdx.json
	@mkdir -p out
	$(PY) -m tools.sbom >out/batik-vector.cdx.json

test: $(TOOLS_READY) ## run the tests; ONLY="tests/tiling tests/export": only those; FEW=3: on every third sample; PART=2: every second test
	$(PY) -m pytest $(WORKERS) -rs $(if $(FEW),--few $(FEW)) $(if $(PART),--part $(PART)) $(if $(LOWEST),-m 'not clients and not long and not slow') $(ONLY)

test-clients: $(TOOLS_READY) $(CLIENTS_READY) site ## open the files (FEW=3: of every third sample) in Inkscape, LibreCAD, LinuxCNC, vpype, hp2xx, Chromium, poppler, mupdf, Ghostscript, qpdf
	$(PY) -m pytest $(WORKERS) -rs $(if $(FEW),--few $(FEW)) -m clients

test-long: $(TOOLS_READY) ## run what is slow, and the random tests with many more examples; LONG=3: three times as many
	BATIK_LONG=$(or $(LONG),1) $(PY) -m pytest $(WORKERS) -rs -m '(long or slow) and not clients'

test-pythons: ## lint and test on PYTHON and on the newest that this machine has; ALL=1: on every one from 3.11 on
	@tools/pythons.sh lint test

test-lowest: ## test with the oldest versions of all that pyproject.toml asks for, on every sixth sample; random tests aside
	@$(MAKE) --no-print-directory VENV=.venv-lowest LOWEST=1 FEW=6 test

test-bare: $(TOOLS_READY) ## README's two commands on bare systems: SUITE="trixie bookworm" (the default; all tests on the first, FEW=3: on every third sample), or sid
	@tools/setup.sh bare
	@tools/bare.sh $(or $(SUITE),trixie bookworm)

test-wheel: ## wheel and sdist in empty environments, with the newest and the oldest of what is needed
	@tools/wheel.sh

lint: $(TOOLS_READY) ## check style and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: $(TOOLS_READY) ## mend the style
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(TOOLS_READY) $(PEERS_READY) ## time everything beside its peers, and write the tables into benchmarks/README.md
	$(PY) -m benchmarks.run

golden: $(TOOLS_READY) ## draw the pictures of samples and starters and the gallery again, and measure them for the library
	$(PY) -m tools.golden

docs: $(TOOLS_READY) ## write docs/recipe.md, docs/architecture.md and the tables in docs/library.md and docs/audit.md from the program
	$(PY) tools/reference.py
	$(PY) -m tools.house

setup: $(TOOLS_READY) ## set up without doing anything else

$(READY): pyproject.toml tools/setup.sh tools/lowest.py
	@tools/setup.sh python
	@touch $@

$(STUDIO_READY): $(READY)
	@tools/setup.sh studio
	@touch $@

$(SITE_READY): $(READY)
	@tools/setup.sh site
	@touch $@

# What only tests and checks need waits until they are asked for.
$(TOOLS_READY): $(READY)
	@tools/setup.sh tools
	@touch $@

$(CLIENTS_READY): benchmarks/requirements.txt tools/setup.sh pyproject.toml | $(TOOLS_READY)
	@tools/setup.sh clients
	@touch $@

$(PEERS_READY): benchmarks/requirements.txt tools/setup.sh
	@tools/setup.sh peers
	@touch $@

clean: ## remove what was made here, the environment included
	rm -rf .venv .venv-* out dist .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
