# The one entry: `make setup` makes what is missing, every other target calls it first.
# PYTHON=/path/to/python3 chooses the interpreter (3.11 to 3.14) that the environment is made with.

SHELL := /bin/bash
.DEFAULT_GOAL := help
.NOTPARALLEL:

export PYTHON
SET_UP := sh ros2_ws/set_up.sh
ENTER := $(SET_UP) && . ros2_ws/setup.bash

# Tests talk on a domain of their own, told apart by the project's folder, and on this host only.
TEST_DOMAIN = $(shell printf '%s' '$(CURDIR)' | cksum | awk '{ print 1 + $$1 % 100 }')
TEST_ENVIRONMENT = ROS_DOMAIN_ID=$(TEST_DOMAIN) ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST PYTEST_DISABLE_PLUGIN_AUTOLOAD=1
# Two processes of tests on two cores, at most four: they compile beside each other, and each holds its own kernels in memory.
PARALLEL = -p xdist -n auto --maxprocesses 4

# Ends a recipe: prints how long it took and hands the status on.
REPORT_TIME = status=$$?; echo "make $@: $$SECONDS s in all"; exit $$status

.PHONY: help setup interfaces run check test lint lower-bounds bench hard bounds mutants measures profile-start pictures compare-field compare-dynamics clean

help:  ## show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-17s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

interfaces: setup  ## build simulation_interfaces, by which other programs steer a run, where ROS 2 comes without it
	@$(SET_UP) simulation_interfaces

setup:  ## make the environment in .ros2/ and build the workspace; does nothing where both are current
	@$(SET_UP)

run:  ## run a ride of tire and seat on real nodes, record a bag, write its report
	@SECONDS=0; bag="bags/car_ride_$$(date +%Y-%m-%d_%H-%M-%S)"; echo "make run: 36 s of a ride, recorded in $$bag"; $(ENTER) && \
	bench run car_ride --pace max --out "$$bag" && { [ ! -e "$$bag" ] || bench report "$$bag"; }; $(REPORT_TIME)

check: lint  ## check style, format and types, run the tests that need neither compiler nor ROS nor programs; for every edit
	@SECONDS=0; $(ENTER) && $(TEST_ENVIRONMENT) python -m pytest tests --check $(PARALLEL) --dist worksteal $(PYTEST_OPTIONS); $(REPORT_TIME)

test:  ## run all the tests: beside each other, then those that start nodes and keep time, one after the other
	@SECONDS=0; $(ENTER) || exit; export $(TEST_ENVIRONMENT); \
	python -m pytest tests -m 'not ros' $(PARALLEL) --dist loadfile --no-loadscope-reorder $(PYTEST_OPTIONS); beside=$$?; \
	python -m pytest tests -m ros $(PYTEST_OPTIONS); alone=$$?; \
	[ $$beside = 5 ] && beside=$$alone; [ $$alone = 5 ] && alone=$$beside; [ $$beside = 0 ] && [ $$alone = 0 ]; $(REPORT_TIME)

lint:  ## check style, format and types
	@$(ENTER) && ruff check && ruff format --check && mypy

LOWEST := .lower-bounds
LOWEST_TESTS := tests/records tests/scene/test_load.py tests/scene/test_resolve.py tests/bag tests/laws tests/compiled/test_jit.py \
  tests/compiled/test_call_graph.py tests/report/test_report.py tests/report/comparison tests/report/metrics tests/run/test_offline.py

lower-bounds:  ## run tests with the oldest versions that setup.py allows, without ROS, in an environment of their own
	@SECONDS=0; $(SET_UP) && .ros2/bin/python -m venv $(LOWEST) && \
	.ros2/bin/uv pip install -q --python $(LOWEST)/bin/python --resolution lowest-direct -r contact_sim_pkg/setup.py --extra test && \
	$(TEST_ENVIRONMENT) $(LOWEST)/bin/python -m pytest -W ignore::DeprecationWarning $(LOWEST_TESTS) $(PYTEST_OPTIONS); $(REPORT_TIME)

bench:  ## measure start-up, real-time factor and error against their goals, and error beside time
	@SECONDS=0; $(ENTER) && bench goals && echo && bench accuracy tire_bump; $(REPORT_TIME)

hard:  ## run the hard cases: value, expectation, margin, verdict; every number of the schema at and beside its bounds; random draws
	@SECONDS=0; $(ENTER) && bench hard && export $(TEST_ENVIRONMENT) && \
	CONTACT_BENCH_FUZZ=all python -m pytest -s tests/faults/test_schema_fuzz.py tests/faults/test_input_fuzz.py && python -m pytest tests --random $(PARALLEL); $(REPORT_TIME)

KERNEL_TESTS = $(addprefix tests/,compiled integrate laws pressure rigid papers rigs studies/hard)

bounds:  ## run the tests of kernels with bounds checks, in a cache of their own
	@SECONDS=0; $(ENTER) && NUMBA_BOUNDSCHECK=1 $(TEST_ENVIRONMENT) python -m pytest $(KERNEL_TESTS) $(PYTEST_OPTIONS); $(REPORT_TIME)

mutants:  ## change lines one at a time on a copy, list the changes that no test notices (MUTANTS=outputs: not physics; papers: physics off by 1 to 5 %)
	@SECONDS=0; $(ENTER) && $(TEST_ENVIRONMENT) python -m tests.mutants $(MUTANTS); $(REPORT_TIME)

measures:  ## measure the shape of the package: folders, circles, tables of effects, shared files of an addition, calls, docstrings
	@$(ENTER) && python -m tests.house $(MEASURE)

profile-start:  ## where the processor time of a first start goes, kernel by kernel, of all its processes (SCENE=name)
	@SECONDS=0; $(ENTER) && python -m contact_sim_lab.goals.start_profile $(SCENE); $(REPORT_TIME)

pictures:  ## draw the gallery of the README anew, by runs of its scenes
	@SECONDS=0; $(ENTER) && python -m contact_sim_lab.pages.gallery docs/images; $(REPORT_TIME)

compare-field:  ## solve the same pressure fields with tamaas and ASPHER, installed apart in .compare-field/, and compare
	@SECONDS=0; $(ENTER) && python -m comparisons.field $(COMPARE_OPTIONS); $(REPORT_TIME)

compare-dynamics:  ## run the same impacts, slides and rests with MuJoCo and PyBullet, installed apart in .compare-dynamics/
	@SECONDS=0; $(ENTER) && python -m comparisons.dynamics $(COMPARE_OPTIONS); $(REPORT_TIME)

clean:  ## remove the environments, the build and the caches of the tools; bags stay
	rm -rf .ros2 .lower-bounds .compare-field .compare-dynamics ros2_ws/build ros2_ws/install ros2_ws/log ros2_ws/on_use .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
