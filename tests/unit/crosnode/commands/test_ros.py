"""The declaration of ``plcsim ros``."""

import argparse
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from crosnode.commands.ros import register
from plcsim.cli.parser import CommandParser


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser()
    register(parser.add_subparsers())
    return parser.parse_args(["ros", *arguments])


def test_arguments() -> None:
    namespace = parse("md5", "--path", "a", "--path", "b", "x/Y", "z/W")
    assert namespace.path == [Path("a"), Path("b")]
    assert namespace.types == ["x/Y", "z/W"]
    assert parse("md5", "x/Y", "--path", "a").path == [Path("a")]
    assert parse("show", "x/Y").path == []
    assert parse("encode", "x/Y", "{}").json == "{}"
    assert parse("decode", "x/Y", "00").hex == "00"


def test_arguments_of_a_network() -> None:
    options = parse("topic", "echo", "/x", "-n", "3", "--master", "http://a:1", "--path", "p")
    assert (options.topic, options.count) == ("/x", 3)
    assert (options.master, options.path) == ("http://a:1", [Path("p")])
    assert parse("topic", "hz", "/x", "--for", "2s").for_ns == 2_000_000_000
    options = parse("topic", "pub", "/x", "std_msgs/Int8", "7", "-r", "0.5")
    assert (options.type, options.value, options.rate, options.once) == (
        "std_msgs/Int8", "7", 0.5, False,
    )  # fmt: skip
    assert parse("topic", "pub", "/x", "std_msgs/Empty", "-1").value == "{}"
    assert parse("service", "call", "/x", "{}").service == "/x"
    assert parse("param", "set", "/x", "-1").value == "-1"
    assert parse("node", "info", "/x").node == "/x"


def test_every_command_has_an_act() -> None:
    groups = {"topic": "list info echo hz pub", "node": "list info", "service": "list call"}
    groups |= {"param": "list get set delete"}
    values = {"pub": ["/x", "a/B"], "set": ["x", "1"]}
    for group, names in groups.items():
        for name in names.split():
            arguments = [] if name == "list" else values.get(name, ["/x"])
            act = parse(group, name, *arguments).func
            module, function = (cell.cell_contents for cell in act.__closure__)
            assert callable(getattr(import_module(module), function))


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["md5"],
        ["show"],
        ["encode", "x/Y"],
        ["nonsense"],
        ["topic"],
        ["topic", "echo"],
        ["topic", "echo", "/x", "-n", "0"],
        ["topic", "hz", "/x", "--for", "3"],
        ["topic", "pub", "/x", "a/B", "-r", "0"],
        ["param", "set", "/x"],
    ],
)
def test_wrong_usage(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(*arguments)
    assert "usage:" in capsys.readouterr().err


def test_declaring_loads_nothing_heavy() -> None:
    """Every command of plcsim declares these."""
    code = "import sys, crosnode.commands.ros\nsys.exit('numpy' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[4])
