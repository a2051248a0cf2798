"""The commands as data."""

import argparse
from pathlib import Path

import pytest

from plcsim.cli.command_tree import ArgumentKind, CommandArgument, command_tree
from plcsim.cli.parser import CommandParser


@pytest.fixture
def root():
    parser = CommandParser(prog="tool", add_help=False)
    commands = parser.add_subparsers()
    build = commands.add_parser("build", help="build it", add_help=False)
    build.add_argument("-o", "--output", type=Path, metavar="FILE", help="by default %(default)s")
    build.add_argument("--fast", action="store_true", help="100 %% faster")
    build.add_argument("--level", choices=[1, 2])
    build.add_argument("--name", metavar="NAME")
    build.add_argument("--secret", help=argparse.SUPPRESS)
    build.add_argument("project", nargs="?", metavar="PROJECT")
    inner = commands.add_parser("show", add_help=False).add_subparsers()
    inner.add_parser("all", help="show all", add_help=False)
    return command_tree(parser)


def test_commands_are_found_at_every_depth(root):
    assert [command.path for command in root.walk()] == [
        (),
        ("build",),
        ("show",),
        ("show", "all"),
    ]
    assert [command.text for command in root.walk()] == ["", "build it", "", "show all"]


def test_arguments_say_what_is_typed_for_them(root):
    build = root.commands[0]
    assert build.arguments == (
        CommandArgument(("-o", "--output"), "by default None", ArgumentKind.FILE, "FILE"),
        CommandArgument(("--fast",), "100 % faster", ArgumentKind.NOTHING, "fast"),
        CommandArgument(("--level",), "", ArgumentKind.CHOICE, "level", ("1", "2")),
        CommandArgument(("--name",), "", ArgumentKind.TEXT, "NAME"),
        CommandArgument((), "", ArgumentKind.FOLDER, "PROJECT"),
    )
