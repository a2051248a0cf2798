"""Golden runs: what a controller does in a test, compared with what it did before."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.core.control import Step
from plcsim.recorder.bag.difference import difference
from plcsim.recorder.bag.head import Head
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.writing import Limits, Writing
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.record import record_of
from plcsim.recorder.journal.tape import Tape
from plcsim.recorder.replay.replay import Replay
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from plcsim.testing.plc import Plc

__tracebackhide__ = True


class RecorderFixture:
    """Records the controller under test; what the fixture ``recorder`` is.

    Args:
        plc: the controller under test.
        folder: where relative names of bags begin.
        update: write golden bags instead of comparing with them.
    """

    def __init__(self, plc: Plc, folder: Path, *, update: bool = False) -> None:
        self._plc = plc
        self._folder = folder
        self._update = update
        self._records: list[bytes] = []
        Tape(plc.controller, Journal(), self._keep)

    def _keep(self, _kind: int, _time_ns: int, record: bytes) -> None:
        if self._plc.winding.is_winding and record_of(record).step == Step.BOOT.value:
            self._records.clear()
        self._records.append(record)

    def save(self, file: str | Path) -> Path:
        """Write what was recorded so far into a bag; one that is there is replaced.

        Raises:
            RecordingError: it cannot be written.
        """
        path = self._folder / file
        path.unlink(missing_ok=True)
        writing = Writing(path, self._head(), Limits())
        for number, record in enumerate(self._records):
            writing.record(number, record_of(record))
        writing.close()
        return path

    def _head(self) -> Head:
        controller = self._plc.controller
        return Head(
            self._plc.name,
            is_virtual=controller.clock.is_virtual,
            epoch_ns=0,
            origin_ns=controller.origin_ns,
            classes=[(c.number, c.cycle_ns) for c in controller.classes],
            areas=controller.areas,
            tags=(),
            sources={},
        )

    def assert_same_as(self, file: str | Path) -> None:
        """Require that every cycle so far was as in a golden bag: all tags, all messages.

        ``pytest --update-golden`` writes the bag.

        Raises:
            ExpectationFailed: something differs; the first tag is named with its cycle.
            PlcTestError: there is no such bag, or it is none.
        """
        golden = self._folder / file
        if self._update:
            self.save(golden)
            return
        if not golden.exists():
            raise PlcTestError(f"{golden}: no such bag yet; pytest --update-golden writes it")
        with tempfile.TemporaryDirectory() as folder:
            latest = self.save(Path(folder) / golden.name)
            try:
                with open_bag(golden) as first, open_bag(latest) as second:
                    found = difference(first, second)
            except RecordingError as err:
                raise PlcTestError(str(err)) from None
        if found:
            self._plc.fail(f"expected the run of {golden.name}: {found}", ())

    def assert_repeats(self, file: str | Path) -> None:
        """Require that the project does again what it did when a bag was recorded.

        The bag is one of ``plcsim run --record``, of a machine for example. The controller under
        test has no part in it: another one runs on what was recorded.

        Raises:
            ExpectationFailed: a cycle differs.
            PlcTestError: there is no such bag, or it is of another project.
        """
        try:
            with open_bag(self._folder / file) as bag:
                again = Replay(self._plc.application, bag.head(), bag.records())
                found = again.run()
        except RecordingError as err:
            raise PlcTestError(str(err)) from None
        if found is not None:
            self._plc.fail(f"expected the run of {Path(file).name} again: {found}", ())
