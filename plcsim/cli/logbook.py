"""``plcsim logbook``: what a running controller had to say, and what it says."""

from __future__ import annotations

import argparse
import contextlib
import sys
import time
from typing import TYPE_CHECKING

from plcsim.cli.exit_codes import epilog
from plcsim.cli.project_argument import add_project
from plcsim.cli.running import find_running, open_image
from plcsim.core.text import escaped

if TYPE_CHECKING:
    from plcsim.process.run_file import Run
    from plcsim.shared_image.events import LogbookReader

PERIOD_S = 0.2


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "logbook",
        help="print the logbook of a running project",
        description="Print the logbook of a project that runs: seconds since its start, severity, "
        "source, text.",
        examples=(
            ("plcsim logbook my_plc", "what is kept, the oldest first"),
            ("plcsim logbook -n 5 --follow", "the last five entries, then each as it is written"),
        ),
        epilog=epilog(DONE="", FAILED="the project does not run"),
    )
    add_project(parser)
    parser.add_argument(
        "-n", dest="last", type=_count, metavar="N", help="only the last N of those that are kept"
    )
    parser.add_argument(
        "--follow", action="store_true", help="go on until Ctrl-C, or until the run ends"
    )
    parser.set_defaults(func=logbook)


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is not a number")
    return int(text)


def logbook(options: argparse.Namespace) -> int:
    """Print entries."""
    run = find_running(options.project)
    with open_image(run) as reader:
        entries = reader.logbook()
        kept = entries.read()
        if entries.lost:
            print(f"{entries.lost} earlier entries are no longer kept", file=sys.stderr)
        for entry in kept if options.last is None else kept[len(kept) - options.last :]:
            print(escaped(str(entry)))
        if options.follow:
            with contextlib.suppress(KeyboardInterrupt):
                _follow(run, entries)
    return 0


def _follow(run: Run, entries: LogbookReader) -> None:
    lost = entries.lost
    is_alive = True
    while is_alive:
        is_alive = run.is_alive
        for entry in entries.read():
            print(escaped(str(entry)))
        if entries.lost != lost:
            print(f"{entries.lost - lost} entries were too many to be read", file=sys.stderr)
            lost = entries.lost
        sys.stdout.flush()
        if is_alive:
            time.sleep(PERIOD_S)
