"""Data objects that are there before any program runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class MadeObjects:
    """Data objects of a project.

    Attributes:
        contents: by the names of the objects.
    """

    contents: Mapping[str, bytes]
