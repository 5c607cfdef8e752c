# Two commands for a fresh machine: `make fly` and `make test`. Everything lands in .venv, target and runs.

VENV := .venv
BIN := $(VENV)/bin
STAMPS := target/stamps
# processes of the tests in Python, each on one thread
PROCESSES ?= 2
# one target directory, one set of flags and one set of features (that of the workspace) for every use of cargo: nothing is
# compiled twice
CARGO_FLAGS := --release
export CARGO_TARGET_DIR := $(CURDIR)/target
export PATH := $(PATH):$(HOME)/.cargo/bin
# pip's own build environment obeys the constraints too
export PIP_CONSTRAINT := $(CURDIR)/constraints.txt
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export MPLBACKEND := Agg

RUST_SOURCES := $(shell find crates Cargo.toml -name '*.rs' -o -name 'Cargo.toml')
PACKAGE_FILES := $(shell find python -type f -not -path '*/__pycache__/*' -not -name '*.so')

# the first Python on the path that is new enough and can make environments
PYTHON ?= $(firstword $(foreach p,python3 python3.14 python3.13 python3.12 python3.11,$(shell \
	$(p) -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $(p))))
present = $(shell command -v $(1) 2>/dev/null)

.PHONY: fly test validate bench fuzz miri docs wheel clean tools
.NOTPARALLEL:

fly: $(STAMPS)/package
	$(BIN)/wakeflight fly arrested-descent
	@echo "results, figures and report: $(CURDIR)/runs/arrested-descent (open report.html)"

test: $(STAMPS)/dev
	cargo fmt --all --check
	cargo clippy $(CARGO_FLAGS) --workspace --all-targets --quiet -- -D warnings -D missing_docs
	cargo test $(CARGO_FLAGS) --workspace --quiet
	@$(MAKE) --no-print-directory $(STAMPS)/package
	$(BIN)/ruff check python tests validation docs/tools examples
	$(BIN)/ruff format --check python tests validation docs/tools examples
	$(BIN)/mypy
	WAKEFLIGHT_THREADS=1 $(BIN)/python -m pytest -m "not slow" --numprocesses $(PROCESSES) --dist loadfile --no-loadscope-reorder

validate: $(STAMPS)/dev $(STAMPS)/package
	cargo test $(CARGO_FLAGS) --workspace --quiet -- --ignored
	$(BIN)/python -m pytest -m slow
	$(BIN)/wakeflight validate

# tables of docs/numerics/performance.md; QUICK=1 for a short form, PARTS="kernel threads" for some of them
bench: $(STAMPS)/package
	$(BIN)/python benchmarks/bench.py $(if $(QUICK),--quick) $(PARTS)

# what users install: a wheel for this system, of the lowest glibc that the machine built for allows, and the source distribution
wheel: $(STAMPS)/build
	$(BIN)/maturin build $(CARGO_FLAGS) --out dist
	$(BIN)/maturin sdist --out dist

# the site, into site/: pages as they are, reference from docstrings, examples executed (kept until they change)
docs: $(STAMPS)/docs $(STAMPS)/package
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --quiet
	@echo "documentation: $(CURDIR)/site/index.html"

# random inputs of every kind, a hundred thousand of them: CASES, SEED and WORKERS are yours to choose
fuzz: $(STAMPS)/dev $(STAMPS)/package
	$(BIN)/python tests/fuzz/fuzz.py --cases $(or $(CASES),100000) --seed $(or $(SEED),1) --workers $(or $(WORKERS),2)

# the team of threads under Miri, in several orders of its threads: needs a nightly toolchain with the component miri
miri:
	MIRIFLAGS="-Zmiri-disable-isolation -Zmiri-ignore-leaks -Zmiri-many-seeds=0..$(or $(SEEDS),4)" \
		cargo +nightly miri test --package wakeflight --lib -- vortex::team

clean:
	rm -rf $(VENV) target runs dist site .pytest_cache .ruff_cache .mypy_cache .hypothesis

# one clear line for what is missing
tools:
	@$(if $(PYTHON),,$(error wakeflight needs Python 3.11 or newer with pip and venv (Debian: python3 python3-venv)))
	@$(if $(call present,cargo),,$(error wakeflight needs a Rust toolchain: cargo was not found (https://rustup.rs)))
	@$(if $(call present,cc),,$(error wakeflight needs a C linker: cc was not found (Debian: gcc)))

$(BIN)/python: | tools
	$(PYTHON) -m venv $(VENV)

# core dependencies alone: they change seldom, so they have a stamp of their own
$(STAMPS)/core: pyproject.toml constraints.txt | $(BIN)/python
	@mkdir -p $(STAMPS)
	$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["dependencies"], sep="\n")' > $(STAMPS)/core.txt
	$(BIN)/python -m pip install --quiet --requirement $(STAMPS)/core.txt
	@touch $@

$(STAMPS)/dev: $(STAMPS)/core
	$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["dependency-groups"]["dev"], sep="\n")' > $(STAMPS)/dev.txt
	$(BIN)/python -m pip install --quiet --requirement $(STAMPS)/dev.txt
	@touch $@

$(STAMPS)/docs: $(STAMPS)/core
	$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["dependency-groups"]["docs"], sep="\n")' > $(STAMPS)/docs.txt
	$(BIN)/python -m pip install --quiet --requirement $(STAMPS)/docs.txt
	@touch $@

$(STAMPS)/build: $(STAMPS)/core
	$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["dependency-groups"]["build"], sep="\n")' > $(STAMPS)/build.txt
	$(BIN)/python -m pip install --quiet --requirement $(STAMPS)/build.txt
	@touch $@

# the wheel, built by pip through maturin in release and installed: tests run what users run, not the checkout
$(STAMPS)/package: $(STAMPS)/core $(RUST_SOURCES) $(PACKAGE_FILES) README.md LICENSE-MIT LICENSE-APACHE
	$(BIN)/python -m pip install --quiet --no-deps --force-reinstall .
	@touch $@
