from __future__ import annotations

import pytest

from .plc import World


@pytest.fixture
def world() -> World:
    return World()
