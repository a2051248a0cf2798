"""Adds the commands of this house; what needs rosbags is imported when one of them runs."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.project_argument import HELP as PROJECT_HELP
from plcsim.cli.project_argument import add_project, own_project

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

BAG_HELP = "a bag that plcsim has recorded"
CLASS_HELP = "whose cycles are counted (default: the one with the lowest number)"


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the commands."""
    _add_replay(subparsers)
    _add_why(subparsers)
    bag = subparsers.add_parser(
        "bag",
        help="look into a recording: what it holds, and where two differ",
        description="What `plcsim run --record` has written.",
        epilog=epilog(DONE="", FAILED="a bag is wrong", DIFFERENT=""),
    )
    commands = bag.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_info(commands)
    _add_diff(commands)
    _add_plot(commands)
    _add_export(commands)
    _add_reindex(commands)


def _add_replay(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "replay",
        help="repeat a recorded run, cycle by cycle, or play a bag of ROS to a project",
        description="A bag of plcsim: run a project on what clock, network and writers outside "
        "gave it while it was recorded. Every cycle must end with the same variables; the first "
        "one that does not is told. Nothing reaches the world. A bag of others, of rosbag record "
        "or ros2 bag: run the project, and its programs hear each message at its recorded time.",
        examples=(
            ("plcsim replay run.bag my_plc", "the whole run, as fast as it goes"),
            ("plcsim replay run.bag", "inside the project's folder"),
            ("plcsim replay run.bag --to-cycle 500", "what the tags were after cycle 500"),
            (
                "plcsim replay field.bag my_plc --record out.bag",
                "messages of others, on the virtual clock; what the project did is recorded",
            ),
        ),
        epilog=epilog(
            DONE="the run was repeated exactly",
            FAILED="the bag or the project is wrong",
            DIFFERENT="a cycle differs",
        ),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help=BAG_HELP)
    add_project(parser)
    parser.add_argument("--to-cycle", type=int, metavar="N", help="stop there and print the tags")
    parser.add_argument(
        "--class",
        dest="task_class",
        type=int,
        metavar="N",
        help=CLASS_HELP,
    )
    played = parser.add_argument_group("only for a bag of others")
    played.add_argument(
        "--topic",
        action="append",
        default=[],
        metavar="TOPIC",
        help="play this one, may be given again (default: those that the programs subscribe to)",
    )
    played.add_argument("--clock", action="store_true", help="publish /clock, the time in the bag")
    played.add_argument(
        "--real-clock", action="store_true", help="run on the real clock, with the real network"
    )
    played.add_argument("--record", type=Path, metavar="FILE", help="record what the project does")
    parser.set_defaults(func=_later("plcsim.recorder.commands.replay", "replay"))


def _add_why(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "why",
        help="tell who wrote a tag in a recorded run, with program, line and cycle",
        description="Repeat a recorded run and tell who wrote a tag last: the program, its line "
        "of the source, or what came from outside; the latest write last.",
        examples=(
            ("plcsim why run.bag tank.valve", "at the end of the recording"),
            ("plcsim why run.bag tank.valve --cycle 500", "up to and with cycle 500"),
        ),
        epilog=epilog(DONE="", FAILED="the bag or the project is wrong, or there is no such tag"),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help=BAG_HELP)
    parser.add_argument("tag", metavar="TAG", help="such as tank.valve")
    parser.add_argument(
        "--project", type=Path, default=own_project(), metavar="PROJECT", help=PROJECT_HELP
    )
    parser.add_argument("--cycle", type=int, default=0, metavar="N", help="not later than this")
    parser.add_argument(
        "--class", dest="task_class", type=int, default=0, metavar="N", help=CLASS_HELP
    )
    parser.set_defaults(func=_later("plcsim.recorder.commands.replay", "why"))


def _add_info(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "info",
        help="print what a bag holds",
        description="Print what a bag holds, whoever has recorded it.",
        examples=(("plcsim bag info run.bag", ""),),
        epilog=epilog(DONE="", FAILED="the bag is wrong"),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help="a bag of ROS 1 or ROS 2")
    parser.set_defaults(func=_later("plcsim.recorder.commands.bag", "info"))


def _add_diff(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "diff",
        help="tell the first cycle in which two recordings differ",
        description="Compare two recordings of a project: the first tag that differs, with its "
        "cycle and both values, or the first message.",
        examples=(("plcsim bag diff yesterday.bag today.bag", ""),),
        epilog=epilog(DONE="they are the same", FAILED="a bag is wrong", DIFFERENT="they differ"),
    )
    parser.add_argument("first", type=Path, metavar="BAG", help=BAG_HELP)
    parser.add_argument("second", type=Path, metavar="BAG", help="another one")
    parser.set_defaults(func=_later("plcsim.recorder.commands.bag", "diff"))


def _add_plot(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "plot",
        help="draw tags over time",
        description="Draw tags of a recording over time, each cycle, whether they were recorded as "
        "messages or not.",
        examples=(("plcsim bag plot run.bag tank.level tank.valve -o level.svg", ""),),
        epilog=epilog(DONE="", FAILED="the bag is wrong, or has no such tag"),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help=BAG_HELP)
    parser.add_argument("tags", nargs="+", metavar="TAG", help="such as tank.level")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help=".png, .svg or .html"
    )
    parser.set_defaults(func=_later("plcsim.recorder.commands.bag", "plot"))


def _add_export(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "export",
        help="write tags of every cycle as CSV or Parquet",
        description="Write tags of a recording as a table, a row for every cycle.",
        examples=(
            ("plcsim bag export run.bag tank.level tank.valve -o level.csv", ""),
            ("plcsim bag export run.bag tank -o tank.parquet", "for pandas and other notebooks"),
        ),
        epilog=epilog(DONE="", FAILED="the bag is wrong, or has no such tag"),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help=BAG_HELP)
    parser.add_argument("tags", nargs="+", metavar="TAG", help="such as tank.level")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="a .parquet file, or CSV; otherwise CSV on stdout",
    )
    parser.set_defaults(func=_later("plcsim.recorder.commands.bag", "export"))


def _add_reindex(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "reindex",
        help="make a bag readable that was not closed",
        description="Copy what is complete in a bag of ROS 1 whose recorder was killed, or whose "
        "disk was full, into one with an index. The bag itself stays as it is.",
        examples=(
            ("plcsim bag reindex run.bag.active", "makes run.bag"),
            ("plcsim bag reindex cut.bag -o whole.bag", "of any bag, of rosbag record too"),
        ),
        epilog=epilog(DONE="", FAILED="it is no bag of ROS 1, or the other one is there already"),
    )
    parser.add_argument("bag", type=Path, metavar="BAG", help="a bag of ROS 1")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="the bag that is made")
    parser.set_defaults(func=_later("plcsim.recorder.commands.bag", "reindex"))


def _later(module: str, name: str) -> Callable[[argparse.Namespace], int]:
    """Return a command that is imported when it is called."""

    def run(options: argparse.Namespace) -> int:
        command: Any = getattr(import_module(module), name)
        return ExitCode(command(options))

    return run
