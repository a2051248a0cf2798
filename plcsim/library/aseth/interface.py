"""Library AsETH as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

__all__ = ["ethERR_PARAMETER", "ethERR_SYSTEM"]

ethERR_PARAMETER: Final = 32850

ethERR_SYSTEM: Final = 32899
