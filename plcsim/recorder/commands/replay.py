"""``plcsim replay``."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from plcsim.cli.exit_codes import ExitCode
from plcsim.core.duration import format_duration
from plcsim.core.tag import leaves
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.extension import sources_of
from plcsim.recorder.replay.replay import Replay
from plcsim.recorder.replay.why import writers
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable
    from pathlib import Path

    from plcsim.core.task import TaskClass
    from plcsim.recorder.bag.head import Head


def replay(options: argparse.Namespace) -> int:
    """Repeat the run."""
    with open_bag(options.bag) as bag:
        head = bag.head()
        _tell_changes(head, options.project)
        application = load(read_project(options.project))
        again = Replay(application, head, bag.records())
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


def why(options: argparse.Namespace) -> int:
    """Tell who wrote a tag."""
    project = read_project(options.project)
    with open_bag(options.bag) as bag:
        head = bag.head()
        _tell_changes(head, options.project)
        found = writers(
            lambda: Replay(load(project), head, bag.records()),
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
