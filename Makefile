# Every command a person types. `make serve` and `make test` install what they need.

PORT ?= 8000
SEED ?= 1
MONKEY_SECONDS ?= 20
# Four or five events each, for every figure: some ten million.
FUZZ_SEQUENCES ?= 72000
# Of each reader of files and each way to go wrong.
FUZZ_FILES ?= 1000000
VENV := .venv
PYTHON := $(VENV)/bin/python
PACKAGE := crates/epipole-python
# The tools of other sites, and the packages that they install.
HOSTS := target/hosts
# Without -p: so that dependencies have the features that the tests compile them with.
BOOK := cargo run --locked --quiet --bin epipole-book --
# Time of the last commit in UTC, if there is one.
COMMITTED = $(shell TZ=UTC git log -1 --date=format-local:%Y-%m-%dT%H:%M:%SZ --format=%cd 2>/dev/null)

.PHONY: help setup setup-build setup-test serve build lab test check test-rust test-bindings python-module test-python test-web test-listings test-browser test-lab test-window test-engines test-hosts test-reproducible monkey fuzz fuzz-files vision vision-docs test-vision bless-vision python-figures python python-linux test-wheel python-docs site pdf test-pdf test-nginx epub test-epub test-nerfstudio bench bench-python bench-lab audit api release-check release-files publish-crates bless bless-contract bless-licenses bless-listings pictures new-figure clean

help: ## says what there is
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-17s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup: setup-build setup-test ## installs what building and testing need

serve: setup-build ## builds the book, serves it at http://localhost:$(PORT), rebuilds when files change
	$(BOOK) serve --port $(PORT)

build: setup-build ## builds the static site in target/book/
	$(BOOK) build

lab: setup-build ## builds the Lab for the browser in target/book/lab/; `make serve` serves it, too
	$(BOOK) lab

test: setup check test-rust test-bindings test-browser ## runs every test but the slow ones: test-lab, test-window, test-engines, test-hosts, test-wheel, test-pdf, test-epub, test-nginx, test-nerfstudio, test-reproducible, monkey

check: setup-build ## format, lints, types, lock files and licenses, without running anything
	cargo fmt --all --check
	cargo clippy --locked --quiet --workspace --all-targets -- -D warnings
	@# The Lab's three modules in the browser leave out what the workspace has.
	for part in page vision-worker files-worker; do \
		cargo check --locked --quiet --target wasm32-unknown-unknown -p epipole-lab --lib --no-default-features --features $$part || exit; \
	done
	cd web && npm run --silent check
	node tests/tools/supply.mjs

# Not the examples, which would be linked one by one: `check` types them, and tests run those of the library.
test-rust: setup-build ## unit tests, documentation tests, Rust listings, figures, layers
	cargo test --locked --workspace --tests
	cargo test --locked --workspace --doc

# Without -p, as above. The module's file has the name by which every Python from 3.10 on finds it; it is
# replaced by another, because a Python may have loaded it.
python-module: setup-build ## builds the native module of the Python package, in its folder
	cargo build --locked --workspace --lib
	cp target/debug/lib_epipole.$(if $(filter Darwin,$(shell uname)),dylib,so) $(PACKAGE)/python/epipole/new.so
	mv $(PACKAGE)/python/epipole/new.so $(PACKAGE)/python/epipole/_epipole.abi3.so

test-python: setup-test python-module ## the Python package; files through pycolmap, OpenCV and evo
	PYTHONPATH=$(PACKAGE)/python $(PYTHON) -m pytest --quiet --durations=10 $(PACKAGE)/tests
	cargo build --locked --quiet --bin epipole
	$(PYTHON) -m pytest --quiet -rs tests/files

# Each of them keeps one processor busy.
test-bindings: setup ## test-python, test-web, test-vision and test-listings, two at a time
	@$(MAKE) --no-print-directory --jobs 2 $(if $(filter output-sync,$(.FEATURES)),--output-sync=target) \
		test-python test-web test-vision test-listings

test-web: setup-build ## unit tests of the elements, without a browser
	cd web && npm test --silent

vision: setup-build ## the npm package of the core, in web/vision/dist/
	$(BOOK) vision
	node web/vision/build.mjs

vision-docs: web/node_modules/.installed ## the reference of the npm package of the core in target/vision-docs/
	web/node_modules/.bin/typedoc --options web/vision/typedoc.json --logLevel Warn

# Without -p, as above.
test-vision: vision ## the npm package of the core: calls, errors, examples, sizes, the bits of every function
	@mkdir -p target
	cargo run --locked --quiet --example js_native -- target/vision-native.json
	EPIPOLE_NATIVE=target/vision-native.json node --test --test-reporter=spec web/vision/test/*.test.mjs

# PYTHONPATH is absolute, because listings and notebooks run in folders of their own.
test-listings: setup-test python-module vision ## the Python and JavaScript listings and the notebooks of the chapters
	PYTHONPATH=$(CURDIR)/$(PACKAGE)/python $(PYTHON) tests/listings/run.py
	node tests/listings/run.mjs
	$(BOOK) notebooks target/book-work/notebooks
	PYTHONPATH=$(CURDIR)/$(PACKAGE)/python $(PYTHON) tests/listings/notebooks.py target/book-work/notebooks

test-browser: setup build vision ## the book, the figures and the npm package of the core in a real browser
	cd tests/browser && npm test --silent

test-lab: setup build tests/engines/node_modules/.installed ## the Lab in Chromium, Firefox and WebKit, after building it
	@tests/tools/engines.sh
	$(BOOK) lab
	cd tests/browser && LAB=1 npx playwright test 'lab(faults|keep)?\.spec'
	cd tests/engines && npm run --silent lab

test-window: setup-build ## the Lab in a window, on a display that nobody sees
	@tests/tools/window.sh
	cargo test --locked -p epipole-lab --features window --test window

test-engines: setup build tests/engines/node_modules/.installed ## the book in Firefox and WebKit, compared with Chromium and with native bits
	@tests/tools/engines.sh
	cd tests/engines && npm test --silent

monkey: setup build ## random hands on every figure: make monkey SEED=7 MONKEY_SECONDS=20
	cd tests/browser && SEED=$(SEED) MONKEY_SECONDS=$(MONKEY_SECONDS) npx playwright test monkey

fuzz: setup-build ## random events on every figure, natively: some ten million, a night's worth; make fuzz FUZZ_SEQUENCES=2000
	FUZZ_SEQUENCES=$(FUZZ_SEQUENCES) cargo test --locked --test fuzz -- --nocapture

# Optimized, where parsers are ten times as fast as in builds for tests, but with all checks.
fuzz-files: export CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS = true
fuzz-files: export CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS = true
fuzz-files: setup-build ## a million damaged files for every reader, ten minutes of one core; make fuzz-files FUZZ_FILES=100000
	EPIPOLE_FUZZ_CASES=$(FUZZ_FILES) cargo test --locked --release --target-dir target/fuzz --package epipole-io --lib fuzz
	EPIPOLE_FUZZ_CASES=$(FUZZ_FILES) cargo test --locked --workspace --bins fuzz

test-nginx: setup build ## the book through nginx as docs/hosting.md configures it, in Chromium; then pages a second
	tests/tools/nginx.sh 8932 tests/tools/served.sh

test-hosts: setup build python-module tests/browser/hosts/node_modules/.installed $(HOSTS)/python/.installed ## figures in the pages of others: site generators, slides, bundlers, notebooks
	@tests/tools/jekyll.sh
	cargo build --locked --quiet --example mdbook
	tests/browser/hosts/prepare.sh
	cd tests/browser && PYTHONPATH=$(CURDIR)/$(PACKAGE)/python npx playwright test --config hosts.config.mjs

test-reproducible: setup-build ## the site twice from nothing in two folders, and compares every byte
	tests/tools/reproducible.sh

python: $(VENV)/.installed ## the Python package, a wheel in target/wheels/
	rm -f target/wheels/epipole-*.whl
	$(PYTHON) -m maturin build --quiet --locked --manifest-path $(PACKAGE)/Cargo.toml --out target/wheels

python-figures: build $(VENV)/.installed ## the files of its figures, a wheel of their own in target/wheels/
	$(PACKAGE)/figures.sh
	rm -f target/wheels/epipole_figures-*.whl
	$(PYTHON) -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir target/wheels $(PACKAGE)/figures

python-linux: $(VENV)/.installed target/zig/.installed ## wheels for Linux, x86-64 and aarch64, glibc 2.28, and the source distribution, in target/wheels-linux/
	tests/tools/wheels_linux.sh

test-wheel: python python-figures ## both wheels in an empty environment: sizes, descriptions, all tests of the package
	tests/tools/wheel.sh

python-docs: python-module target/python-docs-venv/.installed ## the manual of the Python package in target/python-docs/: runs the code of its pages
	NO_MKDOCS_2_WARNING=1 target/python-docs-venv/bin/mkdocs build --strict --quiet --config-file $(PACKAGE)/docs/mkdocs.yml

site: setup-build python-docs vision-docs ## the book with the manuals of the Python and npm packages, in target/book/
	$(BOOK) build --manual target/python-docs --js-reference target/vision-docs

# ADDRESS is where the book is published: with it, each figure has its link.
pdf: setup-test web/print/node_modules/.installed ## the book and each chapter as PDF, in target/pdf/: make pdf ADDRESS=https://example.org/book
	$(BOOK) print $(if $(ADDRESS),--address $(ADDRESS))
	node web/print/pdf.mjs target/print target/pdf

test-pdf: pdf ## the PDF files: contents, page numbers, answers, tags, sizes
	node --test --test-reporter=spec web/print/pdf.test.mjs

epub: setup-build ## the book as EPUB 3, in target/epub/: make epub ADDRESS=https://example.org/book
	$(BOOK) epub $(if $(ADDRESS),--address $(ADDRESS)) $(if $(COMMITTED),--modified $(COMMITTED))

test-epub: epub ## the EPUB file: epubcheck, and every heading, figure and link of the chapters
	tests/tools/epubcheck.sh target/epub/epipole.epub
	cargo test --locked --quiet --workspace --test book -- --ignored --nocapture whole_book

test-nerfstudio: target/nerfstudio/.installed ## transforms.json through nerfstudio's own loader, which installs 6 GB
	cargo build --locked --quiet --bin epipole
	target/nerfstudio/bin/python -m pytest --quiet -rs tests/files/test_nerfstudio.py

audit: setup-build ## known holes in what we build from; asks the registries, so it needs the network
	@tests/tools/audit.sh

bench: setup target/peers/.installed tests/bench/node_modules/.installed ## us and our peers on the same work
	tests/bench.sh

bench-python: python target/peers/.installed ## the Python package beside OpenCV, PoseLib and scikit-image, and beside the library itself
	target/peers/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall target/wheels/epipole-*.whl
	target/peers/bin/python tests/peers/time_python.py $${EPIPOLE_DATA:-../shared/data}
	cargo build --release --locked --manifest-path $(PACKAGE)/Cargo.toml --example native_times
	target/peers/bin/python tests/peers/time_calls.py target/release/examples/native_times

bench-lab: setup build ## what the Lab costs in a browser: seconds, frames, memory
	$(BOOK) lab
	cargo run --locked --quiet -p epipole-lab --example photographs -- target/lab-photographs
	cd tests/browser && node labbench.mjs ../../target/lab-photographs 2500

api: ## what of the library's public surface changed, and whether it breaks users: make api SINCE=v0.1.0
	@tests/tools/api.sh $(SINCE)

release-check: ## whether versions, changelog and packages agree with a tag: make release-check TAG=v0.1.0
	@tests/tools/need.sh node
	@node tests/tools/release.mjs "$$TAG"

release-files: test-wheel python-linux vision site ## what a release contains, in target/release-files/: the book with the Lab, npm packages, wheels
	$(BOOK) lab
	tests/tools/release.sh

publish-crates: ## publishes the crates that are not yet on crates.io at this version; cannot be undone
	@tests/tools/need.sh cargo
	tests/tools/publish.sh

bless: setup-build ## makes the golden images anew; commit them alone, with the reason
	EPIPOLE_BLESS=1 cargo test -p epipole-widgets --test golden

bless-contract: setup-build ## writes web/src/contract.ts anew from the types of epipole-widgets
	EPIPOLE_BLESS=1 cargo test --locked --quiet -p epipole-widgets --lib typescript

bless-vision: setup-build ## writes web/vision/src/api.ts and parts.ts anew from the functions of epipole-js
	EPIPOLE_BLESS=1 cargo test --locked --quiet -p epipole-js --test typescript

bless-licenses: setup-build ## lists anew what we ship that is not ours; read the difference before you commit it
	node tests/tools/supply.mjs --bless

bless-listings: setup-test python-module vision ## records anew what the listings print; read the difference before you commit it
	PYTHONPATH=$(CURDIR)/$(PACKAGE)/python $(PYTHON) tests/listings/run.py --bless
	node tests/listings/run.mjs --bless
	EPIPOLE_BLESS=1 cargo test --quiet --test rust_listings

pictures: setup build ## makes the pictures of README.md anew, from the built book
	cd tests/browser && node pictures.mjs

new-figure: ## writes a new figure: make new-figure NAME=two-cameras
	@crates/epipole-widgets/scaffold/new-figure.sh "$(NAME)"

clean: ## removes everything that was built or installed here
	cargo clean
	rm -rf web/node_modules web/print/node_modules tests/browser/node_modules tests/browser/hosts/node_modules tests/engines/node_modules tests/bench/node_modules $(VENV)

setup-build: web/node_modules/.installed
	@tests/tools/need.sh cargo rustup node npm
	@rustup target list --installed | grep -q wasm32-unknown-unknown || rustup target add wasm32-unknown-unknown

setup-test: setup-build tests/browser/node_modules/.installed $(VENV)/.installed
	@tests/tools/chromium.sh >/dev/null

web/node_modules/.installed: web/package-lock.json
	@tests/tools/need.sh cargo rustup node npm
	cd web && npm ci --no-audit --no-fund --loglevel error
	@touch $@

# Only for `make pdf`, so `make setup` leaves them out.
web/print/node_modules/.installed: web/print/package-lock.json
	cd web/print && npm ci --no-audit --no-fund --loglevel error
	@touch $@

tests/browser/node_modules/.installed: tests/browser/package-lock.json
	cd tests/browser && npm ci --no-audit --no-fund --loglevel error
	@touch $@

tests/engines/node_modules/.installed: tests/engines/package-lock.json
	cd tests/engines && npm ci --no-audit --no-fund --loglevel error
	@touch $@

# Only for `make test-hosts`, so `make setup` leaves them out.
tests/browser/hosts/node_modules/.installed: tests/browser/hosts/package-lock.json
	cd tests/browser/hosts && npm ci --no-audit --no-fund --loglevel error
	@touch $@

$(HOSTS)/python/.installed: tests/browser/hosts/requirements.txt
	@tests/tools/need.sh python3
	python3 -m venv $(HOSTS)/python
	$(HOSTS)/python/bin/python -m pip install --quiet --disable-pip-version-check -r tests/browser/hosts/requirements.txt
	@touch $@

# Large and only for `make bench`, so `make setup` leaves them out.
target/peers/.installed: tests/peers/requirements.txt
	@tests/tools/need.sh python3
	python3 -m venv target/peers
	target/peers/bin/python -m pip install --quiet --disable-pip-version-check -r tests/peers/requirements.txt
	@touch $@

# Only for `make test-nerfstudio`.
target/nerfstudio/.installed: tests/files/nerfstudio.txt
	@tests/tools/need.sh python3
	python3 -m venv target/nerfstudio
	target/nerfstudio/bin/python -m pip install --quiet --disable-pip-version-check --no-deps -r tests/files/nerfstudio.txt
	@touch $@

# A linker for older systems and other processors, only for `make python-linux`.
target/zig/.installed: tests/tools/zig.txt
	@tests/tools/need.sh python3
	python3 -m venv target/zig
	target/zig/bin/python -m pip install --quiet --disable-pip-version-check -r tests/tools/zig.txt
	@touch $@

# Only for `make python-docs`.
target/python-docs-venv/.installed: $(PACKAGE)/docs/requirements.txt
	@tests/tools/need.sh python3
	python3 -m venv target/python-docs-venv
	target/python-docs-venv/bin/python -m pip install --quiet --disable-pip-version-check -r $(PACKAGE)/docs/requirements.txt
	@touch $@

tests/bench/node_modules/.installed: tests/bench/package-lock.json
	cd tests/bench && npm ci --no-audit --no-fund --loglevel error
	@touch $@

$(VENV)/.installed: tests/requirements.txt
	@tests/tools/need.sh python3
	python3 -m venv $(VENV)
	$(PYTHON) -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt
	@touch $@
