"""``plcsim ros``: what is in a ROS 1 network, and ROS 1 types, without ROS on the machine.

This module only declares the commands: numpy, which they need, is loaded when one of them runs
(`crosnode.commands.later`).
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Final, NamedTuple

from crosnode.commands.later import act_of
from plcsim.core.duration import parse_duration_ns

EPILOG: Final = "Exit codes: 0 done, 1 a type, a message or the network is wrong, 2 wrong usage."

_PATH: Final[dict[str, dict[str, Any]]] = {
    "--path": {
        "metavar": "DIR",
        "type": Path,
        "action": "append",
        "default": [],
        "help": "folder of packages searched first; repeat for more",
    }
}
_MASTER: Final[dict[str, dict[str, Any]]] = {
    "--master": {
        "metavar": "URI",
        "default": "",
        "help": "of the master; ROS_MASTER_URI, http://localhost:11311/",
    }
}
_NETWORK: Final = _MASTER | _PATH
_TYPE: Final[dict[str, Any]] = {
    "metavar": "TYPE",
    "help": "pkg/Name; for half of a service pkg/NameRequest or pkg/NameResponse",
}
_VALUE: Final[dict[str, Any]] = {
    "metavar": "VALUE",
    "nargs": "?",
    "default": "{}",
    "help": "fields in braces, as {a: 1, b: [x, y]} or JSON, others get defaults; or the value of "
    "the only field",
}
_TOPIC: Final[dict[str, Any]] = {"metavar": "TOPIC", "help": "its name, such as /chatter"}


class _Command(NamedTuple):
    """One command.

    Attributes:
        name: as typed.
        text: what it does.
        act: "module:function" of this package.
        arguments: of argparse.
        example: a line to type, behind ``plcsim ros``.
    """

    name: str
    text: str
    act: str
    arguments: dict[str, dict[str, Any]]
    example: str


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add ``ros`` and its commands; each sets ``func``, which gives the exit status."""
    text = "topics, nodes, services, parameters and types of ROS 1, without ROS on the machine"
    ros = subparsers.add_parser(
        "ros", help=text, description=f"{text[0].upper()}{text[1:]}.", epilog=EPILOG
    )
    commands = ros.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (about, group) in _GROUPS.items():
        parser = commands.add_parser(
            name, help=about, description=f"{about[0].upper()}{about[1:]}.", epilog=EPILOG
        )
        inner = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
        for command in group:
            _add(inner, command, f"{name} ")
    for command in _TYPES:
        _add(commands, command)


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    command: _Command,
    prefix: str = "",
) -> None:
    parser = commands.add_parser(
        command.name,
        help=command.text,
        description=f"{command.text[0].upper()}{command.text[1:]}.",
        examples=((f"plcsim ros {prefix}{command.example}", ""),),
        epilog=EPILOG,
    )
    for argument, options in command.arguments.items():
        parser.add_argument(argument, **options)
    module, _, function = command.act.partition(":")
    parser.set_defaults(func=act_of(f"crosnode.commands.{module}", function))


def _duration(text: str) -> int:
    try:
        return parse_duration_ns(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _count(text: str) -> int:
    if not text.isdecimal() or not int(text[:9]):
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no number above 0")
    return int(text[:9])


def _rate(text: str) -> float:
    try:
        rate = float(text)
    except ValueError:
        rate = 0
    if not 0.001 <= rate <= 1000:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no rate from 0.001 to 1000")
    return rate


_ECHO: Final[dict[str, dict[str, Any]]] = {
    "-n": {"dest": "count", "type": _count, "metavar": "COUNT", "help": "end after so many"}
}
_HZ: Final[dict[str, dict[str, Any]]] = {
    "--for": {"dest": "for_ns", "type": _duration, "metavar": "TIME", "help": "end after TIME"}
}
_PUB: Final[dict[str, dict[str, Any]]] = {
    "-r": {"dest": "rate", "type": _rate, "metavar": "HZ", "help": "so many a second"},
    "-1": {"dest": "once", "action": "store_true", "help": "end 3 s after the message"},
}

_GROUPS: Final = {
    "topic": (
        "topics: what there is, what is said, how often, and saying it",
        (
            _Command("list", "print topics and types", "topics:topic_list", _NETWORK, "list"),
            _Command(
                "info",
                "print type, publishers and subscribers",
                "topics:topic_info",
                {"topic": _TOPIC} | _NETWORK,
                "info /chatter",
            ),
            _Command(
                "echo",
                "print messages, of any type that a publisher tells",
                "topics:topic_echo",
                {"topic": _TOPIC} | _ECHO | _NETWORK,
                "echo /chatter -n 1",
            ),
            _Command(
                "hz",
                "print how many messages come a second",
                "topics:topic_hz",
                {"topic": _TOPIC} | _HZ | _NETWORK,
                "hz /chatter --for 10s",
            ),
            _Command(
                "pub",
                "publish a message, latched, or so many a second",
                "topics:topic_pub",
                {"topic": _TOPIC, "type": _TYPE, "value": _VALUE} | _PUB | _NETWORK,
                "pub -1 /tank/setpoint std_msgs/Float32 3.5",
            ),
        ),
    ),
    "node": (
        "nodes: who is there and what they do",
        (
            _Command("list", "print nodes", "nodes:node_list", _NETWORK, "list"),
            _Command(
                "info",
                "print topics, services and connections of a node",
                "nodes:node_info",
                {"node": {"metavar": "NODE", "help": "its name, such as /talker_cros"}} | _NETWORK,
                "info /talker_cros",
            ),
        ),
    ),
    "service": (
        "services: what there is, and calling it",
        (
            _Command("list", "print services and nodes", "nodes:service_list", _NETWORK, "list"),
            _Command(
                "call",
                "call a service and print the response",
                "nodes:service_call",
                {
                    "service": {"metavar": "SERVICE", "help": "its name, such as /add_two_ints"},
                    "value": _VALUE,
                }
                | _NETWORK,
                'call /add_two_ints \'{"a": 3, "b": 4}\'',
            ),
        ),
    ),
    "param": (
        "parameters: reading, setting and deleting them",
        (
            _Command("list", "print names", "nodes:param_list", _NETWORK, "list"),
            _Command(
                "get",
                "print a parameter or all of a namespace as JSON",
                "nodes:param_get",
                {"name": {"metavar": "NAME", "help": "such as /run_id, or / for all"}} | _NETWORK,
                "get /run_id",
            ),
            _Command(
                "set",
                "set a parameter",
                "nodes:param_set",
                {
                    "name": {"metavar": "NAME", "help": "such as /speed"},
                    "value": {
                        "metavar": "VALUE",
                        "help": "number, true, false, [list], {a: 1}, or a text",
                    },
                }
                | _NETWORK,
                "set /speed 1.5",
            ),
            _Command(
                "delete",
                "delete a parameter or a namespace",
                "nodes:param_delete",
                {"name": {"metavar": "NAME", "help": "such as /speed"}} | _NETWORK,
                "delete /speed",
            ),
        ),
    ),
}

_JSON: Final = {
    "metavar": "JSON",
    "help": "an object of fields, others get defaults; '-' reads stdin",
}
_HEX: Final = {
    "metavar": "HEX",
    "help": "hexadecimal digits, in quotes where blanks stand between; '-' reads stdin",
}
_MANY: Final = _TYPE | {"nargs": "+", "help": "message, service or action types, pkg/Name"}

_TYPES: Final = (
    _Command(
        "show",
        "print constants and fields of a type",
        "message_types:show",
        {"type": _TYPE} | _PATH,
        "show sensor_msgs/JointState",
    ),
    _Command(
        "md5",
        "print lines of type and md5sum",
        "message_types:md5",
        {"types": _MANY} | _PATH,
        "md5 std_msgs/String std_srvs/Trigger",
    ),
    _Command(
        "encode",
        "print a message as hexadecimal",
        "message_types:encode",
        {"type": _TYPE, "json": _JSON} | _PATH,
        'encode std_msgs/String \'{"data": "hello"}\'',
    ),
    _Command(
        "decode",
        "print a message as JSON",
        "message_types:decode",
        {"type": _TYPE, "hex": _HEX} | _PATH,
        "decode std_msgs/String '05000000 68656c6c6f'",
    ),
)
