"""Which plant the controller's terminals are wired to."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .control.main import Control


class Wiring:
    """One for each controller: the programs enter themselves in INIT."""

    control: Control

    def __init__(self, _context: object) -> None:
        """Nothing is wired yet."""
