"""The process image: values come in only in LATCH and go out only in PUBLISH.

Who brings values in or takes them out enters a call here: plant models and recorders of tests, the
extensions, and `plcsim.shared_image`, through which other processes read and write. Forced tags
come last in LATCH and first in PUBLISH: nobody gets round a force.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.owners import bits_of
from plcsim.core.scan import Phase

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.forces import Forces
    from plcsim.core.scan import Scan
    from plcsim.core.task import TaskClass


class ProcessImage:
    """What is called at the right moments of the scan, in the order in which it was entered.

    Args:
        forces: the forced tags.

    Attributes:
        inputs: called in LATCH with the task class; here a plant model sets inputs.
        watchers: called in PUBLISH with the task class; here a recorder reads tags.
        followers: called with address and bytes of every store that came from outside, as it is
            done.
        exchanges: called between two cycles, now and then while the controller is paused; here
            commands of other processes are taken, and shown what they did.
    """

    def __init__(self, forces: Forces) -> None:
        self.inputs: list[Callable[[TaskClass], None]] = []
        self.watchers: list[Callable[[TaskClass], None]] = []
        self.followers: list[Callable[[int, bytes], None]] = []
        self.exchanges: list[Callable[[], None]] = []
        self._forces = forces
        self._scan: Scan | None = None

    def attach(self, scan: Scan) -> None:
        """Tell the image whose phases it must keep to."""
        self._scan = scan

    def held(self) -> int:
        """Return the classes that are preempted in the middle of a cycle, as bits of owners."""
        in_cycle = self._scan.in_cycle if self._scan is not None else []
        return bits_of(in_cycle[:-1]) if len(in_cycle) > 1 else 0

    def latch(self, task_class: TaskClass) -> None:
        """Let the inputs of a class be set.

        Raises:
            PhaseError: the scan is not in LATCH.
        """
        scan = self._scan
        if scan is not None and scan.phase is not Phase.LATCH:
            scan.require(Phase.LATCH)
        for bring_in in self.inputs:
            bring_in(task_class)
        if self._forces.stores:
            self._forces.apply(self.held())

    def publish(self, task_class: TaskClass) -> None:
        """Let the watchers see the tags.

        Raises:
            PhaseError: the scan is not in PUBLISH.
        """
        scan = self._scan
        if scan is not None and scan.phase is not Phase.PUBLISH:
            scan.require(Phase.PUBLISH)
        if self._forces.stores:
            self._forces.apply(self.held())
        for watch in self.watchers:
            watch(task_class)
