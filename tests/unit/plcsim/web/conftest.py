import pytest

from .site import World


@pytest.fixture
def world(tmp_path):
    return World(tmp_path)
