"""The arguments of ``plcsim types from-ros`` and ``to-ros``, and their entry point."""

import argparse
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

from crosnode.commands.struct_types import register
from plcsim.cli.installed import TYPE_COMMANDS
from plcsim.cli.parser import CommandParser

TOP = Path(__file__).parents[4]


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser(prog="plcsim types")
    register(parser.add_subparsers(required=True))
    return parser.parse_args(arguments)


def test_arguments() -> None:
    options = parse("from-ros", "p/A", "p/B", "--path", "x", "-o", "y")
    assert (options.types, options.path, options.output) == (["p/A", "p/B"], [Path("x")], Path("y"))
    assert (options.array, options.string) == (16, 80)
    options = parse("to-ros", "A")
    assert (options.type, options.paths, options.package) == ("A", [Path()], "plc")


@pytest.mark.parametrize(
    "arguments",
    [
        ["from-ros"],
        ["from-ros", "p/A", "--array", "0"],
        ["from-ros", "p/A", "--string", "x"],
        ["from-ros", "p/A", "--string", "99999"],
        ["to-ros"],
    ],
)
def test_wrong_usage(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        parse(*arguments)
    assert caught.value.code == 2
    assert "usage: plcsim types" in capsys.readouterr().err


def test_the_entry_point_leads_here() -> None:
    project = tomllib.loads((TOP / "pyproject.toml").read_text("utf-8"))["project"]
    module, _, name = project["entry-points"][TYPE_COMMANDS]["ros"].partition(":")
    assert getattr(import_module(module), name) is register
