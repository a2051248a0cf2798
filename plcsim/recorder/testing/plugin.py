"""The pytest plugin, on wherever plcsim is installed: it brings the fixture ``recorder``.

Every run of pytest imports it, so it imports nothing before a test asks for the fixture.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from plcsim.recorder.testing.recorder import RecorderFixture
    from plcsim.testing.plc import Plc

__tracebackhide__ = True


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that writes golden bags anew."""
    parser.getgroup("plcsim").addoption(
        "--update-golden",
        action="store_true",
        help="write the bags that runs are compared with (recorder.assert_same_as)",
    )


@pytest.fixture
def recorder(plc: Plc, request: pytest.FixtureRequest) -> RecorderFixture:
    """Record the controller from here on; files are named from the test's folder."""
    update = bool(request.config.getoption("--update-golden"))
    with import_module("plcsim.testing.session").plain_errors():
        made: RecorderFixture = import_module("plcsim.recorder.testing.recorder").RecorderFixture(
            plc, request.path.parent, update=update
        )
    return made
