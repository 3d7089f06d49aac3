"""Settings that hold for every test, and the long lane."""

import numba  # noqa: F401 - loaded before a command line under test asks for a number of threads of its own
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
    """Nothing; slow files come first, so that no core waits at the end; `long` tests are skipped without `--long`."""
    items.sort(key=lambda item: "slow" not in item.keywords)
    if config.getoption("--long"):
        return
    for item in items:
        if "long" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="long lane: make test-all"))
