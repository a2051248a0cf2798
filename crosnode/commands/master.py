"""``plcsim master``: the ROS 1 master and parameter server, on its own."""

from __future__ import annotations

import argparse
from typing import Final

from crosnode.commands.later import act_of
from crosnode.graph.uri import DEFAULT_PORT
from plcsim.core.duration import parse_duration_ns

EPILOG: Final = (
    "It listens on the interface of its host: on loopback, where nothing else is said. "
    "Exit codes: 0 ended by Ctrl-C or --for, 1 cannot listen, 2 wrong usage."
)


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command; it sets ``func``, which gives the exit status."""
    text = "ROS 1 master and parameter server, without ROS on the machine"
    parser = subparsers.add_parser(
        "master",
        help=text,
        description=f"{text}.",
        examples=(
            ("plcsim master", "for this machine, until Ctrl-C"),
            ("plcsim master --host 192.168.0.5", "for those who reach this address"),
        ),
        epilog=EPILOG,
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
    parser.add_argument(
        "--bind", metavar="IP", help="own interface to listen on, by default that of the host"
    )
    parser.add_argument(
        "--for", dest="for_ns", type=_duration, metavar="TIME", help='end after TIME, such as "60s"'
    )
    parser.set_defaults(func=act_of("crosnode.commands.serve_master", "run"))


def _port(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text[:9]) <= 0xFFFF:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no port from 1 to 65535")
    return int(text)


def _duration(text: str) -> int:
    try:
        return parse_duration_ns(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
