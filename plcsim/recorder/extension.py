"""The extension of the table [record]: records what the controller does, in a bag."""

from __future__ import annotations

import hashlib
import sys
from dataclasses import asdict
from typing import TYPE_CHECKING, Final

from plcsim.core.control import Step
from plcsim.core.logbook import Severity
from plcsim.project.extension import Attachment, Extension
from plcsim.recorder.journal.clock import RecordedClock
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.network import RecordedNetwork
from plcsim.recorder.journal.record import record_of
from plcsim.recorder.journal.tape import Tape
from plcsim.recorder.settings import RecordProject, read_settings

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller
    from plcsim.core.logbook import Entry
    from plcsim.network import Network
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.bag.writing import Writing
    from plcsim.settings.table import Table
    from plcsim.shared_image.stream import StreamWriter

SOURCES: Final = frozenset((".py", ".st", ".c", ".h", ".typ", ".var", ".fun", ".toml"))
"""Files that a run depends on, by their ending."""


class RecordExtension(Extension):
    """Records of a controller."""

    def read(self, table: Table) -> RecordProject:
        """Return the settings."""
        return read_settings(table)

    def in_process(self, settings: RecordProject, ip: str) -> RecordProject:
        """Return the settings for the virtual clock, which waits for the file to be written."""
        return settings._replace(is_in_process=True)

    def in_test(self, settings: RecordProject, ip: str) -> RecordProject:
        """Return the settings for a test, which is not recorded."""
        return settings._replace(is_off=True)

    def service(self, settings: RecordProject) -> str:
        """Return the module that writes the bag."""
        if settings.is_off or (settings.is_in_process and not settings.settings.live):
            return ""
        module = "live_process" if settings.is_in_process else "process"
        return f"plcsim.recorder.service.{module}"

    def stopping_s(self, settings: RecordProject) -> float:
        """Return the time to write what is still in the image, and the index."""
        return 60.0

    def endpoint(self, settings: RecordProject) -> str:
        """Return the file."""
        return settings.settings.file

    def surround(
        self, settings: RecordProject, clock: Clock, network: Network
    ) -> tuple[Clock, Network]:
        """Let clock and network write into a journal."""
        if settings.is_off:
            return clock, network
        journal = Journal()
        return RecordedClock(clock, journal), RecordedNetwork(network, journal)

    def attach(self, settings: RecordProject, controller: Controller) -> Attachment:
        """Make a record of every cycle."""
        clock = controller.clock
        if not isinstance(clock, RecordedClock):
            return Attachment()
        head = _head_of(settings, controller, clock)
        tape = Tape(controller, clock.journal, _nowhere)
        in_scan: _InScan | None = None
        if settings.is_in_process:
            in_scan = _InScan(settings, controller, head)
            tape.write = in_scan.write
        if not self.service(settings):
            return Attachment()
        given = {
            "file": str(settings.file),
            "head": head.to_json(),
            "limits": asdict(settings.settings.limits),
            "live": settings.settings.live,
        }

        def connect(stream: StreamWriter) -> None:
            if in_scan is not None:
                in_scan.show = stream.write
            else:
                tape.write = stream.write  # as it is: one function more would cost each cycle

        return Attachment(given, (), settings.settings.buffer, connect)

    def check(self, settings: RecordProject, controller: Controller) -> Sequence[str]:
        """Check the tags, and that bags can be written."""
        from plcsim.recorder.bag.head import Head  # noqa: PLC0415  # see _InScan
        from plcsim.recorder.bag.types import typestore  # noqa: PLC0415
        from plcsim.recorder.bag.writing import tag_messages  # noqa: PLC0415

        typestore()
        tags = settings.settings.tags
        head = Head("", True, 0, 0, [], controller.areas, tags, {})  # noqa: FBT003  # any will do
        tag_messages(head)
        return ()


def _head_of(settings: RecordProject, controller: Controller, clock: RecordedClock) -> Head:
    from plcsim.recorder.bag.head import Head  # noqa: PLC0415  # see _InScan

    return Head(
        settings.folder.name,
        clock.is_virtual,
        0 if clock.is_virtual else clock.recorded.unix_ns() - clock.recorded.now_ns(),
        controller.origin_ns,
        [(c.number, c.cycle_ns) for c in controller.classes],
        controller.areas,
        settings.settings.tags,
        sources_of(settings.folder),
    )


def sources_of(folder: Path) -> dict[str, str]:
    """Return the SHA-256 of each file that a run of a project depends on."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = file.relative_to(folder)
        hidden = any(
            part.startswith(".") or part in ("tests", "__pycache__") for part in name.parts
        )
        if not hidden and file.suffix.lower() in SOURCES and file.is_file():
            found[name.as_posix()] = hashlib.sha256(file.read_bytes()).hexdigest()
    return found


def _nowhere(_kind: int, _time_ns: int, _record: bytes) -> None:
    """Take a record while nobody is there to send it to."""


class _InScan:
    """Writes the bag in the scan itself, on the virtual clock.

    Where it cannot be written any more the controller goes on without.

    Attributes:
        show: takes each record too, for the live view.
    """

    def __init__(self, settings: RecordProject, controller: Controller, head: Head) -> None:
        # not at the top: beside a recorder of its own the scan has no use for rosbags
        from plcsim.recorder.bag.writing import Writing  # noqa: PLC0415

        limits = settings.settings.limits
        self._writing: Writing | None = Writing(settings.file, head, limits)
        self._number = 0
        self.show: Callable[[int, int, bytes], None] = _nowhere
        self._controller = controller
        controller.logbook.follow(self._log)

    def write(self, kind: int, time_ns: int, data: bytes) -> None:
        """Write a record, then show it; behind the last one the bag is closed."""
        if self._writing is not None:
            record = record_of(data)
            try:
                self._writing.record(self._number, record)
                if record.step == Step.CLOSE.value:
                    self._writing.close()
                    self._writing = None
            except OSError as err:
                self._give_up(err)
            self._number += 1
        self.show(kind, time_ns, data)

    def _log(self, entry: Entry) -> None:
        if self._writing is not None:
            try:
                self._writing.entry(entry)
            except OSError as err:
                self._give_up(err)

    def _give_up(self, err: OSError) -> None:
        if self._writing is None:
            return
        told = self._writing.abandon(err)
        self._writing = None
        self._controller.log(Severity.ERROR, "record", f"the recording ends: {told}")
        sys.stderr.write(f"record: {told}\n")  # whoever looks at no logbook waits for the bag


EXTENSION = RecordExtension()
