"""Which language a program is in, and what is told where there is none."""

import os
import time
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.host import helper_process as helper_module
from plcsim.program import loader as loader_module
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader
from plcsim.program.python.language import PYTHON

CLASS = """
    from plcsim import Program

    class Main(Program):
        pass
"""


@pytest.fixture
def load(project):
    """``load(files)``: the class of program ``main``, or of another source."""

    def load(files, source="main"):
        return ProgramLoader(folder_layout(project(files), [source])).load()[source].program

    return load


def wrong(load, files, source="main"):
    """Return the error without the path of the project before it."""
    with pytest.raises(ConfigurationError) as raised:
        load(files, source)
    return str(raised.value).partition("/cell/")[2]


class OtherCode:
    """What the other language makes of a program."""

    def __init__(self, source):
        self.source = source
        self.warnings = [f"{source.name}: a warning"]


class Other:
    """A language whose units end in ``.other``; it loads nothing."""

    name = "Other"
    load_cost = 0

    def units(self, files):
        return [file for file in files if file.suffix == ".other"]

    def declarations(self, files):
        return ()

    def dialect(self, declared):
        raise AssertionError("nothing is declared")

    def load(self, source):
        return OtherCode(source)


def test_a_program_is_loaded_by_the_language_that_has_units_in_its_folder(project):
    folder = project({"main/b.other": "", "main/a.other": "", "main/notes.txt": ""})
    loader = ProgramLoader(folder_layout(folder, ["main"]), languages=[PYTHON, Other()])
    source = loader.load()["main"].source
    assert loader.warnings == ["main: a warning"]
    assert (source.name, source.folder) == ("main", folder / "main")
    assert source.declarations is loader.declarations
    assert source.scope is loader.declarations.scope_of("main")
    assert [file.name for file in source.files] == ["a.other", "b.other"]


def test_a_helper_process_compiles_some_of_many_programs(project, monkeypatch):
    """Here too each is loaded: what the other process has done is in its cache."""
    here = []
    pid = os.getpid()

    class Compiled(Other):
        load_cost = 1

        def load(self, source):
            cache = source.folder / "cache"
            here.append((source.name, cache.exists()))
            cache.touch()
            if len(here) == 2 and os.getpid() == pid:  # the first one was slow
                limit = time.monotonic() + 100
                while len([*source.folder.parent.glob("*/cache")]) < len(names):
                    assert time.monotonic() < limit
                    time.sleep(0.001)
            if source.name == "p3":
                raise ConfigurationError("p3 is wrong")
            return OtherCode(source)

    monkeypatch.setattr(helper_module, "can_help", lambda: True)
    monkeypatch.setattr(loader_module, "LONGEST_KNOWN_S", -1.0)
    names = [f"p{number}" for number in range(8)]
    folder = project({f"{name}/a.other": name * 9 for name in names})
    loader = ProgramLoader(folder_layout(folder, names), languages=[Compiled()])
    loaded = loader.load_each()
    known = dict(here)
    assert len(here) == len(known) == len(names)
    assert known["p0"] is False
    assert sum(known.values()) >= 6  # made by the helper, or 7 where it took all of the rest
    assert [*loaded.codes] == [name for name in names if name != "p3"]
    assert loaded.failures == {"p3": ("p3 is wrong",)}
    assert loader.warnings == [f"{name}: a warning" for name in names if name != "p3"]


def test_what_a_cache_has_needs_no_helper_process(project, monkeypatch):
    class Compiled(Other):
        load_cost = 1

    monkeypatch.setattr(helper_module, "can_help", lambda: True)
    monkeypatch.setattr(loader_module, "LONGEST_KNOWN_S", 3600.0)
    monkeypatch.setattr(helper_module, "helper_process", lambda _work: pytest.fail("a helper"))
    told = []
    names = [f"p{number}" for number in range(8)]
    folder = project({f"{name}/a.other": name for name in names})
    layout = folder_layout(folder, names)
    loader = ProgramLoader(layout, [Compiled()], lambda done, total: told.append((done, total)))
    assert [*loader.load()] == names
    assert told == [(count, 8) for count in range(1, 9)]


def test_what_takes_longest_is_loaded_first(project):
    """Of two processes none works alone at the end for long."""
    order = []

    class Slow(Other):
        load_cost = 10

        def load(self, source):
            order.append(source.name)
            return OtherCode(source)

    class Fast(Slow):
        load_cost = 1

        def units(self, files):
            return [file for file in files if file.suffix == ".fast"]

    files = {"a/a.fast": "123456", "b/b.other": "12", "c/c.other": "123", "d/d.fast": "1"}
    layout = folder_layout(project(files), ["a", "b", "c", "d"])
    assert [*ProgramLoader(layout, [Slow(), Fast()]).load()] == ["a", "b", "c", "d"]
    assert order == ["c", "b", "a", "d"]


def test_a_program_has_one_language(project):
    folder = project({"main/a.other": "", "main/main.py": ""})
    with pytest.raises(ConfigurationError) as raised:
        ProgramLoader(folder_layout(folder, ["main"]), languages=[PYTHON, Other()]).load()
    assert str(raised.value) == (
        f"{folder / 'main'}: holds units in Python and Other; a program has one language"
    )


def test_a_block_without_a_body_is_a_warning(project):
    files = {"main/main.py": CLASS, "ramps/ramps.fun": "FUNCTION_BLOCK Ramp END_FUNCTION_BLOCK"}
    loader = ProgramLoader(folder_layout(project(files), ["main"]))
    loader.load()
    (warning,) = loader.warnings
    assert warning.endswith("ramps/ramps.fun:1:16: warning: Ramp has no body")


def test_two_projects_do_not_mix(project, tmp_path):
    first = project({"main/main.py": CLASS})
    second = first.rename(tmp_path / "other")
    project({"main/main.py": CLASS.replace("Main", "Other")})
    loaders = [ProgramLoader(folder_layout(folder, ["main"])) for folder in (second, first)]
    programs = [loader.load()["main"].program for loader in loaders]
    assert [program.__name__ for program in programs] == ["Main", "Other"]


@pytest.mark.parametrize(
    ("files", "error"),
    [
        ({"other/main.py": "", "more/variables.py": ""}, "; there are more, other"),
        ({"main": ""}, ""),
        ({"notes.txt": ""}, ""),
    ],
)
def test_a_folder_that_is_not_there(load, files, error):
    assert wrong(load, files) == f"main: no such program folder{error}"


def test_a_folder_without_a_program(load):
    told = "main: holds no program: neither main.py nor variables.py, no .st file, no .c file"
    assert wrong(load, {"main/notes.txt": ""}) == told


def test_a_folder_that_may_not_be_read_is_named(load, monkeypatch):
    def refused(path, **_):
        raise PermissionError(13, "Permission denied", str(path))

    files = {"main/main.py": ""}
    with monkeypatch.context() as patched:
        load(files | {"other/main.py": CLASS}, "other")
        patched.setattr(Path, "iterdir", refused)
        with pytest.raises(ConfigurationError, match="main: cannot be read: Permission denied"):
            load(files)
