"""Library runtime as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

__all__ = ["ERR_FUB_BUSY", "ERR_FUB_ENABLE_FALSE", "ERR_NOTIMPLEMENTED", "ERR_OK"]

ERR_OK: Final = 0
"""Done."""

ERR_NOTIMPLEMENTED: Final = 9999
"""The block is there for its name only."""

ERR_FUB_ENABLE_FALSE: Final = 65534
"""The block was called with enable FALSE."""

ERR_FUB_BUSY: Final = 65535
"""The block has not finished: call it again with the same inputs."""
