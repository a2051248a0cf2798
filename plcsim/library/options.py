"""Tables [library.NAME] of plc.toml: which libraries have settings, and what they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.errors import Findings
from plcsim.core.suggestion import did_you_mean
from plcsim.library.astcp.settings import AsTcpSettings

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.settings import Table

SETTINGS: Final[dict[str, type]] = {"AsTCP": AsTcpSettings}


def read_options(tables: Mapping[str, Table]) -> list[object]:
    """Return the settings of libraries.

    Args:
        tables: of each library by its name.

    Raises:
        ConfigurationError: no such library has settings, or some of them are wrong.
    """
    findings = Findings()
    result: list[object] = []
    for name, table in tables.items():
        with findings.gathered():
            if name not in SETTINGS:
                hint = did_you_mean(name, SETTINGS) or f"; there are {', '.join(SETTINGS)}"
                raise table.error("", f"no library with settings is called so{hint}")
            result.append(table.read(SETTINGS[name]))
    findings.check()
    return result
