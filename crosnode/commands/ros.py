"""``plcsim ros``: what a ROS 1 type is, its md5, and messages between JSON and bytes.

This module only declares the commands: numpy, which they need, is loaded when one of
them runs (`crosnode.commands.later`).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from crosnode.commands.later import act_of

if TYPE_CHECKING:
    import argparse

COMMANDS: Final = "crosnode.commands.message_types"
EPILOG: Final = "Exit codes: 0 done, 1 a type or a message is wrong, 2 wrong usage."


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add ``ros`` and its commands; each sets ``func``, which gives the exit status."""
    text = "ROS 1 message, service and action types"
    ros = subparsers.add_parser("ros", help=text, description=f"{text}.", epilog=EPILOG)
    commands = ros.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add(commands, "show", "print constants and fields", type=_ONE)
    _add(commands, "md5", "print lines of type and md5sum", types=_MANY)
    _add(commands, "encode", "print a message as hexadecimal", type=_ONE, json=_JSON)
    _add(commands, "decode", "print a message as JSON", type=_ONE, hex=_HEX)


_EXAMPLES = {
    "show": (("plcsim ros show sensor_msgs/JointState", ""),),
    "md5": (("plcsim ros md5 std_msgs/String std_srvs/Trigger", ""),),
    "encode": (('plcsim ros encode std_msgs/String \'{"data": "hello"}\'', ""),),
    "decode": (("plcsim ros decode std_msgs/String '05000000 68656c6c6f'", ""),),
}
_ONE = {
    "metavar": "TYPE",
    "help": "pkg/Name; for half of a service pkg/NameRequest or pkg/NameResponse",
}
_MANY = _ONE | {"nargs": "+", "help": "message, service or action types, pkg/Name"}
_JSON = {"metavar": "JSON", "help": "an object of fields, others get defaults; '-' reads stdin"}
_HEX = {
    "metavar": "HEX",
    "help": "hexadecimal digits, in quotes where blanks stand between; '-' reads stdin",
}


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    text: str,
    **arguments: dict[str, Any],
) -> None:
    parser = commands.add_parser(
        name,
        help=text,
        description=f"{text[0].upper()}{text[1:]}.",
        examples=_EXAMPLES[name],
        epilog=EPILOG,
    )
    parser.add_argument(
        "--path",
        metavar="DIR",
        type=Path,
        action="append",
        default=[],
        help="folder of packages searched first; repeat for more",
    )
    for argument, options in arguments.items():
        parser.add_argument(argument, **options)
    parser.set_defaults(func=act_of(COMMANDS, name))
