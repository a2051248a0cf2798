"""Where pytest itself writes its errors, whatever it captures of the tests."""

from __future__ import annotations

import os

errors_fd = 2


def keep() -> None:
    """Keep the standard error of this process; called once, before pytest captures anything."""
    global errors_fd  # noqa: PLW0603  # there is one in a process
    if errors_fd == 2:  # standard error
        errors_fd = os.dup(2)
