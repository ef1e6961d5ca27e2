# make demo     installs into .venv, then sweeps the rig B2-G1-A3 into out/
# make test     installs what the tests need as well, then runs them on small samples
# make          lists the rest
#
# Nothing is installed twice, and a set-up that was cut short is begun again.

PYTHON ?= python3
PYTHONS ?= $(PYTHON)
VENV   := .venv
ARGS   :=

BIN        := $(VENV)/bin
UNFINISHED := $(VENV)/.unfinished

# Relative, for pip splits these at spaces. The first binds what runs (and, in older versions of
# pip, what builds), the second what builds.
export PIP_CONSTRAINT       := constraints.txt
export PIP_BUILD_CONSTRAINT := constraints.txt
export PIP_DISABLE_PIP_VERSION_CHECK := 1

# One installation at a time, also under make -j.
.NOTPARALLEL:
.DEFAULT_GOAL := help
.PHONY: help demo test test-full paper lint format docs bench kernels dist pins clean
.SECONDARY:

help:
	@echo 'make demo     sweep the rig B2-G1-A3; figure, data and summary in out/'
	@echo 'make test     run the tests; ARGS="tests/cli -x" passes words on to pytest'
	@echo 'make test-full   the same on full samples, before what the engine does is changed'
	@echo 'make paper    compute the published study again, with a verdict on each statement'
	@echo 'make lint     check style, types, layers and words'
	@echo 'make format   put the code into the style that make lint checks'
	@echo 'make docs     build the documentation, gallery included; it begins at out/site/index.html'
	@echo 'make bench    compare speed and accuracy with other solvers (benchmarks/README.md)'
	@echo 'make kernels  make machine code of the engine for this machine and the explorer; ARGS="linux-x86_64-v3.so ..." for others'
	@echo 'make dist     build sdist and a wheel for each system into dist/, and try them out; PYTHONS="python3.11 python3.13"'
	@echo 'make pins     renew constraints.txt (CONTRIBUTING.md)'
	@echo 'make clean    remove .venv, all caches and the built documentation; the rest of out/ stays'
	@echo 'PYTHON=...    which python makes the environment, 3.11 or newer; python3'

demo: $(VENV)/.installed-run
	@$(BIN)/vibroimpact sweep B2-G1-A3

# The engine is compiled once before the workers start, or they would wait for one another. A file
# of tests stays with one worker, for its tests share what they compute.
test test-full: $(VENV)/.installed-test
	@$(BIN)/python tests/engine/compiled.py
	$(BIN)/python -m pytest -n auto --maxprocesses 8 --dist loadfile $(FULL) $(ARGS)

test-full: FULL := --full
# What numba compiles, also beside a library of machine code.
test-full: export VIBROIMPACT_ENGINE := numba

# Tests start many processes, and each would compile the sources again.
test test-full: export PYTHONDONTWRITEBYTECODE :=

paper: $(VENV)/.installed-run
	@$(BIN)/python -m paper $(ARGS)

lint: $(VENV)/.installed-lint
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/mypy tests/typing
	$(BIN)/lint-imports --no-logo
	$(BIN)/python docs/check_words.py README.md CONTRIBUTING.md CHANGELOG.md docs benchmarks/README.md src paper

format: $(VENV)/.installed-lint
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# What is not newer than its page is not built again.
docs: $(VENV)/.installed-docs
	$(BIN)/python -m sphinx -W --keep-going -q -j auto -c docs . out/site $(ARGS)
	$(BIN)/python docs/check_links.py out/site
	$(BIN)/python docs/check_widths.py out/site

bench: $(VENV)/.installed-bench
	$(BIN)/python -m benchmarks $(ARGS)

# All targets are listed in native/__main__.py.
kernels: $(VENV)/.installed-release
	$(BIN)/python -m native $(ARGS)

# Where emulators are installed, libraries of other systems are compared with this machine's.
dist: $(VENV)/.installed-release $(VENV)/.installed-test
	$(BIN)/python -m native release
	$(BIN)/python -m pytest --full -rs tests/engine/test_other_systems.py
	rm -rf dist
	$(BIN)/python -m build --outdir dist .
	@for platform in $$(cd src/vibroimpact/engine/libraries && ls | sed -n 's/-v[0-9]*\..*//p' | sort -u); do \
	    VIBROIMPACT_PLATFORM=$$platform $(BIN)/python -m build --wheel --outdir dist . || exit 1; done
	$(BIN)/python -m twine check --strict dist/*
	$(BIN)/python tests/distribution.py dist $(PYTHONS)

# What pip builds the package with is pinned too: hatchling, its plugin, and editables, which hatchling
# asks for when pip installs with -e. The oldest Python needs the most packages.
pins:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' || { \
	    echo 'make: pins are made with the oldest Python that is supported;' \
	        'name one: make pins PYTHON=python3.11' >&2; exit 1; }
	rm -rf $(VENV)-pins
	$(PYTHON) -m venv $(VENV)-pins
	PIP_CONSTRAINT= PIP_BUILD_CONSTRAINT= \
	    $(VENV)-pins/bin/python -m pip install -q -U setuptools hatchling hatch-fancy-pypi-readme \
	    editables '.[test,lint,docs,bench,release]'
	$(VENV)-pins/bin/python -m pip freeze --all --exclude pip --exclude vibroimpact > $(VENV)-pins/constraints.txt
	@! grep -vE '^[A-Za-z0-9._-]+==[A-Za-z0-9.!+_-]+$$' $(VENV)-pins/constraints.txt || { \
	    echo 'make: these are not plain name==version lines' >&2; exit 1; }
	mv $(VENV)-pins/constraints.txt constraints.txt
	rm -rf $(VENV)-pins

clean:
	rm -rf $(VENV) $(VENV)-pins dist .pytest_cache .hypothesis .mypy_cache .ruff_cache \
	    .import_linter_cache .benchmarks out/site docs/gallery docs/reference/api
	find src tests benchmarks examples -name __pycache__ -type d -prune -exec rm -rf {} +

# The extra that each installation takes; none to run.
EXTRA_run   :=
EXTRA_test  := [test]
EXTRA_lint  := [lint]
# The table of validation is computed by what the tests compute it with.
EXTRA_docs  := [docs,test]
EXTRA_bench := [bench]
EXTRA_release := [release]

$(VENV)/.installed-%: $(VENV)/.made pyproject.toml constraints.txt src/vibroimpact/_version.py
	@touch $(UNFINISHED)
	@echo 'make: installing vibroimpact$(EXTRA_$*) into $(VENV)' \
	    '(the first time this loads about 130 MB) ...'
	@$(BIN)/python -m pip install --progress-bar off -e '.$(EXTRA_$*)' \
	    > $(VENV)/install.log 2>&1 || { tail -n 40 $(VENV)/install.log >&2; \
	    echo 'make: the installation failed; the reason stands above, and all that was said in' \
	        '$(VENV)/install.log. It needs network access.' >&2; exit 1; }
	@rm -f $(UNFINISHED)
	@touch $@

# The mark of an installation that did not end is newer than .made, so all is made again. So it is
# when the Python that made it has gone.
ifneq ($(shell test -x $(BIN)/python && echo there),there)
.PHONY: $(VENV)/.made
endif

$(VENV)/.made: $(wildcard $(UNFINISHED))
	@command -v $(PYTHON) > /dev/null || { \
	    echo 'make: there is no $(PYTHON); vibroimpact needs Python 3.11 or newer. Install it,' \
	        'or name one: make PYTHON=python3.12 ...' >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	    echo "make: vibroimpact needs Python 3.11 or newer; $(PYTHON) is" \
	        "$$($(PYTHON) -V 2>&1). Name another: make PYTHON=python3.12 ..." >&2; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2> /dev/null || { \
	    echo 'make: $(PYTHON) cannot make virtual environments; install its venv module' \
	        '(on Debian and Ubuntu the package python3-venv)' >&2; exit 1; }
	@if test ! -e $(UNFINISHED) && $(BIN)/python -c \
	    'import pip, sys; sys.exit(sys.version_info < (3, 11))' 2> /dev/null; \
	then \
	    echo 'make: using the environment that is in $(VENV)'; \
	else \
	    rm -rf $(VENV) && mkdir -p $(VENV) && touch $(UNFINISHED) && \
	        $(PYTHON) -m venv $(VENV) && rm -f $(UNFINISHED); \
	fi
	@touch $@
