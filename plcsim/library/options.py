"""Tables [library.NAME] of plc.toml: which libraries have options, and who reads them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.library.astcp.settings import Settings as AsTcpSettings

if TYPE_CHECKING:
    from collections.abc import Mapping

READERS = {"AsTCP": AsTcpSettings.read}


def check_options(options: Mapping[str, Mapping[str, object]]) -> None:
    """Find wrong options before anything runs.

    Args:
        options: table of each library by its name.

    Raises:
        ConfigurationError: no such library has options, or one of them is wrong; names the field.
    """
    for name, table in options.items():
        reader = READERS.get(name)
        if reader is None:
            known = ", ".join(READERS)
            raise ConfigurationError(f"library.{name}: no such library; with options are {known}")
        reader(table)
