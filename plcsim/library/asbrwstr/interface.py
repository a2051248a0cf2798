"""Library AsBrWStr as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

__all__ = ["brwU8toUC", "brwUCtoU8"]

brwUCtoU8: Final = 1

brwU8toUC: Final = 0
