"""``plcsim run PROJECT``."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shlex
import signal
import sys
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plcsim.cli.check import notes_on_cpu
from plcsim.cli.console import CommandConsole, print_error
from plcsim.cli.display import LiveTable, print_summary
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.live_logbook import LiveLogbook
from plcsim.cli.output_file import check_output, write_output
from plcsim.cli.project_argument import add_configuration, add_project, configuration_of
from plcsim.cli.terminal import Terminal
from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.process.output import Output
from plcsim.process.supervisor import Supervisor
from plcsim.project.assembly import runnable
from plcsim.project.plc_toml import read_project

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator
    from types import FrameType

    from plcsim.project.plc_toml import Project
    from plcsim.shared_image.status_page import StatusPage

STAYS = "the values of the last cycle can be read until Ctrl-C"

HINT = "Ctrl-C stops it; values in another terminal: plcsim watch {}"

KEEP_GOING = "\nplcsim run --keep-going leaves out the programs that cannot run, and runs the rest"


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "run",
        help="run a project",
        description="Run a project until Ctrl-C, a limit, or a fault. Ctrl-C runs the EXITs; a "
        "second one ends a program that hangs.",
        examples=(
            ("plcsim run my_plc", "until Ctrl-C, with a live table"),
            ("plcsim run", "the project that this folder belongs to"),
            ("plcsim run my_plc --for 10s --report run.json", "ten seconds, and their figures"),
            ("plcsim run my_plc --web", "with its pages for a browser"),
            ("plcsim run my_plc --record run.bag", "what it does can be repeated and looked at"),
            ("plcsim run my_plc --virtual --for 1h", "an hour on the virtual clock, in seconds"),
        ),
        epilog=epilog(
            DONE="ran and stopped",
            FAILED="the project is wrong, or a service (Modbus, the embedded master) could not "
            "serve at any time",
            SERVICE="",
        ),
    )
    add_project(parser)
    parser.add_argument(
        "--for",
        dest="for_ns",
        type=_duration,
        metavar="TIME",
        help='stop after TIME on the controller\'s clock, such as "10s"',
    )
    parser.add_argument(
        "--cycles",
        type=_positive,
        metavar="N",
        help="stop after N cycles of the task class with the lowest number",
    )
    parser.add_argument(
        "--virtual",
        action="store_true",
        help="run on the virtual clock and network, as fast as the host can",
    )
    parser.add_argument(
        "--cold",
        action="store_true",
        help="a cold start: RETAIN variables begin with their initial values, and the values that "
        "[retain] has kept are given up",
    )
    parser.add_argument(
        "--report", type=Path, metavar="FILE", help="write the figures of the run as JSON"
    )
    parser.add_argument(
        "--record",
        type=Path,
        metavar="FILE",
        help="record the run in a bag: .bag of ROS 1, .mcap or .db3 of ROS 2; see `plcsim replay`",
    )
    parser.add_argument(
        "--web",
        action="store_true",
        help="serve the controller's pages, as the table [web] does; "
        "http://127.0.0.1:8080 where that says nothing else; includes --stay",
    )
    parser.add_argument(
        "--stay",
        action="store_true",
        help="do not end in STOPPED or SERVICE before Ctrl-C: the values can still be read, and "
        "the controller can be started again from outside",
    )
    add_configuration(parser)
    parser.add_argument(
        "--keep-going",
        action="store_true",
        help="leave out the programs that cannot run, say why, and run the rest",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(func=run)


def _duration(text: str) -> int:
    try:
        return parse_duration_ns(text)
    except ValueError as err:
        raise argparse.ArgumentTypeError(str(err)) from None


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return int(text)


def run(options: argparse.Namespace) -> int:
    """Run the project and return the exit code."""
    return run_project(options, _read_project(options))


def run_project(options: argparse.Namespace, project: Project) -> int:
    """Run a project that was read, as the options of the command say; return the exit code."""
    check_output("--report", options.report)
    if not (options.quiet or options.virtual):
        for note in notes_on_cpu(project):
            print(f"on this host: {note}", file=sys.stderr)
    terminal = None if options.quiet else _terminal()
    stdout = terminal if terminal is not None and _is_one_terminal() else None
    output = Output(stdout, terminal, patient=options.virtual)
    stays = options.stay or (options.web and options.cycles is None)
    supervisor = Supervisor(
        project,
        virtual=options.virtual,
        for_ns=options.for_ns,
        cycles=options.cycles,
        serves=["record", *["web"] * options.web],
        stays=stays,
        cold=options.cold,
        output=output,
        quiet=options.quiet,
    )
    logbook = None
    if not options.quiet:
        logbook = LiveLogbook(supervisor.events, output.say, with_errors=stays)
    notice = StayNotice(output.say) if stays and not options.quiet else None
    with supervisor, _signals_forwarded(supervisor):
        with _table_on(terminal, _table(project, supervisor, options)):
            result = supervisor.wait(partial(_look, logbook, notice, supervisor.page))
        shown = frozenset() if logbook is None else logbook.shown
        hint = KEEP_GOING if len(project.programs) > 1 and not options.keep_going else ""
        code = _finish(result, options, shown, hint)  # a late Ctrl-C shall not cost the report
        code = code or _judge_services(supervisor.services.never_served)
        if options.stay and code == ExitCode.SERVICE and not supervisor.is_asked_to_stop:
            _stay(supervisor, options)
        return code


def recording(file: Path | None) -> dict[str, dict[str, str]]:
    """Return what ``--record`` says of a project, to be given to `read_project`.

    Raises:
        ConfigurationError: the bag is there already.
    """
    if file is None:
        return {}
    if file.exists():
        raise ConfigurationError(f"--record {file}: exists already, and is not written over")
    return {"record": {"file": str(file.resolve())}}


def _read_project(options: argparse.Namespace) -> Project:
    """Return the project, with what the options say about it; ``--keep-going`` tells what it costs.

    Raises:
        ConfigurationError: something is wrong with it, or the bag is there already.
    """
    given: dict[str, Any] = {**configuration_of(options), **recording(options.record)}
    if options.web:
        given["web"] = {}
    project = read_project(options.project, given)
    if options.keep_going:
        project = runnable(project)
        for text in project.left_out:
            print_error(text)
    return project


class StayNotice:
    """Tells, each time that the controller stops, that the run stays.

    Args:
        say: prints a line.
    """

    def __init__(self, say: Callable[[str], None]) -> None:
        self._say = say
        self._is_told = False

    def look(self, state: State) -> None:
        """Print the line where the state is SERVICE or STOPPED, once until it runs again."""
        has_stopped = state in (State.SERVICE, State.STOPPED)
        if has_stopped and not self._is_told:
            self._say(f"{state.name}: {STAYS}")
        self._is_told = has_stopped


def _look(logbook: LiveLogbook | None, notice: StayNotice | None, page: StatusPage) -> None:
    if logbook is not None:
        logbook.look(time.monotonic_ns())
    if notice is not None:
        notice.look(page.state)


def _terminal() -> Terminal | None:
    """Return the terminal that stderr is, None where it is none that can show a table."""
    console = CommandConsole(stderr=True)
    can = console.is_terminal and not console.is_dumb_terminal and sys.stderr.isatty()
    return Terminal(console) if can else None


def _is_one_terminal() -> bool:
    """Whether stdout is the terminal that stderr is."""
    with contextlib.suppress(OSError):
        return os.fstat(1).st_rdev == os.fstat(2).st_rdev and os.isatty(1)
    return False


def _table(project: Project, supervisor: Supervisor, options: argparse.Namespace) -> LiveTable:
    hint = HINT.format(shlex.quote(str(options.project)))
    services = supervisor.services
    return LiveTable(project, supervisor.page, options.for_ns, lambda: services.states, hint)


@contextlib.contextmanager
def _table_on(terminal: Terminal | None, table: LiveTable) -> Iterator[None]:
    """Show a table, where there is a terminal."""
    if terminal is None:
        yield
        return
    terminal.show(table.picture)
    try:
        yield
    finally:
        terminal.hide()


@contextlib.contextmanager
def _signals_forwarded(supervisor: Supervisor) -> Iterator[None]:
    """Let SIGINT and SIGTERM ask for a stop, and so the end of the terminal, unless under nohup."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        supervisor.stop()

    numbers = [signal.SIGINT, signal.SIGTERM]
    if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
        numbers.append(signal.SIGHUP)
    before = {number: signal.signal(number, stop) for number in numbers}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _stay(supervisor: Supervisor, options: argparse.Namespace) -> None:
    if not options.quiet:
        with contextlib.suppress(OSError):
            print(STAYS, file=sys.stderr)
    supervisor.stay()


def _finish(
    result: dict[str, Any],
    options: argparse.Namespace,
    shown: Collection[tuple[int, str, str]],
    hint: str,
) -> int:
    """Write the report, print the summary, and return the exit code.

    Raises:
        ConfigurationError: the project is wrong; it is told what is and, of programs, the hint.
    """
    if "error" in result:
        raise ConfigurationError(result["error"] + ("" if "is_of_extension" in result else hint))
    in_service = result["state"] == "SERVICE"
    unwritten = _write_report(result, options.report)
    if not options.quiet or in_service:
        with contextlib.suppress(OSError):  # nobody may be left to read it
            print_summary(result, shown)
    if unwritten:  # how the run ended was told all the same, and counts more
        print_error(unwritten)
    failed = ExitCode.FAILED if unwritten else ExitCode.DONE
    return ExitCode.SERVICE if in_service else failed


def _write_report(result: dict[str, Any], file: Path | None) -> str:
    """Write the report, where one is wanted; return why it cannot be written, "" where it is."""
    if file is None:
        return ""
    try:
        write_output("--report", file, json.dumps(result, indent=2) + "\n")
    except ConfigurationError as err:
        return str(err)
    return ""


def _judge_services(never_served: list[str]) -> int:
    """Say which services were not there at any time of the run; return the exit code for it."""
    for table in never_served:
        print_error(f"[{table}] never served; the reason stands above")
    return ExitCode.FAILED if never_served else ExitCode.DONE
