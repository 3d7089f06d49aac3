# `make help` lists the targets. Set-up happens once, and again when requirements.lock or pyproject.toml change.

PYTHON ?= python3
CORES ?= all
CONFIG ?= config/paper.yaml
BIN := .venv/bin
READY := .venv/.ready
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check
PROFILE ?=
export CONFIG CORES PROFILE

# The plugins of a profile lie in a folder of their own: every start of Snakemake that can import SLURM's takes 2 s more.
PLUGINS := $(if $(PROFILE),$(if $(wildcard profiles/$(PROFILE)/requirements.lock),.venv/plugins/$(PROFILE)/.ready))

# `make CONFIG=config/mine.yaml` means that study, never the paper's
.DEFAULT_GOAL := $(if $(filter command,$(origin CONFIG)),study,paper)
.PHONY: paper study test setup docs clean help

paper: $(READY)  ## set up, then the paper's study to figures and report
	@$(BIN)/subslide study config/paper.yaml --cores "$$CORES"
	@echo "The paper's study is up to date: results/paper/report.html"

study: $(READY) $(PLUGINS)  ## check a study and run it: make study CONFIG=config/mine.yaml CORES=2, or PROFILE=slurm
	@$(if $(PROFILE),PYTHONPATH="$(PLUGINS:%/.ready=$(CURDIR)/%)$${PYTHONPATH:+:$$PYTHONPATH}" ) \
		$(BIN)/subslide study $(if $(PROFILE),--profile "$$PROFILE",--cores "$$CORES") -- "$$CONFIG"
	@echo "The study in $$CONFIG is up to date: its tables, figures and report.html are in results/, under its name"

.PHONY: plan prune
plan: $(READY)  ## say what a study would cost, and write nothing: make plan CONFIG=config/mine.yaml
	@$(BIN)/subslide plan -- "$$CONFIG"

prune: $(READY)  ## remove records that hold no point which a study asks for: make prune CONFIG=config/mine.yaml
	@$(BIN)/subslide prune -- "$$CONFIG"

test: $(READY)  ## set up, then lint, format, types and every test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	@# the plane's kernels beside the others': each compiles on one core
	$(BIN)/subslide warm quarter:float64 plane:float64 & plane=$$!; \
		$(BIN)/subslide warm radial:float64 one-layer:float64 radial:float64:general && wait $$plane
	@$(MAKE) --no-print-directory test-interpreted
	$(BIN)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder $(PYTEST_OPTIONS)

.PHONY: test-interpreted
test-interpreted: $(READY)  ## small runs with the compiler off: kernels within their arrays, tracebacks that name the line
	NUMBA_DISABLE_JIT=1 $(BIN)/python -m pytest -q tests/interpreted

.PHONY: test-all
test-all: $(READY)  ## every test and the long lanes: thousands of random points
	@$(MAKE) --no-print-directory test PYTEST_OPTIONS=--long

.PHONY: test-slurm
test-slurm: $(READY) .venv/plugins/slurm/.ready  ## the cluster profile on a real one-node SLURM of its own (Debian, as root)
	@$(BIN)/python tests/slurm/check.py

.PHONY: bench
bench: $(READY)  ## measure speed beside a C reference, cost growth, start-up; tables and figures in results/bench
	$(BIN)/python benchmarks/run.py

.PHONY: bench-peers
bench-peers: $(READY)  ## run GeoClaw and PyClaw beside subslide (builds them once; needs gfortran and LAPACK)
	@$(BIN)/python benchmarks/peers/run.py

.PHONY: verify
verify: $(READY)  ## exact solutions, and error against seconds of all numerics; hold the required orders (15 minutes on 2 cores)
	@$(BIN)/subslide study config/accuracy.yaml --cores "$$CORES"
	@$(BIN)/subslide verify results/accuracy

.PHONY: atlas
atlas: $(READY)  ## where methods fail: thousands of runs, maps of errors and statuses, largest stable Courant numbers
	@$(BIN)/subslide study config/stability.yaml --cores "$$CORES"
	@cat results/stability/logs/table-atlas.log

.PHONY: sensitivity
sensitivity: $(READY)  ## Sobol' indices, main effects and power laws of the paper's parameters, from 17,000 runs
	@$(BIN)/subslide study config/sensitivity.yaml --cores "$$CORES"
	@echo "Indices, effects and laws are in results/sensitivity/tables, figures and report.html beside them"

.PHONY: emulator
emulator: $(READY)  ## make the emulator of the package anew: 5,000 runs, then fits (ten minutes on 2 cores)
	@$(BIN)/subslide study config/emulator.yaml --cores "$$CORES" -- --until points batch
	@$(BIN)/subslide emulate results/emulator -o src/subslide/emulator/emulator.json

setup: $(READY)  ## set up alone: .venv with the locked packages and this one

$(READY): requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "Python 3.11 or newer is needed: make PYTHON=/path/to/python3" >&2; exit 1; }
	$(PYTHON) -m venv --clear .venv
	@# setuptools first: what has no wheel is built with it, and nothing outside the lock is downloaded
	@sed -n '/^setuptools==/,/[^\\]$$/p' requirements.lock > .venv/build.lock
	$(PIP) --require-hashes -r .venv/build.lock
	$(PIP) --require-hashes --no-build-isolation --use-pep517 -r requirements.lock
	$(PIP) --no-deps --no-build-isolation --editable .
	@touch $@

.venv/plugins/%/.ready: profiles/%/requirements.lock $(READY)
	rm -rf $(@D)
	$(PIP) --require-hashes --no-deps --target $(@D) -r $<
	@touch $@

docs: $(READY)  ## write what follows from the code: config/README.md, config/study.schema.json, docs/tables.md, docs/records.md
	$(BIN)/subslide docs

clean:  ## remove the virtual environment and caches, but no results
	rm -rf .venv .pytest_cache .ruff_cache .hypothesis src/*.egg-info

help:  ## list the targets
	@sed -n 's/^\([a-z][a-z-]*\):.*## \(.*\)/make \1@\2/p' $(MAKEFILE_LIST) | awk -F@ '{printf "%-14s %s\n", $$1, $$2}'
