"""Where pytest itself writes its errors, whatever it captures of the tests."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pytest

STDERR = 2

errors_fd: int | None = STDERR
"""None where pytest tells the stack of a test that hangs, for which there is one timer only."""


def keep(config: pytest.Config) -> None:
    """Keep the standard error of this process, before pytest captures anything."""
    global errors_fd  # noqa: PLW0603  # there is one in a process
    if _tells_stacks(config):
        errors_fd = None
    elif errors_fd == STDERR:
        errors_fd = os.dup(STDERR)


def _tells_stacks(config: pytest.Config) -> bool:
    return config.pluginmanager.hasplugin("faulthandler") and bool(
        float(config.getini("faulthandler_timeout") or 0)
    )
