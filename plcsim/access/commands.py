"""``plcsim users``: who may look, operate and engineer over the pages and OPC UA."""

from __future__ import annotations

import getpass
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from plcsim.access.role import Role
from plcsim.access.users import Users, UsersError, users_file
from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import epilog
from plcsim.cli.project_argument import HELP, own_project
from plcsim.project.project_file import find_project

if TYPE_CHECKING:
    import argparse

_EPILOG = epilog(DONE="", FAILED="there is no such project or user, or the file is damaged")
_ROLES = "look sees everything; operate writes, stops and starts; engineer may do all, force too"


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the commands."""
    parser = subparsers.add_parser(
        "users",
        help="who may do what over the web page and OPC UA",
        description="Users of a project with roles and passwords, and tokens for scripts. The web "
        "page and OPC UA ask for them; without any, only this machine is let in.",
        examples=(
            ("plcsim users list my_plc", "users and tokens"),
            ("plcsim users add anna --role engineer", "asks for a password"),
        ),
        epilog=_EPILOG,
    )
    acts = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _register_add(acts)
    _register_token(acts)
    remove = acts.add_parser(
        "remove",
        help="remove a user or a token",
        description="Remove a user or a token; who is logged in is logged out.",
        examples=(("plcsim users remove anna", "at once"),),
        epilog=_EPILOG,
    )
    _add_arguments(remove)
    remove.set_defaults(func=remove_user)
    shown = acts.add_parser(
        "list",
        help="list users and tokens",
        description="List users and tokens with their roles.",
        examples=(("plcsim users list my_plc", "all of a project"),),
        epilog=_EPILOG,
    )
    shown.add_argument("project", nargs="?", type=Path, default=None, metavar="PROJECT", help=HELP)
    shown.set_defaults(func=list_users)


def _register_add(acts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = acts.add_parser(
        "add",
        help="add a user, or change role and password of one",
        description="Add a user, or change role and password of one. The password is asked for, "
        "or read from stdin where that is no terminal.",
        examples=(
            ("plcsim users add anna --role engineer", "asks for a password"),
            ("plcsim users add panel --project my_plc", "looks only"),
        ),
        epilog=_EPILOG,
    )
    _add_arguments(parser)
    _add_role(parser)
    parser.set_defaults(func=add_user)


def _register_token(acts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = acts.add_parser(
        "token",
        help="make a token for a script",
        description="Make a token for a script and print it; it cannot be shown again. The script "
        "sends it as 'Authorization: Bearer TOKEN'.",
        examples=(("plcsim users token nightly --role look", "prints the token"),),
        epilog=_EPILOG,
    )
    _add_arguments(parser)
    _add_role(parser)
    parser.set_defaults(func=add_token)


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="of the user or of the token")
    parser.add_argument("--project", type=Path, default=None, metavar="PROJECT", help=HELP)


def _add_role(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--role", choices=[role.value for role in Role], default=Role.LOOK.value, help=_ROLES
    )


def _users(options: argparse.Namespace) -> Users:
    project = own_project() if options.project is None else options.project
    return Users(users_file(find_project(project).parent))


def add_user(options: argparse.Namespace) -> int:
    """Add a user."""
    users = _users(options)
    users.add(options.name, Role(options.role), _password())
    print(f"{options.name}: {options.role}, in {users.file}")
    return 0


def add_token(options: argparse.Namespace) -> int:
    """Make a token and print it."""
    token = _users(options).add_token(options.name, Role(options.role))
    print(token)
    print(f"{options.name}: {options.role}; this is shown once", file=sys.stderr)
    return 0


def remove_user(options: argparse.Namespace) -> int:
    """Remove a user or a token."""
    _users(options).remove(options.name)
    print(f"{options.name} is removed")
    return 0


def list_users(options: argparse.Namespace) -> int:
    """List users and tokens."""
    found = _users(options).all()
    if not found:
        print("no users: only this machine is let in, as engineer")
        return 0
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("name", "role", "kind"):
        table.add_column(title)
    for kind, user in found:
        table.add_row(user.name, user.role.value, kind)
    CommandConsole().print(table)
    return 0


def _password() -> str:
    if not sys.stdin.isatty():
        return sys.stdin.readline().rstrip("\n")
    first = getpass.getpass("password: ")
    if getpass.getpass("once more: ") != first:
        raise UsersError("the two passwords differ")
    return first
