"""``plcsim master``: the ROS 1 master and parameter server, on its own."""

from __future__ import annotations

import argparse
from typing import Final

from crosnode.graph.uri import DEFAULT_PORT

LONGEST_S: Final = 366 * 86_400


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command; it sets ``func``, which gives the exit status."""
    text = "ROS 1 master and parameter server, without ROS on the machine"
    parser = subparsers.add_parser(
        "master",
        help=text,
        description=f"{text}.",
        examples=(("plcsim master", "until Ctrl-C"), ("plcsim master --port 11411", "")),
        epilog="Exit codes: 0 ended by Ctrl-C or --for, 1 cannot listen, 2 wrong usage.",
    )
    parser.add_argument(
        "-p",
        "--port",
        type=_port,
        default=DEFAULT_PORT,
        metavar="PORT",
        help=f"to listen on, default: {DEFAULT_PORT}",
    )
    parser.add_argument(
        "--host", metavar="NAME", help="name or number in its URI; ROS_HOSTNAME, ROS_IP, localhost"
    )
    parser.add_argument("--bind", metavar="IP", default="", help="own interface, by default all")
    parser.add_argument(
        "--for", dest="for_s", type=_seconds, metavar="SECONDS", help="end after this time"
    )
    parser.set_defaults(func=_run)


def _port(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text[:9]) <= 0xFFFF:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no port from 1 to 65535")
    return int(text)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1
    if not 0 <= seconds <= LONGEST_S:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no number of seconds such as 60")
    return seconds


def _run(arguments: argparse.Namespace) -> int:
    # Loaded here, so that other commands of plcsim start without it.
    from crosnode.master.process import run  # noqa: PLC0415

    return run(arguments)
