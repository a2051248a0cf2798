"""Roles: what somebody may do; each includes those before it."""

from __future__ import annotations

from enum import Enum


class Role(Enum):
    """What somebody may do.

    LOOK sees everything. OPERATE writes variables, and stops, starts and pauses the controller.
    ENGINEER does everything: forces, cold starts, single cycles, the speed of virtual time.
    """

    LOOK = "look"
    OPERATE = "operate"
    ENGINEER = "engineer"

    def includes(self, other: Role) -> bool:
        """Return whether this role may do what ``other`` may."""
        order = list(Role)
        return order.index(self) >= order.index(other)
