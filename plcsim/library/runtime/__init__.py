"""Library runtime: the statuses that all asynchronous function blocks of the controller share."""

from __future__ import annotations

from typing import Final

ERR_OK: Final = 0
ERR_NOTIMPLEMENTED: Final = 9999
ERR_FUB_ENABLE_FALSE: Final = 65534
"""The block was called with enable FALSE."""
ERR_FUB_BUSY: Final = 65535
"""The block has not finished: call it again with the same inputs."""
