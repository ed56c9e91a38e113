# make study   set everything up and write the study, in English and Spanish, into study/en and study/es
# make test    set everything up and run every test
# make lint    formatters, linters, types, imports
# make docs-facts  the generated parts of the documentation
# make bench   the benchmarks, beside their peers
# make lab     the browser laboratory, built and opened
# make wasm-bits  the bits of the whole catalogue in WebAssembly, some minutes
# make lock    renew the locks from pyproject.toml
.DEFAULT_GOAL := help
.PHONY: FORCE help study study-en study-es lab test test-python test-core test-lab wasm-bits lint format docs-facts bench stubs lock clean
.DELETE_ON_ERROR:
SHELL := /bin/sh
PYTHON ?= python3
FOR_UV := UV_PYTHON_DOWNLOADS=never VIRTUAL_ENV=$(CURDIR)/.venv
UV := $(FOR_UV) .tools/bin/uv
# Tests and the study start many processes: modules that are compiled once are imported in a third of the time.
unexport PYTHONDONTWRITEBYTECODE
BIN := $(CURDIR)/.venv/bin
CORES := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
COMPILED := $(shell find core/include core/src bindings/python -type f) CMakeLists.txt
FOR_WASM := $(shell find core/include core/src bindings/wasm -type f) scripts/build-wasm
PAGE := src/pendula/lab/static/lab.html
FOR_PAGE := $(shell find web -type f -not -path '*/node_modules/*') docs/words.toml src/pendula/lab/address.json
TO_WASM := PATH="$(BIN):$$PATH" scripts/with-progress "compiling the core for the browser" build/wasm.log scripts/build-wasm
SOURCES := $(shell find core bindings benchmarks -name '*.hpp' -o -name '*.cpp')

help:
	@sed -n 's/^# \(make .*\)/\1/p' Makefile

# ---- set-up: uv in .tools, everything else in .venv, from the lock ----
.tools/bin/uv:
	@sh scripts/check-machine $(PYTHON)
	$(PYTHON) -m venv .tools
	.tools/bin/pip install -q --disable-pip-version-check uv==0.13.9

.venv/packages: requirements.lock .tools/bin/uv
	@echo "installing what requirements.lock names into .venv"
	@$(UV) venv -q --allow-existing --python "$$(command -v $(PYTHON))" .venv
	@$(UV) pip sync -q --require-hashes requirements.lock
	@touch $@

# an editable install knows the modules it was made with
.venv/modules: .venv/packages FORCE
	@find src/pendula -name '*.py' | sort | cmp -s - $@ || find src/pendula -name '*.py' | sort >$@

# For this computer; with the loops of other processors, too, for the tests and the benchmarks, and once they are there.
LEAST = $(if $(wildcard .venv/every-machine)$(filter %every-machine,$@),plain,here)
.venv/installed .venv/every-machine: .venv/packages .venv/modules pyproject.toml $(COMPILED)
	@PATH="$(BIN):$$PATH" CMAKE_BUILD_PARALLEL_LEVEL=$(CORES) \
	  SKBUILD_CMAKE_DEFINE="PENDULA_STRICT=ON;PENDULA_LEAST_MACHINE=$(LEAST)" $(FOR_UV) \
	  scripts/with-progress "compiling the core" build/install.log .tools/bin/uv pip install -v --no-build-isolation --no-deps -e .
	@touch .venv/installed $@ $(wildcard .venv/every-machine)

.venv/bench: requirements-bench.lock .venv/every-machine
	$(UV) pip install -q --require-hashes --no-deps -r requirements-bench.lock
	@touch $@

# ---- the laboratory's module: the core in WebAssembly, by a compiler from PyPI ----
.venv/lab: requirements-lab.lock .venv/packages
	@echo "installing what requirements-lab.lock names into .venv"
	@$(UV) pip install -q --require-hashes --no-deps -r requirements-lab.lock
	@touch $@

build/wasm/lab.wasm: .venv/lab $(FOR_WASM)
	@$(TO_WASM) lab

# it takes minutes to compile: for changes of the arithmetic, not for every `make test`

# the page: node comes from PyPI, everything else from web/package-lock.json
web/node_modules/.package-lock.json: web/package-lock.json .venv/lab
	@scripts/with-progress "installing what web/package-lock.json names" build/npm.log scripts/npm ci --no-audit --no-fund
	@touch $@

$(PAGE): build/wasm/lab.wasm web/node_modules/.package-lock.json $(FOR_PAGE)
	@scripts/with-progress "building the page" build/page.log scripts/npm run build

lab: .venv/installed $(PAGE)
	@$(BIN)/pendula lab

wasm-bits: .venv/lab .venv/packages
	@$(TO_WASM) same_bits
	@$(BIN)/python scripts/run_wasm.py build/wasm/same_bits.wasm core/tests/same_bits.txt

# ---- the study ----
study: .venv/installed
	@$(MAKE) --no-print-directory -j2 study-en study-es; code=$$?; cat build/study-es.log; exit $$code
	@echo "python and pendula are in .venv: source .venv/bin/activate"
study-en:
	@$(BIN)/pendula study --lang en --out study/en --force
study-es:
	@$(BIN)/pendula study --lang es --out study/es --force >build/study-es.log 2>&1

# ---- tests: the core on each instruction set and under the sanitizers, then the package ----
test: test-core test-python test-lab

test-core: .venv/every-machine
	@$(BIN)/cmake -S . -B build/core -G Ninja -DCMAKE_MAKE_PROGRAM=$(BIN)/ninja -DPython_EXECUTABLE=$(BIN)/python \
	  -DPENDULA_PYTHON=OFF -DPENDULA_TESTS=ON -DPENDULA_STRICT=ON \
	  -DPENDULA_BUILT="$$(ls -dt $(CURDIR)/build/cp*/core/src | head -1)" >build/core.log || { cat build/core.log; exit 1; }
	@$(BIN)/cmake --build build/core --parallel $(CORES) >build/core.log || { cat build/core.log; exit 1; }
	$(BIN)/ctest --test-dir build/core --output-on-failure --parallel $(CORES)

test-python: .venv/every-machine $(PAGE)
	# a worker for each core: threads of a library beside them would wait for one another
	OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n $(CORES)

# the page's own tests, and those in the system's Chromium (scripts/get-chromium)
test-lab: .venv/every-machine $(PAGE)
	@scripts/npm run --silent test
	@scripts/npm run --silent browser

lint: .venv/every-machine web/node_modules/.package-lock.json
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/clang-format --dry-run -Werror $(SOURCES)
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python scripts/check_size.py
	@scripts/npm run --silent check

format: .venv/installed
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix-only .
	$(BIN)/clang-format -i $(SOURCES)

docs-facts: .venv/installed
	$(BIN)/python scripts/docs_facts.py

stubs: .venv/installed
	$(BIN)/python -m nanobind.stubgen -q -m pendula._core -o src/pendula/_core.pyi

bench: .venv/bench $(PAGE)
	$(BIN)/python -m benchmarks

lock: .tools/bin/uv
	$(UV) pip compile -q --upgrade --universal --generate-hashes --no-emit-index-url --no-header --python-version 3.11 \
	  --extra io --extra report --extra cluster --extra animation --extra fit --group build --group dev pyproject.toml -o requirements.lock
	$(UV) pip compile -q --upgrade --universal --generate-hashes --no-emit-index-url --no-header --python-version 3.11 \
	  --group bench -c requirements.lock pyproject.toml -o requirements-bench.lock
	$(UV) pip compile -q --upgrade --universal --generate-hashes --no-emit-index-url --no-header --python-version 3.11 \
	  --group lab -c requirements.lock pyproject.toml -o requirements-lab.lock

clean:
	rm -rf .venv .tools build study dist src/pendula/*.so src/pendula/lab/static web/node_modules
