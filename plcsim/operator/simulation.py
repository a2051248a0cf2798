"""What the table [operator] does to a controller, in LATCH."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.logbook import Severity
from plcsim.operator.stores import GivenValue, tag_of, tag_values

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.core.task import TaskClass
    from plcsim.operator.settings import FollowSettings, OperatorSettings, StepSettings

LOGGED: Final = 100
"""So many steps of a run are in the logbook; one that repeats must not fill it."""

BOOL: Final = "BOOL"


class OperatorStep(NamedTuple):
    """One step, its tags found; see `plcsim.operator.settings.StepSettings`."""

    after_ns: int
    when: tuple[GivenValue, ...]
    values: tuple[GivenValue, ...]
    hold_ns: int | None

    def text(self) -> str:
        """Return what is set, for the logbook."""
        return ", ".join(f"{each.tag.path} := {each.value!r}" for each in self.values)


class OperatorSimulation:
    """Sets the tags of a controller as somebody in front of it, and a plant, would.

    Its time is that of releases, so every run on the virtual clock, and a replay, is the same.

    Args:
        settings: of the table.
        controller: not booted yet.

    Raises:
        ConfigurationError: a tag is not there or cannot take its value; everything is told.
    """

    def __init__(self, settings: OperatorSettings, controller: Controller) -> None:
        findings = Findings()
        self._controller = controller
        self._inputs: tuple[GivenValue, ...] = ()
        self._followers: list[_Follower] = []
        steps = []
        with findings.gathered():
            self._inputs = tag_values(controller, settings.inputs, "operator.inputs")
        for path, follow in settings.follow.items():
            with findings.gathered():
                self._followers.append(_follower(controller, path, follow))
        for number, step in enumerate(settings.steps, 1):
            with findings.gathered():
                steps.append(_step(controller, step, f"operator.step {number}"))
        findings.check()
        self._steps = _Steps(steps, controller, repeat=settings.repeat)

    def hook_in(self) -> None:
        """Let it take part from the next boot on, and say that it is there."""
        controller = self._controller
        controller.image.inputs.insert(0, self.latch)
        controller.memory.at_boot(self._reset)
        told = [f"{tag.path} is simulated: {value!r}" for tag, _, value in self._inputs]
        told += [each.text() for each in self._followers]
        if self._steps.count:
            told.append(f"{self._steps.count} steps of an operator are simulated")
        for text in told:
            controller.log(Severity.WARNING, "operator", text)

    def _reset(self) -> None:
        for follower in self._followers:
            follower.reset()
        self._steps.reset()
        for given in self._inputs:  # INIT shall find them already
            self._controller.memory.write(given.tag.address, given.data)

    def latch(self, _task_class: TaskClass) -> None:
        """Set what is to be set now; nothing while a class is in the middle of its cycle."""
        controller = self._controller
        if controller.image.held():
            return
        now_ns = controller.context.release_ns
        for given in self._inputs:
            _store(controller, given.tag, given.data)
        for follower in self._followers:
            follower.latch(now_ns)
        self._steps.latch(now_ns)


class _Steps:
    """Steps, one after another."""

    def __init__(self, steps: list[OperatorStep], controller: Controller, *, repeat: bool) -> None:
        self._all = steps
        self._controller = controller
        self._repeat = repeat
        self.count = len(steps)
        self.reset()

    def reset(self) -> None:
        self._next = 0
        self._done = 0
        self._since_ns: int | None = None
        self._before: list[tuple[Tag, bytes]] | None = None

    def latch(self, now_ns: int) -> None:
        """Begin or end a step where it is time to; one step at most in a cycle."""
        if self._next == len(self._all):
            return
        if self._since_ns is None:
            self._since_ns = now_ns
        step, passed_ns = self._all[self._next], now_ns - self._since_ns
        if self._before is not None:
            if step.hold_ns is not None and passed_ns >= step.hold_ns:
                for tag, data in self._before:
                    _store(self._controller, tag, data)
                self._end(now_ns)
        elif passed_ns >= step.after_ns and self._is_so(step.when):
            self._do(step, now_ns)

    def _is_so(self, when: tuple[GivenValue, ...]) -> bool:
        read = self._controller.tags.read
        return all(read(each.tag) == each.value for each in when)

    def _do(self, step: OperatorStep, now_ns: int) -> None:
        memory = self._controller.memory
        tags = [each.tag for each in step.values]
        before = [(tag, bytes(memory.read(tag.address, tag.data_type.size))) for tag in tags]
        for each in step.values:
            _store(self._controller, each.tag, each.data)
        self._done += 1
        if self._done <= LOGGED:
            last = "" if self._done < LOGGED else "; further ones are not told"
            self._controller.log(Severity.INFORMATION, "operator", step.text() + last)
        if step.hold_ns is None:
            self._end(now_ns)
        else:
            self._before, self._since_ns = before, now_ns

    def _end(self, now_ns: int) -> None:
        self._before, self._since_ns = None, now_ns
        self._next += 1
        if self._repeat and self._next == len(self._all):
            self._next = 0


class _Follower:
    """A tag that has the value that another one had some time ago."""

    def __init__(self, controller: Controller, tag: Tag, of: Tag, follow: FollowSettings) -> None:
        self._controller = controller
        self._tag = tag
        self._of = of
        self._after_ns = follow.after_ns
        self._inverse = follow.inverse
        self.reset()

    def text(self) -> str:
        """Return what it does, for the logbook."""
        inverse = "the opposite of " if self._inverse else ""
        return f"{self._tag.path} is simulated: follows {inverse}{self._of.path}"

    def reset(self) -> None:
        self._last = b""
        self._due_ns = 0
        self._is_given = True

    def latch(self, now_ns: int) -> None:
        """Note a new value of the one, and give the other the one whose time has come."""
        data = bytes(self._controller.memory.read(self._of.address, self._of.data_type.size))
        if data != self._last:  # what does not last long enough is not followed
            self._last = data
            self._due_ns = now_ns + self._after_ns
            self._is_given = False
        if not self._is_given and now_ns >= self._due_ns:
            self._is_given = True
            self._give(data)

    def _give(self, data: bytes) -> None:
        if self._inverse:
            data = bytes([not data[0]])
        _store(self._controller, self._tag, data)


def _store(controller: Controller, tag: Tag, data: bytes) -> None:
    """Write bytes from outside, and tell those who follow that."""
    controller.memory.write(tag.address, data)
    for told in controller.image.followers:
        told(tag.address, data)


def _step(controller: Controller, step: StepSettings, field: str) -> OperatorStep:
    findings = Findings()
    when: tuple[GivenValue, ...] = ()
    values: tuple[GivenValue, ...] = ()
    with findings.gathered():
        when = tag_values(controller, step.when, f"{field}: when")
    with findings.gathered():
        values = tag_values(controller, step.values, f"{field}: set")
    findings.check()
    return OperatorStep(step.after_ns, when, values, step.hold_ns)


def _follower(controller: Controller, path: str, follow: FollowSettings) -> _Follower:
    field = f"operator.follow.{path}"
    tag, of = tag_of(controller, path, field), tag_of(controller, follow.of, f"{field}.of")
    names = f"{tag.data_type}", f"{of.data_type}"
    if tag.is_constant:
        raise ConfigurationError(f"plc.toml: {field}: the tag is CONSTANT")
    if names[0] != names[1]:
        raise ConfigurationError(f"plc.toml: {field}: is {names[0]}, and {of.path} is {names[1]}")
    if follow.inverse and names[0] != BOOL:
        raise ConfigurationError(f"plc.toml: {field}.inverse: {tag.path} is no BOOL")
    return _Follower(controller, tag, of, follow)
