"""The recorder: takes records out of the shared image and writes them into bags.

It waits for the scan, never the scan for it. When the scan ends, however it ends, what is still in
the image is written and the bag is closed.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.core.control import Step
from plcsim.recorder.bag.head import head_from
from plcsim.recorder.bag.writing import Limits, Writing
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.record import CYCLE, record_of
from plcsim.recorder.service.live import HOST, Live, open_live
from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from plcsim.process.service_main import Service
    from plcsim.shared_image.stream import StreamRecord

POLL_S: Final = 0.01
MOST: Final = 200
"""Records that are taken at once. Where there are more the recorder is behind: then tags become
messages once for so many cycles. Every cycle has the variables all the same."""

FLUSH_S: Final = 1.0
"""What was recorded is in the file after so long, should this process be killed."""


def serve(service: Service) -> None:
    """Record until the scan ends or the process is asked to stop.

    Raises:
        RecordingError: the bag cannot be written.
    """
    file = Path(service.given["file"])
    head = head_from(service.given["head"])
    writing = Writing(file, head, Limits(**service.given["limits"]), beside_others=True)
    live = open_live(service, head)
    where = f", live view at ws://{HOST}:{live.port}" if live else ""
    service.serving(f"recording into {writing.files[-1]}{where}")
    try:
        Recorder(service, writing, live).run()
    except OSError as err:
        raise RecordingError(writing.abandon(err)) from None


class Recorder:
    """Carries records from the image into the bag.

    Args:
        service: whose image it is.
        writing: the bag.
        live: the live view, None for none.
    """

    def __init__(self, service: Service, writing: Writing, live: Live | None = None) -> None:
        self._service = service
        self._live = live
        self._writing = writing
        self._records = service.image.samples(from_oldest=True)
        self._logbook = service.image.logbook()
        self._told = 0
        self._is_closed = False

    def run(self) -> None:
        """Record until the end."""
        service, flushed_s = self._service, time.monotonic()
        while True:
            is_last = service.is_stopping  # before the last look, so that nothing is left behind
            count = self.carry()
            if is_last and not count:
                break
            if time.monotonic() - flushed_s >= FLUSH_S and not self._is_closed:
                flushed_s = time.monotonic()
                self._writing.flush()
                self._tell()
            if not count:
                time.sleep(POLL_S)
        self._close()

    def carry(self) -> int:
        """Write what has come; return how many records that were."""
        if self._is_closed:
            return 0
        for entry in self._logbook.read():
            self._writing.entry(entry)
        records = self._records.read(MOST)
        is_behind = len(records) == MOST
        for record in records:
            self._write(record, with_tags=not is_behind or record is records[-1])
        return len(records)

    def _write(self, streamed: StreamRecord, *, with_tags: bool) -> None:
        if streamed.kind != EventKind.RECORD.value or self._is_closed:
            return
        record = record_of(streamed.data)
        if self._live is not None and record.step == CYCLE:
            self._live.show(record.time_ns, record.variables)
        self._writing.record(streamed.number, record, with_tags=with_tags)
        if record.step == Step.CLOSE.value:
            self._close()

    def _tell(self) -> None:
        """Say how many records were lost, whenever that has doubled."""
        lost = self._writing.lost
        if lost and lost >= 2 * self._told:
            self._told = lost
            sys.stderr.write(f"record: {lost} records are lost; the host has no time to write\n")

    def _close(self) -> None:
        if not self._is_closed:
            self._is_closed = True
            self._writing.close()
            if self._writing.lost != self._told:
                self._told = 0
                self._tell()
