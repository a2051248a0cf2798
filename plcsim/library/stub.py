"""Bodies for blocks and functions of which only the declaration is here: they do nothing.

Libraries of a vendor come compiled for the controller. So that a project which calls them runs, and
its own logic with it, their blocks are idle: outputs keep their initial values, functions return 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.context import Context

LANGUAGE: Final = "stub"


class Stub(NamedTuple):
    """The idle body of a FUNCTION_BLOCK or a FUNCTION; see `plcsim.library.executable`.

    Attributes:
        result: what the function returns.
    """

    result: Any = None

    @property
    def language(self) -> str:
        """None: it is a stub."""
        return LANGUAGE

    def bind(self, _context: Context) -> Callable[..., Any]:
        """Return what does nothing."""
        result = self.result

        def idle(*_parameters: object) -> object:
            return result

        return idle
