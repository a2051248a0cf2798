"""The status page: one page of shared memory through which the scan is watched from outside.

The scan process writes, and each service whether it serves; their parent reads. Nobody ever waits.
All fields are 64-bit numbers, each
written in one store, so a reader sees every field whole (not all fields of one moment).
"""

from __future__ import annotations

import mmap
import os
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.system import State
from plcsim.core.task import Cause

if TYPE_CHECKING:
    from plcsim.core.task import Task, TaskClass

MAGIC = 0x504C_4353_494D_0001
SIZE = 4096

_MAGIC, _HEARTBEAT, _STATE, _ACTIVE, _TIME, _LOST, _CPU, _PAUSED, _STAYS, _LOADS = range(10)
_CLASSES = 16
_FIELDS_PER_CLASS = 16
_CELL_OF_CAUSE = {
    Cause.PROGRAM: 3,
    Cause.HOST: 4,
    Cause.PREEMPTED: 5,
    Cause.CONTROLLER: 10,
}
_SERVICES = 160
_CELLS_PER_SERVICE = 2


class ServiceState(Enum):
    """How a service does."""

    STARTING = 0
    SERVING = 1
    FAILING = 2


class ClassStatus(NamedTuple):
    """Figures of one task class; durations in nanoseconds."""

    cycles: int
    missed: int
    in_tolerance: int
    by_program: int
    by_host: int
    preempted: int
    execution_ns: int
    longest_execution_ns: int
    lateness_ns: int
    longest_lateness_ns: int
    by_controller: int

    @property
    def violations(self) -> int:
        """Violations of all causes."""
        return self.by_program + self.by_host + self.preempted + self.by_controller


class StatusPage:
    """The page, seen by the writer and by the reader.

    Args:
        fd: a shared memory file, or None to make one.
    """

    def __init__(self, fd: int | None = None) -> None:
        self.fd = os.memfd_create("plcsim-status") if fd is None else fd
        if fd is None:
            os.ftruncate(self.fd, SIZE)
        self._map = mmap.mmap(self.fd, SIZE)
        self._cells = memoryview(self._map).cast("Q")
        if fd is None:
            self._cells[_MAGIC] = MAGIC
            self._cells[_STATE] = State.BOOT.value
        elif self._cells[_MAGIC] != MAGIC:
            raise ValueError("not a status page")

    def close(self) -> None:
        """Give the memory back."""
        self._cells.release()
        self._map.close()
        os.close(self.fd)

    # the writer's side (plcsim.core.controller.Heartbeat)

    def started(self, task: Task) -> None:
        """Note that ``task`` is about to run a unit."""
        cells = self._cells
        cells[_HEARTBEAT] += 1
        cells[_ACTIVE] = task.index + 1

    def finished(self, task_class: TaskClass) -> None:
        """Note the figures of a class whose cycle has ended."""
        cells = self._cells
        cells[_ACTIVE] = 0
        cells[_HEARTBEAT] += 1
        at = _CLASSES + (task_class.number - 1) * _FIELDS_PER_CLASS
        cells[at] = task_class.cycles
        cells[at + 6] = task_class.execution.last_ns
        cells[at + 7] = task_class.execution.maximum_ns
        cells[at + 8] = task_class.lateness.last_ns
        cells[at + 9] = task_class.lateness.maximum_ns
        if task_class.missed:
            cells[at + 1] = task_class.missed
        if task_class.in_tolerance:
            cells[at + 2] = task_class.in_tolerance
        for cause, count in task_class.violations.items():
            if count:
                cells[at + _CELL_OF_CAUSE[cause]] = count

    def beat(self) -> None:
        """Note that the scan is alive, though nothing runs."""
        self._cells[_HEARTBEAT] += 1

    def changed(self, state: State) -> None:
        """Note a new system state."""
        self._cells[_ACTIVE] = 0
        self._cells[_STATE] = state.value
        self._cells[_HEARTBEAT] += 1

    def ticked(self, elapsed_ns: int) -> None:
        """Note the time since the start on the controller's clock."""
        self._cells[_TIME] = elapsed_ns

    def lost(self, size: int) -> None:
        """Note that bytes that programs printed found no room."""
        self._cells[_LOST] += size

    def pinned(self, cpu: int) -> None:
        """Note the processor that the scan stays on."""
        self._cells[_CPU] = cpu + 1

    def paused(self, is_paused: bool) -> None:  # as `Operation` tells it
        """Note whether nothing runs because somebody asked for a pause."""
        self._cells[_PAUSED] = is_paused

    def will_stay(self) -> None:
        """Note that STOPPED and SERVICE do not end the run."""
        self._cells[_STAYS] = True

    def loads(self) -> None:
        """Note that the process has started and loads the programs."""
        self._cells[_LOADS] = True

    # a service's side

    def note_service(self, number: int, state: ServiceState) -> None:
        """Note how a service does."""
        at = _SERVICES + number * _CELLS_PER_SERVICE
        self._cells[at] = state.value
        if state is ServiceState.SERVING:
            self._cells[at + 1] = True

    # the reader's side

    def service_state(self, number: int) -> ServiceState:
        """Return how service ``number`` does, in the order of the project's services."""
        return ServiceState(self._cells[_SERVICES + number * _CELLS_PER_SERVICE])

    def has_served(self, number: int) -> bool:
        """Return True once service ``number`` was there for its clients."""
        return bool(self._cells[_SERVICES + number * _CELLS_PER_SERVICE + 1])

    @property
    def has_started(self) -> bool:
        """Whether the process has begun to load the programs."""
        return bool(self._cells[_LOADS])

    @property
    def heartbeat(self) -> int:
        """Grows with every program that starts and every cycle that ends."""
        return self._cells[_HEARTBEAT]

    @property
    def state(self) -> State:
        """The system state."""
        return State(self._cells[_STATE])

    @property
    def is_paused(self) -> bool:
        """Whether nothing runs because somebody asked for a pause."""
        return bool(self._cells[_PAUSED])

    @property
    def stays(self) -> bool:
        """Whether STOPPED and SERVICE do not end the run."""
        return bool(self._cells[_STAYS])

    @property
    def active(self) -> int | None:
        """Index of the task that runs, None where none does."""
        return self._cells[_ACTIVE] - 1 if self._cells[_ACTIVE] else None

    @property
    def elapsed_ns(self) -> int:
        """Time since the start on the controller's clock, at the end of the last cycle."""
        return self._cells[_TIME]

    @property
    def lost_output(self) -> int:
        """Bytes that programs printed and that found no room."""
        return self._cells[_LOST]

    @property
    def cpu(self) -> int | None:
        """The processor that the scan stays on, None for any."""
        return self._cells[_CPU] - 1 if self._cells[_CPU] else None

    def of_class(self, number: int) -> ClassStatus:
        """Return the figures of task class ``number``."""
        at = _CLASSES + (number - 1) * _FIELDS_PER_CLASS
        return ClassStatus(*self._cells[at : at + 11].tolist())
