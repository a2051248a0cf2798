import argparse

import pytest

from plcsim.cli import types
from plcsim.cli.parser import CommandParser
from plcsim.cli.type_commands import COMMANDS


@pytest.fixture
def parser() -> argparse.ArgumentParser:
    made = CommandParser(prog="plcsim")
    types.register(made.add_subparsers(required=True))
    return made


ARGUMENTS = {
    "check": ["check", "folder"],
    "layout": ["layout", "TON"],
    "header": ["header"],
    "python": ["python"],
    "print": ["print"],
    "library": ["library"],
}


def test_every_command_has_arguments_and_an_act(parser: argparse.ArgumentParser) -> None:
    assert set(ARGUMENTS) == set(COMMANDS)
    for name, arguments in ARGUMENTS.items():
        assert parser.parse_args(["types", *arguments]).act == name


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["check"],
        ["layout"],
    ],
)
def test_wrong_usage(
    parser: argparse.ArgumentParser, arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        parser.parse_args(["types", *arguments])
    assert caught.value.code == 2
    assert "usage: plcsim types" in capsys.readouterr().err
