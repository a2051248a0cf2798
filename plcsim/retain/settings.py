"""The table [retain] of plc.toml; docs/guide/retain.md lists its keys."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

from plcsim.settings import Duration, PathTo, settings

if TYPE_CHECKING:
    from plcsim.settings.table import Table


@settings
class RetainSettings:
    """What [retain] says.

    Attributes:
        folder: in the project's folder, for the two files; it is made where it is missing.
        period_ns: the files are written once in this time at most, and only after a change.
    """

    folder: Annotated[Path, PathTo()] = Path("retain")
    period_ns: Annotated[int, Duration(minimum_ns=10_000_000)] = 100_000_000


class RetainProject(NamedTuple):
    """The settings and the project they belong to.

    Attributes:
        folder: of the files.
        period_ns: see `RetainSettings`.
        is_off: nothing is read or written: on the virtual clock every run begins alike.
    """

    folder: Path
    period_ns: int
    is_off: bool = False


def read_settings(table: Table) -> RetainProject:
    """Return the settings of the table [retain] of a project.

    Raises:
        ConfigurationError: values are wrong; file and field of each are named.
    """
    made = table.read(RetainSettings)
    return RetainProject((table.folder / made.folder).resolve(), made.period_ns)
