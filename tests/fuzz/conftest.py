"""The seed of the fuzz, and a tiny finished study whose copies are damaged."""

import os

import pytest
from fuzz_studies import finish

SEED = "10"


@pytest.fixture(scope="session")
def seed() -> str:
    """Seed of every generator; SUBSLIDE_FUZZ_SEED sets another."""
    return os.environ.get("SUBSLIDE_FUZZ_SEED", SEED)


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """Folder of results of a tiny study."""
    return finish(tmp_path_factory.mktemp("study"))


@pytest.fixture
def captured(capfd):
    """Function that gives and forgets what stdout and stderr got, by their file descriptors."""
    return capfd.readouterr
