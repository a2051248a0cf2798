"""The table [record] of plc.toml; docs/record.md lists its keys."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, NamedTuple

from plcsim.recorder.bag.names import SUFFIXES
from plcsim.recorder.bag.writing import Limits
from plcsim.settings import Duration, Size, Whole, settings

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.settings import Table


@settings
class RecordSettings:
    """What [record] says.

    Attributes:
        file: of the bag, in the project's folder; its end tells the format.
        tags: recorded as messages of std_msgs too; a program's name for all of it, "*" for all.
        size: bytes after which the next file begins, 0 for one file.
        duration_ns: time after which the next file begins, 0 for one file.
        files: the oldest is deleted when there are more, 0 keeps all.
        buffer: bytes between the scan and the recorder, which is late at times.
        live: port of the live view for Foxglove, 0 for none; on this host only.
    """

    file: str = "recordings/run.bag"
    tags: tuple[str, ...] = ()
    size: Annotated[int, Size(0, 1 << 50)] = 0
    duration_ns: Annotated[int, Duration()] = 0
    files: Annotated[int, Whole(0, 100_000)] = 0
    buffer: Annotated[int, Size(65_536, 1 << 30)] = 16 * 1024 * 1024
    live: Annotated[int, Whole(0, 65_535)] = 0

    @property
    def limits(self) -> Limits:
        """When the next file begins."""
        return Limits(self.size, self.duration_ns, self.files)


class RecordProject(NamedTuple):
    """The settings and the project they belong to.

    Attributes:
        settings: table [record].
        folder: of the project.
        is_in_process: the scan writes the bag itself: its clock waits for it.
        is_off: nothing is recorded.
    """

    settings: RecordSettings
    folder: Path
    is_in_process: bool = False
    is_off: bool = False

    @property
    def file(self) -> Path:
        """The bag."""
        return self.folder / self.settings.file


def read_settings(table: Table) -> RecordProject:
    """Return the settings of the table [record] of a project.

    Raises:
        ConfigurationError: values are wrong; file and field of each are named.
    """
    folder = table.folder.resolve()
    made = table.read(RecordSettings)
    if not made.file.endswith(SUFFIXES):
        raise table.error("file", f"{made.file!r}: the name of a bag ends in {', '.join(SUFFIXES)}")
    return RecordProject(made, folder)
