# make setup | sim | demo | test | check | wheel | bench | fuzz | soak | docs | clean
#
# Everything goes into .venv and build; nothing needs sourcing.

SHELL := /bin/bash
VENV := .venv/bin

# Options for `make sim`, as in: make sim ARGS="--frequency-hz 30"
ARGS ?=
# Options for pytest instead of all tests, as in: make test TESTS="tests/unit -x"
TESTS ?=
# The Python to make .venv from; found when not given.
export PYTHON
# A browser for tests/browser; found when not given.
export CHROMIUM

# A ROS 2 that is sourced, or a parent that runs in a venv with ROS wheels, must not leak in.
unexport PYTHONPATH PYTHONHOME AMENT_PREFIX_PATH CMAKE_PREFIX_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE
ifdef ROS_DISTRO
unexport LD_LIBRARY_PATH
endif

.PHONY: setup sim demo chromium screenshots test check wheel bench fuzz soak docs site clean

setup:
	@tools/setup.sh

sim: setup
	@exec $(VENV)/roller-sim sim $(ARGS)

# The roller and its page; ARGS are those of the roller, PANEL those of the page, as in make demo PANEL="--port 8081".
demo: setup
	@mkdir -p build
	@$(VENV)/roller-sim sim $(ARGS) >build/demo.log 2>&1 & roller=$$!; \
	trap 'kill -TERM $$roller 2>/dev/null; wait $$roller' EXIT; \
	echo "demo: the roller says what it does in build/demo.log; Ctrl-C ends both"; \
	$(VENV)/roller-sim panel $(PANEL)

# The checks come first so that pytest's summary is the last line. What computes runs on all cores; what runs in real
# time and talks over DDS has the machine to itself.
PYTEST = ROS_LOG_DIR="$(CURDIR)/build/ros_log" ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST \
 RMW_IMPLEMENTATION=rmw_fastrtps_cpp $(VENV)/python -m pytest

test: check chromium
	@mkdir -p build/ros_log
ifeq ($(strip $(TESTS)),)
	@$(PYTEST) tests --ignore=tests/integration --ignore=tests/browser --numprocesses=logical --dist=loadfile
	@$(PYTEST) tests/integration tests/browser
else
	@$(PYTEST) $(TESTS)
endif

# What tests/browser run in; quiet when it is there.
chromium:
	@tools/chromium.sh

# The pictures of docs/panel.md, as the test of the page takes them.
screenshots: setup chromium
	@mkdir -p build/ros_log
	@ROLLER_SIM_SCREENSHOTS="$(CURDIR)/docs/figures" $(PYTEST) tests/browser -k screenshots

check: setup
	@echo "check: ruff, mypy --strict, pages"
	@$(VENV)/ruff check --quiet .
	@$(VENV)/ruff format --check --quiet .
	@$(VENV)/mypy --no-error-summary
	@NO_MKDOCS_2_WARNING=1 $(VENV)/mkdocs build --quiet

# The wheel, into dist/, tried in a fresh environment without ROS: what it requires comes by pip, kernels are compiled.
# `test` tries it with links and without compiling.
wheel: setup
	@ROLLER_SIM_WHEEL_TO="$(CURDIR)/dist" $(PYTEST) --timeout=1800 tests/end_to_end/test_wheel.py

bench: setup
	@exec $(VENV)/python -m benchmarks $(ARGS)

# Hostile input: 100 000 items, 10 000 over DDS, atheris for five minutes each. ARGS=--write puts the result into docs.
fuzz: setup
	@$(VENV)/python -m pip install --disable-pip-version-check -q -r requirements/fuzz.txt
	@exec $(VENV)/python -m fuzz --dds 10000 --coverage-guided 300 $(ARGS)

# An hour of real time and a day of simulated time: make soak ARGS=--write
soak: setup
	@exec $(VENV)/python -m soak $(ARGS)

docs: setup
	@$(VENV)/python -m tools.generate_docs
	@$(VENV)/python -m tools.generate_schema
	@$(VENV)/python -m tools.generate_layouts
	@exec $(VENV)/python -m tools.generate_picture

# The pages of docs/ as a site in build/site; a dead link or a page left out is an error. `check` builds it, too.
site: setup
	@NO_MKDOCS_2_WARNING=1 $(VENV)/mkdocs build --quiet && echo "build/site/index.html"

clean:
	rm -rf .venv build install log dist roller_sim_ros.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
