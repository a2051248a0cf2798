"""``plcsim master``: the ROS 1 master and parameter server, on its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    import argparse

DEFAULT_PORT: Final = 11311


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command; it sets ``func``, which gives the exit status."""
    text = "ROS 1 master and parameter server, without ROS on the machine"
    parser = subparsers.add_parser("master", help=text, description=f"{text}.")
    parser.add_argument("-p", "--port", type=int, default=DEFAULT_PORT, metavar="PORT")
    parser.add_argument(
        "--host", metavar="NAME", help="name or number in its URI; ROS_HOSTNAME, ROS_IP, localhost"
    )
    parser.add_argument("--bind", metavar="IP", default="", help="own interface, by default all")
    parser.add_argument(
        "--for", dest="for_s", type=float, metavar="SECONDS", help="end after this time"
    )
    parser.set_defaults(func=_run)


def _run(arguments: argparse.Namespace) -> int:
    # Loaded here, so that other commands of plcsim start without it.
    from crosnode.master_process import run  # noqa: PLC0415

    return run(arguments)
