"""``plcsim replay``."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Final

from plcsim.cli.command import build_parser
from plcsim.cli.exit_codes import ExitCode
from plcsim.cli.run import recording, run_project
from plcsim.core.duration import format_duration
from plcsim.core.tag import leaves
from plcsim.project.assembly import load
from plcsim.project.extension import extensions
from plcsim.project.plc_toml import read_project
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.types import HEAD
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.extension import sources_of
from plcsim.recorder.replay.replay import Replay
from plcsim.recorder.replay.why import writers
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Collection
    from pathlib import Path

    from plcsim.core.task import TaskClass
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import JournalRecord

PLAYER: Final = "ros_play"
"""Table of the extension that plays the bags of others."""

_PLAYED: Final = ("topic", "clock", "real_clock", "record")


def replay(options: argparse.Namespace) -> int:
    """Repeat the run; play a bag of others."""
    with open_bag(options.bag) as bag:
        if all(topic.name != HEAD for topic in bag.topics):
            return _play(options)
        _refuse(options, "bag of others, which is played and not repeated", _PLAYED)
        head = bag.head()
        _tell_changes(head, options.project)
        application = load(read_project(options.project))
        again = Replay(application, head, bag.records())
        if sys.stderr.isatty():
            again.after_cycle.append(_Progress(bag.end_ns - bag.start_ns))
        start_s = time.perf_counter()
        difference = again.run(_until(again, options))
        took_s = time.perf_counter() - start_s
        ran_ns = bag.end_ns - bag.start_ns
    if difference is not None:
        print(f"it differs in {difference}")
        return ExitCode.DIFFERENT
    if options.to_cycle is not None:
        return _show(again, options)
    recorded = format_duration(ran_ns)
    print(
        f"{again.cycles} cycles repeated exactly: {recorded} in {took_s:.2f} s, "
        f"{ran_ns / 1e9 / took_s:.0f} times as fast"
    )
    return ExitCode.DONE


class _Progress:
    """Tells on the terminal how far a replay is, once a second.

    Args:
        whole_ns: what was recorded.
    """

    def __init__(self, whole_ns: int) -> None:
        self._whole = format_duration(whole_ns)
        self._next_s = time.monotonic() + 1
        self._first_ns: int | None = None

    def __call__(self, _task_class: TaskClass, record: JournalRecord) -> None:
        """Tell it, where it is time."""
        if self._first_ns is None:
            self._first_ns = record.time_ns
        if time.monotonic() >= self._next_s:
            self._next_s += 1
            done_s = (record.time_ns - self._first_ns) // 1_000_000_000
            sys.stderr.write(f"\r\x1b[K{done_s} s of {self._whole}\r")


def _play(options: argparse.Namespace) -> int:
    """Run the project, and let it hear the messages of a bag that plcsim has not recorded."""
    _refuse(options, "recording of plcsim, which is repeated", ("to_cycle", "task_class"))
    if PLAYER not in extensions():
        raise RecordingError(f"{options.bag}: no installed package plays the bags of others")
    keys = {"bag": str(options.bag.resolve()), "topics": options.topic, "clock": options.clock}
    given: dict[str, Any] = {PLAYER: keys, "ros": {}, **recording(options.record)}
    words = ["run", str(options.project), *["--virtual"] * (not options.real_clock)]
    return run_project(build_parser("run").parse_args(words), read_project(options.project, given))


def _refuse(options: argparse.Namespace, meant: str, names: Collection[str]) -> None:
    """Refuse options that are for another kind of bag.

    Raises:
        RecordingError: one is given.
    """
    for name in names:
        if getattr(options, name):
            option = "--class" if name == "task_class" else f"--{name.replace('_', '-')}"
            raise RecordingError(f"{option} is for a {meant}; {options.bag} is another one")


def why(options: argparse.Namespace) -> int:
    """Tell who wrote a tag."""
    project = read_project(options.project)
    with open_bag(options.bag) as bag:
        head = bag.head()
        _tell_changes(head, options.project)
        found = writers(
            lambda watch: Replay(load(project), head, bag.records(), watch),
            options.tag,
            project.folder,
            options.task_class,
            options.cycle,
        )
    for each in found:
        print(each)
    return ExitCode.DONE


def _tell_changes(head: Head, folder: Path) -> None:
    """Say on stderr which files are not those of the recorded run."""
    here = sources_of(folder.resolve() if folder.is_dir() else folder.resolve().parent)
    names = {*here, *head.sources}
    changed = sorted(n for n in names if here.get(n) != head.sources.get(n))
    if changed:
        print(f"changed since it was recorded: {', '.join(changed)}", file=sys.stderr)


def _until(again: Replay, options: argparse.Namespace) -> Callable[[TaskClass], bool] | None:
    if options.to_cycle is None:
        return None
    number = _class_of(again, options)
    return lambda each: each.number == number and each.cycles >= options.to_cycle


def _class_of(again: Replay, options: argparse.Namespace) -> int:
    numbers = [c.number for c in again.controller.classes]
    if options.task_class is None:
        return numbers[0]
    if options.task_class not in numbers:
        known = ", ".join(map(str, numbers))
        raise RecordingError(f"there is no task class {options.task_class}; there are {known}")
    return int(options.task_class)


def _show(again: Replay, options: argparse.Namespace) -> int:
    """Print all tags as they are now."""
    controller, number = again.controller, _class_of(again, options)
    cycles = next(c.cycles for c in controller.classes if c.number == number)
    if cycles < options.to_cycle:
        raise RecordingError(f"the recording ends with cycle {cycles} of task class {number}")
    for area in controller.areas:
        for tag in leaves(area):
            print(f"{tag.path} = {value_text(tag.data_type, controller.tags.read(tag))}")
    return ExitCode.DONE
