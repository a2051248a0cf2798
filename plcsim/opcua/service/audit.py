"""Who wrote what: a line for each write that was applied, and for each that was refused."""

from __future__ import annotations

import math
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Final, Self

from plcsim.access import LineFile
from st_types.types.values import decode

if TYPE_CHECKING:
    from pathlib import Path

    from asyncua.crypto.permission_rules import User

    from plcsim.opcua.service.values import VariableCodec

FILE: Final = ".plcsim/opcua-audit.jsonl"
REFUSED: Final = ".plcsim/opcua-audit-refused.jsonl"
LARGEST: Final = 10 * 1024 * 1024


class WriteLog:
    """The audit log of a project.

    Args:
        folder: of the project.
    """

    def __init__(self, folder: Path) -> None:
        self._applied = LineFile(folder / FILE, LARGEST, 10, "opcua")
        self._refused = LineFile(folder / REFUSED, LARGEST, 2, "opcua")
        self._applied.open()

    def applied(self, user: User, codec: VariableCodec, data: bytes, before: bytes) -> None:
        """Note a write: UTC time, user, tag, value and the value before."""
        tag = codec.leaf.tag
        line = {"tag": tag.path, "value": _shown(tag, data), "before": _shown(tag, before)}
        self._applied.write({**_head(user), **line})

    def refused(self, user: User, node: str, status: str) -> None:
        """Note a refused write: UTC time, user, identifier of the node, status code."""
        self._refused.write({**_head(user), "node": node[:256], "status": status})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._applied.close()
        self._refused.close()


def _head(user: User) -> dict[str, Any]:
    return {"time": datetime.now(UTC).isoformat(timespec="microseconds"), "user": user.name}


def _shown(tag: Any, data: bytes) -> object:
    """Return a value for JSON, which knows neither infinity nor NaN."""
    value = decode(tag.data_type, data)
    if isinstance(value, list):
        return [_number(element) for element in value]
    return _number(value)


def _number(value: object) -> object:
    is_number = not isinstance(value, float) or math.isfinite(value)
    return value if is_number else str(value)
