import pytest

from plcsim.core.errors import PlcError
from plcsim.web.service.sources import Sources

PROGRAM = """from plcsim import Program

class Main(Program):
    def cyclic(self):
        self.level = self.axes[2].speed + self.small  # p.count in a comment
        print("self.exact", self.nothing, self.axes)
"""


@pytest.fixture
def sources(world, tmp_path):
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "main.py").write_text(PROGRAM)
    (tmp_path / "p" / "notes.txt").write_text("not shown")
    (tmp_path / "plc.toml").write_text('[task_class.1]\ncycle = "1ms"\nprograms = ["p"]\n')
    return Sources(tmp_path, world.hub.image.directory)


def test_programs_have_their_files(sources):
    assert sources.programs() == [{"name": "p", "files": ["p/main.py"]}]


def test_variables_are_found_on_their_lines(sources):
    lines = sources.read("p", "p/main.py")["lines"]
    assert [text for text, _ in lines] == PROGRAM.splitlines()
    assert lines[4][1] == [
        ["level", "p.level"],
        ["axes[2].speed", "p.axes[2].speed"],
        ["small", "p.small"],
    ]
    assert lines[5][1] == []  # a string, what is not there, and what has parts


@pytest.mark.parametrize(
    ("program", "file"),
    [
        ("p", "../plc.toml"),
        ("p", "p/notes.txt"),
        ("q", "p/main.py"),
        ("p", "/etc/passwd"),
        ("", ""),
    ],
)
def test_no_other_file_is_shown(sources, program, file):
    with pytest.raises(PlcError, match="there is no file"):
        sources.read(program, file)


def test_a_file_that_has_gone_or_is_too_long_is_told(sources, tmp_path):
    sources.programs()
    (tmp_path / "p" / "main.py").write_bytes(b"#" * ((1 << 20) + 1))
    with pytest.raises(PlcError, match="more than"):
        sources.read("p", "p/main.py")
    (tmp_path / "p" / "main.py").unlink()
    with pytest.raises(PlcError, match="No such file"):
        sources.read("p", "p/main.py")
