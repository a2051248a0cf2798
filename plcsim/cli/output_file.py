"""Files that commands write: found wrong before long work, not after it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    from pathlib import Path


def check_output(option: str, file: Path | None) -> None:
    """Find out whether a file can be written; None can.

    Raises:
        ConfigurationError: it cannot; the option is named.
    """
    if file is None:
        return
    if not file.parent.is_dir():
        raise ConfigurationError(f"{option} {file}: there is no folder {file.parent}")
    if file.is_dir() or not os.access(file if file.exists() else file.parent, os.W_OK):
        raise ConfigurationError(f"{option} {file}: cannot be written")


def write_output(option: str, file: Path, content: str | bytes) -> None:
    """Write a file.

    Raises:
        ConfigurationError: it cannot be written; the option is named.
    """
    try:
        file.write_bytes(content.encode() if isinstance(content, str) else content)
    except OSError as err:
        raise ConfigurationError(f"{option} {file}: {err.strerror}") from None
