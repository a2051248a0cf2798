"""``plcsim types from-ros`` and ``to-ros``: the arguments; `crosnode.commands.structs` acts."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Final

from crosnode.commands.later import act_of

ACTS: Final = "crosnode.commands.structs"
EPILOG: Final = "Exit codes: 0 done, 1 errors were found, 2 wrong usage."


def register(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add both to the commands of ``plcsim types``."""
    _add_from_ros(commands)
    _add_to_ros(commands)


def _add_from_ros(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "from-ros",
        help="write the STRUCTs of ROS messages, services and actions",
        description="Write the STRUCTs of ROS messages, services and actions.",
        examples=(("plcsim types from-ros sensor_msgs/JointState --array 6", ""),),
        epilog=EPILOG,
    )
    parser.add_argument(
        "types", nargs="+", metavar="PKG/TYPE", help="such as sensor_msgs/JointState"
    )
    parser.add_argument(
        "--path",
        type=Path,
        action="append",
        default=[],
        help="folder with packages, before those of ROS_PACKAGE_PATH and the common ones",
    )
    parser.add_argument("--array", type=_count, default=16, help="elements of T[]; default: 16")
    parser.add_argument("--string", type=_count, default=80, help="characters; default: 80")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FOLDER",
        help="write PKG_TYPE.typ and .var of each STRUCT there; what is there stays",
    )
    parser.set_defaults(func=act_of(ACTS, "from_ros"))


def _add_to_ros(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "to-ros",
        help="write the ROS messages of a STRUCT",
        description="Write the ROS messages of a STRUCT.",
        examples=(("plcsim types to-ros Robot my_project", ""),),
        epilog=EPILOG,
    )
    parser.add_argument("type", metavar="TYPE", help="name of the STRUCT")
    parser.add_argument(
        "paths",
        nargs="*",
        type=Path,
        default=[Path()],
        metavar="PATH",
        help="file, or folder with all below it; default: this folder",
    )
    parser.add_argument(
        "--package", default="plc", help="package of STRUCTs not named pkg_Type; default: plc"
    )
    parser.set_defaults(func=act_of(ACTS, "to_ros"))


def _count(text: str) -> int:
    """Return a number from 1 to 65535."""
    if not text.isdecimal() or not 1 <= int(text[:9]) <= 0xFFFF:
        raise argparse.ArgumentTypeError(f"{text[:20]!r} is no number from 1 to 65535")
    return int(text)
