"""The declaration of ``plcsim master``."""

import argparse

import pytest

from crosnode.commands.master import DEFAULT_PORT, register
from plcsim.cli.parser import CommandParser


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser()
    register(parser.add_subparsers())
    return parser.parse_args(["master", *arguments])


def test_arguments() -> None:
    options = parse()
    assert (options.port, options.for_ns) == (DEFAULT_PORT, None)
    options = parse("-p", "65535", "--for", "1.5s", "--host", "plc", "--bind", "127.0.0.1")
    assert (options.port, options.for_ns) == (65535, 1_500_000_000)
    assert (options.host, options.bind) == ("plc", "127.0.0.1")


@pytest.mark.parametrize("port", ["0", "65536", "-1", "x", "1" * 5000])
def test_a_wrong_port_is_wrong_usage(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(f"--port={port}")
    assert "is no port from 1 to 65535" in capsys.readouterr().err


@pytest.mark.parametrize("time", ["-1", "10", "nan", "inf", "1e12"])
def test_a_wrong_time_is_wrong_usage(time: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(f"--for={time}")
    assert f"'{time}' is not a duration such as" in capsys.readouterr().err
