"""The live view beside a run on the virtual clock, whose bag the scan writes itself.

It shows what it sees, and the run has no part in it: records that come quicker than people look are
passed over.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from plcsim.recorder.bag.head import head_from
from plcsim.recorder.journal.record import CYCLE, record_of
from plcsim.recorder.service.live import HOST, open_live
from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from plcsim.process.service_main import Service

POLL_S: Final = 0.02


def serve(service: Service) -> None:
    """Show the tags until the process is asked to stop."""
    live = open_live(service, head_from(service.given["head"]))
    if live is not None:
        service.serving(f"live view at ws://{HOST}:{live.port}")
    records = service.image.samples()
    while not service.is_stopping:
        latest = b""
        while found := records.read():
            latest = next((r.data for r in reversed(found) if r.kind == _RECORD), latest)
        record = record_of(latest) if latest else None
        if live is not None and record is not None and record.step == CYCLE:
            live.show(record.time_ns, record.variables)
        time.sleep(POLL_S)
    if live is not None:
        live.close()


_RECORD: Final = EventKind.RECORD.value
