"""Files of TwinCAT: Structured Text in XML."""

import pytest

from plcsim.cli.st_check import check_files
from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.program.structured_text.sources import read_files
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from plcsim.program.structured_text.syntax.twincat import text_of
from plcsim.project.assembly import assemble
from plcsim.project.structured_text_file import load_file
from st_types.syntax.source import Source

from ..cases import FOLDER

PROJECT = FOLDER / "twincat"
DRAWN = (
    '<?xml version="1.0"?><TcPlcObject><POU Name="P"><Declaration><![CDATA[PROGRAM P VAR a : INT; '
    "END_VAR]]></Declaration><Implementation><CFC></CFC></Implementation></POU></TcPlcObject>"
)
FILES = sorted(file for file in PROJECT.rglob("*.Tc*"))


def test_a_project_runs_with_all_its_files() -> None:
    application = load_file(PROJECT / "POUs" / "MAIN.TcPOU")
    controller = assemble(application, clock=VirtualClock(), network=None)
    controller.boot()
    controller.run(cycles=3)
    names = ("MAIN.nSeen", "MAIN.bOver", "bStart")
    assert [controller.tags.read(controller.tags.find(name)) for name in names] == [33, True, True]


def test_the_units_of_a_project_see_each_other_whatever_their_folders() -> None:
    files = [file.parsed for file in read_files(FILES)]
    assert check_files([PROJECT], files) == []
    assert [record for file in files for record in file.diagnostics.records] == []


def test_lines_and_columns_are_those_of_the_file() -> None:
    xml = (PROJECT / "POUs" / "MAIN.TcPOU").read_text("utf-8")
    text = text_of(xml)
    for line, (there, here) in enumerate(zip(xml.splitlines(), text.splitlines(), strict=True)):
        if "nSeen" in there:
            assert here.index("nSeen") == there.index("nSeen"), line
    wrong = parse_structured_text(Source("MAIN.TcPOU", xml.replace("iDrive := fbMotor;", "a b;")))
    (record,) = wrong.diagnostics.records
    assert (record.line, record.column) == (14, 3)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('<?xml version="1.0"?><project xmlns="plcopen"/>', "1:1: error ST1001: the file is XML"),
        (
            DRAWN,
            "no variable is called CFC_is_drawn_and_not_Structured_Text",
        ),
    ],
)
def test_what_is_no_structured_text_is_told(tmp_path, text: str, told: str) -> None:
    file = tmp_path / "P.TcPOU"
    file.write_text(text, "utf-8")
    with pytest.raises(ConfigurationError) as raised:
        load_file(file)
    assert told in str(raised.value)
