"""``plcsim st format``."""

import pytest

from plcsim.cli import st
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError

TEXT = b"PROGRAM p\r\nx:=1; (* \xfc *)\r\nEND_PROGRAM\r\n"
FORMATTED = b"PROGRAM p\r\n\tx := 1; (* \xfc *)\r\nEND_PROGRAM\r\n"


@pytest.fixture
def run(capsys):
    def run(*arguments):
        parser = CommandParser()
        st.register(parser.add_subparsers(required=True))
        options = parser.parse_args(["st", "format", *map(str, arguments)])
        return options.func(options), capsys.readouterr().out

    return run


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "p.st"
    file.write_bytes(TEXT)
    return file


def test_files_are_formatted_once_with_their_encoding_and_line_ends(run, file):
    assert run(file) == (0, f"{file}: formatted\n1 file: 1 formatted, 0 left\n")
    assert file.read_bytes() == FORMATTED
    assert run(file) == (0, "1 file: 0 formatted, 0 left\n")


def test_check_changes_nothing(run, file):
    code, out = run("--check", file)
    assert (code, out) == (1, f"{file}: is not formatted\n1 file: 1 to format, 0 left\n")
    assert file.read_bytes() == TEXT
    run(file)
    assert run("--check", file)[0] == 0


def test_blanks_instead_of_a_tab(run, file):
    run("--indent", 4, file)
    assert file.read_bytes() == FORMATTED.replace(b"\t", b"    ")


@pytest.mark.parametrize(
    ("text", "told"),
    [(b"PROGRAM p x := ; END_PROGRAM", "error ST1001"), (b"#define X 1\n", "left as it is")],
)
def test_what_cannot_be_formatted_is_left_and_told(run, file, text, told):
    file.write_bytes(text)
    code, out = run(file)
    assert code == 1
    assert told in out
    assert file.read_bytes() == text


def test_a_folder_without_files_is_an_error(run, tmp_path):
    with pytest.raises(PlcError, match=r"no \.st file"):
        run(tmp_path)
