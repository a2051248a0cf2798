"""``plcsim retain``."""

import json

import pytest

from plcsim.cli.console import print_error
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError
from plcsim.retain.commands import register
from plcsim.retain.generations import Generations
from plcsim.retain.service import Keeper


def main(words):
    """Run a command as `plcsim` does, but with the commands of this house only."""
    parser = CommandParser(prog="plcsim")
    register(parser.add_subparsers())
    options = parser.parse_args(words)
    try:
        return options.func(options)
    except PlcError as err:
        print_error(err)
        return 1


@pytest.fixture
def ran(site):
    controller, service = site.start()
    controller.run(cycles=3)
    service.is_stopping = True
    Keeper(service).run()
    return site


def test_show_prints_what_is_kept(ran, capsys):
    assert main(["retain", "show", str(ran.folder)]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert rows == [
        ["variable", "type", "value"],
        ["gTotal", "UDINT", "6"],
        ["gName", "STRING[8]", "one"],
        ["press.parts", "UDINT", "8"],
        ["generation", "1,", "17", "bytes"],
    ]
    assert main(["retain", "show", "--file", str(ran.retain / "retained.1")]) == 0


def test_export_and_import(ran, tmp_path, capsys):
    file = tmp_path / "values.json"
    assert main(["retain", "export", str(ran.folder), "-o", str(file)]) == 0
    values = json.loads(file.read_text())
    assert values == {"gTotal": 6, "gName": "one", "press.parts": 8}
    file.write_text(json.dumps({"gTotal": 70, "gName": "zwei"}))
    assert main(["retain", "import", str(file), str(ran.folder)]) == 0
    assert main(["retain", "export", str(ran.folder)]) == 0
    assert json.loads(capsys.readouterr().out.partition("\n")[2]) == {
        "gTotal": 70,
        "gName": "zwei",
        "press.parts": 8,
    }


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('{"nonsense": 1}', "nonsense: there is no such retained variable"),
        ('{"gTotal": "x"}', "tag gTotal: 'x' is not a UDINT"),
        ("[1]", "an object of names and values was expected"),
        ("{", "Expecting property name"),
    ],
)
def test_what_is_wrong_is_not_imported(ran, tmp_path, capsys, text, told):
    file = tmp_path / "values.json"
    file.write_text(text)
    assert main(["retain", "import", str(file), str(ran.folder)]) == 1
    assert told in capsys.readouterr().err
    assert Generations(ran.retain).latest()[0].data[:4] == b"\6\0\0\0"


def test_clear_waits_for_nobody(ran, capsys):
    with Generations(ran.retain).locked():
        assert main(["retain", "clear", str(ran.folder)]) == 1
    assert "another run keeps its variables here" in capsys.readouterr().err
    assert main(["retain", "clear", str(ran.folder)]) == 0
    assert main(["retain", "show", str(ran.folder)]) == 1
    assert "nothing is kept yet" in capsys.readouterr().err


def test_without_the_table_it_says_so(site, capsys):
    site.write(toml='[task_class.1]\ncycle = "10ms"\nprograms = ["press"]\n')
    assert main(["retain", "show", str(site.folder)]) == 1
    assert "has no table [retain]" in capsys.readouterr().err
