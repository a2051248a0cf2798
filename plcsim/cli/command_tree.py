"""The commands of ``plcsim`` as data, read from the parser: for completion and for the docs."""

from __future__ import annotations

import argparse
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator


class ArgumentKind(Enum):
    """What a person types for an argument."""

    NOTHING = "nothing: an option without a value"
    TEXT = "a text that nobody can guess"
    CHOICE = "one of several words"
    FILE = "a path"
    FOLDER = "a folder"


class CommandArgument(NamedTuple):
    """An option or an argument of a command.

    Attributes:
        flags: such as "-o" and "--output"; empty for an argument that stands by itself.
        text: its help.
        kind: what is typed for it.
        metavar: how it is called.
        choices: the words of `ArgumentKind.CHOICE`.
    """

    flags: tuple[str, ...]
    text: str
    kind: ArgumentKind
    metavar: str
    choices: tuple[str, ...] = ()


class Command(NamedTuple):
    """A command.

    Attributes:
        path: its name, after those of the commands above it; empty for ``plcsim`` itself.
        text: its help, in one line.
        parser: of it.
        arguments: its options and arguments.
        commands: those below it.
    """

    path: tuple[str, ...]
    text: str
    parser: argparse.ArgumentParser
    arguments: tuple[CommandArgument, ...]
    commands: tuple[Command, ...]

    def walk(self) -> Iterator[Command]:
        """Iterate over the command and all below it."""
        yield self
        for command in self.commands:
            yield from command.walk()


def command_tree(
    parser: argparse.ArgumentParser, path: tuple[str, ...] = (), text: str = ""
) -> Command:
    """Return a parser as a command."""
    arguments, commands = [], []
    for action in parser._actions:  # argparse has no other way to ask for them
        if isinstance(action, argparse._SubParsersAction):
            helps = {choice.dest: choice.help or "" for choice in action._choices_actions}
            commands = [
                command_tree(inner, (*path, name), helps.get(name, ""))
                for name, inner in action._name_parser_map.items()
            ]
        elif action.help is not argparse.SUPPRESS:
            arguments.append(_argument(parser, action))
    return Command(path, text, parser, tuple(arguments), tuple(commands))


def _argument(parser: argparse.ArgumentParser, action: argparse.Action) -> CommandArgument:
    name = str(action.metavar or action.dest)
    choices = tuple(map(str, action.choices or ()))
    text = parser._get_formatter()._expand_help(action) if action.help else ""
    return CommandArgument(tuple(action.option_strings), text, _kind(action, name), name, choices)


def _kind(action: argparse.Action, name: str) -> ArgumentKind:
    if action.nargs == 0:
        return ArgumentKind.NOTHING
    if action.choices is not None:
        return ArgumentKind.CHOICE
    if name in {"PROJECT", "DIR"}:
        return ArgumentKind.FOLDER
    return ArgumentKind.FILE if action.type is Path else ArgumentKind.TEXT
