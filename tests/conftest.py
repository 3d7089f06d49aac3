"""Settings that hold for every test, and the long lane."""

import os

import pytest
from hypothesis import settings

settings.register_profile(
    "subslide", deadline=None, derandomize=True
)  # the first call compiles; CI must not be a lottery
settings.load_profile("subslide")


def pytest_addoption(parser):
    """Nothing; `--long` is an option."""
    parser.addoption("--long", action="store_true", help="run the long lane too (make test-all)")


def pytest_collection_modifyitems(config, items):
    """Nothing; tests marked `long` are skipped without `--long`."""
    if config.getoption("--long"):
        return
    for item in items:
        if "long" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="long lane: make test-all"))


@pytest.fixture(autouse=True)
def _threads_of_the_command_line():
    """Nothing; the number of threads that a command line sets stays with its test: numba refuses another one later."""
    before = os.environ.get("NUMBA_NUM_THREADS")
    yield
    if before is None:
        os.environ.pop("NUMBA_NUM_THREADS", None)
    else:
        os.environ["NUMBA_NUM_THREADS"] = before
