"""The simulated I/O image: channels of I/O modules, and the variables that are mapped to them.

In LATCH of a task class its input channels go to their variables, in PUBLISH its variables go to
their output channels, as the I/O scheduler of a controller does it. Nobody is connected to an input
channel before somebody sets it: from the first value that is not 0 on it counts, and until then the
variable keeps what it has.

A mapping of one variable to another takes two steps likewise: out in PUBLISH of the class of the
one, in in LATCH of the class of the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.memory import Memory
    from plcsim.core.task import TaskClass


class Line(NamedTuple):
    """One line of a mapping, its ends found.

    Attributes:
        channel: address of the channel.
        variable: address of the variable.
        size: bytes that go from one to the other.
        is_inverse: the BOOL is negated on the way.
    """

    channel: int
    variable: int
    size: int
    is_inverse: bool = False


class VariableCopy(NamedTuple):
    """A mapping of one variable to another, its ends found."""

    source: int
    target: int
    size: int
    from_class: int
    to_class: int


class IoImage:
    """Latches and publishes the channels of one controller.

    Args:
        controller: not booted yet.
        inputs: lines by the number of the task class that latches them.
        outputs: likewise, that publishes them.
        copies: of variables to variables.
    """

    def __init__(
        self,
        controller: Controller,
        inputs: Mapping[int, Sequence[Line]],
        outputs: Mapping[int, Sequence[Line]],
        copies: Iterable[VariableCopy] = (),
    ) -> None:
        memory = controller.memory
        self._inputs = {number: _Inputs(memory, lines) for number, lines in inputs.items()}
        self._outputs = {number: _Outputs(memory, lines) for number, lines in outputs.items()}
        links = [_Link(memory, copy) for copy in copies]
        self._sent = _by_class((link.copy.from_class, link) for link in links)
        self._received = _by_class((link.copy.to_class, link) for link in links)
        controller.image.inputs.insert(0, self.latch)
        controller.image.watchers.insert(0, self.publish)
        memory.at_boot(self._reset)

    def _reset(self) -> None:
        for inputs in self._inputs.values():
            inputs.reset()
        for links in self._sent.values():
            for link in links:
                link.value = None

    def latch(self, task_class: TaskClass) -> None:
        """Bring in what the programs of a class read."""
        inputs = self._inputs.get(task_class.number)
        if inputs is not None:
            inputs.latch()
        for link in self._received.get(task_class.number, ()):
            if link.value is not None:
                link.target[:] = link.value

    def publish(self, task_class: TaskClass) -> None:
        """Take out what the programs of a class wrote."""
        outputs = self._outputs.get(task_class.number)
        if outputs is not None:
            outputs.publish()
        for link in self._sent.get(task_class.number, ()):
            link.value = bytes(link.source)


def _by_class(links: Iterable[tuple[int, _Link]]) -> dict[int, list[_Link]]:
    found: dict[int, list[_Link]] = {}
    for number, link in links:
        found.setdefault(number, []).append(link)
    return found


class _Link:
    """A variable that goes to another one."""

    def __init__(self, memory: Memory, copy: VariableCopy) -> None:
        self.copy = copy
        self.source = memory.view(copy.source, copy.size)
        self.target = memory.view(copy.target, copy.size)
        self.value: bytes | None = None


class _Inputs:
    """The input lines of one task class; only those that somebody set cost time."""

    def __init__(self, memory: Memory, lines: Sequence[Line]) -> None:
        self._lines = [
            (memory.view(x.channel, x.size), memory.view(x.variable, x.size), x.is_inverse)
            for x in lines
        ]
        first = min(line.channel for line in lines)
        last = max(line.channel + line.size for line in lines)
        self._all = memory.view(first, last - first)
        self.reset()

    def reset(self) -> None:
        self._waiting = self._lines
        self._connected: list[tuple[memoryview, memoryview, bool]] = []
        self._seen = bytes(self._all)

    def latch(self) -> None:
        if self._waiting and self._all != self._seen:
            self._seen = bytes(self._all)
            self._connected += [line for line in self._waiting if any(line[0])]
            self._waiting = [line for line in self._waiting if not any(line[0])]
        for channel, variable, is_inverse in self._connected:
            if is_inverse:
                variable[0] = not channel[0]
            else:
                variable[:] = channel


class _Outputs:
    """The output lines of one task class; neighbours go in one piece."""

    def __init__(self, memory: Memory, lines: Sequence[Line]) -> None:
        straight = [line for line in lines if not line.is_inverse]
        self._pairs = [
            (memory.view(line.channel, line.size), memory.view(line.variable, line.size))
            for line in _joined(straight)
        ]
        self._inverse = [
            (memory.view(line.channel, 1), memory.view(line.variable, 1))
            for line in lines
            if line.is_inverse
        ]

    def publish(self) -> None:
        for channel, variable in self._pairs:
            channel[:] = variable
        for channel, variable in self._inverse:
            channel[0] = not variable[0]


def _joined(lines: Sequence[Line]) -> list[Line]:
    """Return lines of which both ends lie side by side as one."""
    joined: list[Line] = []
    for line in lines:
        last = joined[-1] if joined else None
        if (
            last is not None
            and last.channel + last.size == line.channel
            and last.variable + last.size == line.variable
        ):
            joined[-1] = last._replace(size=last.size + line.size)
        else:
            joined.append(line)
    return joined
