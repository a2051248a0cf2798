"""The service: writes the retained variables of the latest snapshot when they have changed.

A snapshot is of one cycle, so what is written is never torn. The scan does not wait for the disk.
When it dies, its last snapshot is still in the shared image and is written then; what is lost is
what it did after its last PUBLISH. When this process dies with it, or the host does, at most a
period is lost, and the time that the disk takes.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.core.duration import format_duration
from plcsim.core.tag import Tag
from plcsim.retain.generations import Generations, describe
from plcsim.shared_image import ImageNotReady
from plcsim.shared_image.directory import type_from

if TYPE_CHECKING:
    from plcsim.process.service_main import Service

POLL_S: Final = 0.02
"""It looks this often whether it is asked to end."""


def serve(service: Service) -> None:
    """Write until the process is asked to stop, and then once more.

    Raises:
        RetainError: the files cannot be written, or another run has them.
    """
    Keeper(service).run()


class Keeper:
    """Keeps the files of one run up to date."""

    def __init__(self, service: Service) -> None:
        given = service.given
        self._service = service
        self._period_ns: int = given["period_ns"]
        variables = [Tag(path, type_from(kind), at) for path, kind, at in given["variables"]]
        self._described = describe(variables)
        offset_of = service.image.directory.offset_of
        self._spans = [
            (offset_of(tag.address, tag.data_type.size), tag.data_type.size) for tag in variables
        ]
        self._start = min((start for start, _ in self._spans), default=0)
        self._end = max((start + size for start, size in self._spans), default=0)
        self._generations = Generations(Path(given["folder"]))
        self._seen = 0
        self._written: bytes | None = None

    def run(self) -> None:
        """Write until asked to stop."""
        service = self._service
        with self._generations.locked():
            latest, _ = self._generations.latest()
            if latest is not None and describe(latest.variables) == self._described:
                self._written = latest.data
            service.serving(
                f"keeping {len(self._spans)} variables in {self._generations.folder}, "
                f"{format_duration(self._period_ns)} after a change at the latest"
            )
            while True:
                is_last = service.is_stopping  # before the last look
                self.look()
                if is_last:
                    return
                self._wait()

    def look(self) -> None:
        """Write what the latest snapshot holds, where that is not written yet."""
        image = self._service.image
        if image.latest == self._seen or not self._spans:
            return
        try:
            self._seen, data = image.copy(self._start, self._end)
        except ImageNotReady:
            return
        start = self._start
        values = b"".join(data[at - start : at - start + size] for at, size in self._spans)
        if values != self._written:
            self._generations.write(self._described, values)
            self._written = values

    def _wait(self) -> None:
        end_ns = time.monotonic_ns() + self._period_ns
        while not self._service.is_stopping and (left_ns := end_ns - time.monotonic_ns()) > 0:
            time.sleep(min(POLL_S, left_ns / 1e9))
