"""Files that commands write."""

import pytest

from plcsim.cli.output_file import check_output, write_output
from plcsim.core.errors import ConfigurationError


def test_a_file_that_can_be_written(tmp_path):
    file = tmp_path / "r.json"
    check_output("--report", None)
    check_output("--report", file)
    write_output("--report", file, "1\n")
    check_output("--report", file)
    assert file.read_text() == "1\n"


@pytest.mark.parametrize(
    ("file", "error"),
    [
        ("", "cannot be written"),
        ("none/r", "there is no folder"),
        ("notes/r", "there is no folder"),
    ],
)
def test_what_is_found_before(tmp_path, file, error):
    (tmp_path / "notes").touch()
    with pytest.raises(ConfigurationError, match=rf"--report {tmp_path / file}: {error}"):
        check_output("--report", tmp_path / file)


def test_what_is_found_only_when_writing(tmp_path):
    with pytest.raises(ConfigurationError, match=f"-o {tmp_path}: Is a directory"):
        write_output("-o", tmp_path, "")
