"""What was compiled once is not compiled again, unless something that it sees has changed."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.structured_text import code, sources

FILES = {
    "Global.var": "VAR gCount : UDINT; gOther : UDINT; END_VAR\n",
    "main/Variables.var": "VAR x : INT := 3; END_VAR\n",
    "main/Cyclic.st": "PROGRAM _CYCLIC\ngOther := gOther + 1;\nX := x;\nEND_PROGRAM\n",
}
STANDARD = {
    "main/main.st": "PROGRAM Main VAR n : UINT; END_VAR n := n + 1; END_PROGRAM\n",
}


@pytest.fixture
def compiled(monkeypatch, tmp_path):
    """The names of the programs that are checked and compiled, in a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    names = []
    whole = code._compiled

    def noted(name, *arguments):
        names.append(name)
        return whole(name, *arguments)

    monkeypatch.setattr(code, "_compiled", noted)
    return names


@pytest.mark.parametrize(("files", "tag"), [(FILES, "gOther"), (STANDARD, "main.n")])
def test_unchanged_programs_are_compiled_once(run, value, compiled, files, tag):
    for _ in range(3):
        assert value(run(files), tag) == 3
    assert compiled == ["main"]


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("Global.var", "gCount : UDINT; ", ""),
        ("main/Variables.var", "3", "4"),
        ("main/Cyclic.st", "+ 1", "+ 2"),
    ],
)
def test_a_change_of_anything_that_it_sees_compiles_it_again(run, value, compiled, name, old, new):
    run(FILES)
    changed = FILES | {name: FILES[name].replace(old, new)}
    assert value(run(changed), "gOther") == (6 if "st" in name else 3)
    assert compiled == ["main", "main"]


def test_warnings_are_told_each_time(project, compiled):
    from plcsim.project.assembly import load
    from plcsim.project.plc_toml import read_project

    folder = project(FILES | {"plc.toml": '[task_class.1]\nprograms = ["main"]\n'})
    told = [list(load(read_project(folder)).warnings) for _ in range(2)]
    assert told[0] == told[1]
    assert "ST5001" in told[0][0]
    assert compiled == ["main"]


def test_what_is_damaged_is_compiled_again(run, value, compiled, tmp_path):
    run(FILES)
    for file in (tmp_path / "cache" / "plcsim" / "st").iterdir():
        file.write_bytes(b"nonsense")
    assert value(run(FILES), "gOther") == 3
    assert compiled == ["main", "main"]


LIBRARY = {
    "util/util.fun": "FUNCTION Doubled : DINT VAR_INPUT n : DINT; END_VAR END_FUNCTION\n",
    "util/util.st": "FUNCTION Doubled\nDoubled := n * FACTOR;\nEND_FUNCTION\n",
    "util/util.var": "VAR CONSTANT FACTOR : DINT := 2; END_VAR\n",
    "main/Variables.var": "VAR x : DINT := 3; END_VAR\n",
    "main/Cyclic.st": "PROGRAM _CYCLIC\nx := Doubled(x);\nEND_PROGRAM\n",
}


@pytest.fixture
def parsed(monkeypatch, tmp_path):
    """The names of the files with units that are parsed, with a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    names = []
    whole = sources.parse_units

    def noted(source):
        names.append(source.path.rpartition("/")[2])
        return whole(source)

    monkeypatch.setattr(sources, "parse_units", noted)
    return names


def test_unchanged_libraries_are_compiled_once(run, value, parsed):
    for _ in range(3):
        assert value(run(LIBRARY), "main.x") == 24
    assert sorted(parsed) == ["Cyclic.st", "util.st"]


@pytest.mark.parametrize(
    ("name", "old", "new", "expected"),
    [
        ("util/util.st", "*", "+", 9),
        ("util/util.var", "2", "3", 81),
        ("util/util.fun", "Doubled : DINT", "Doubled : INT", 24),
    ],
)
def test_a_change_of_a_library_compiles_it_again(run, value, parsed, name, old, new, expected):
    run(LIBRARY)
    changed = LIBRARY | {name: LIBRARY[name].replace(old, new)}
    assert value(run(changed), "main.x") == expected
    assert parsed.count("util.st") == 2


def test_errors_in_a_library_are_told_each_time(run, parsed):
    wrong = LIBRARY | {"util/util.st": "FUNCTION Doubled\nDoubled := m;\nEND_FUNCTION\n"}
    for _ in range(2):
        with pytest.raises(ConfigurationError, match=r"util\.st:2:12: .*m"):
            run(wrong)
    assert parsed.count("util.st") == 2
