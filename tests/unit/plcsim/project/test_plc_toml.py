"""plc.toml: what it says, and every way in which it can be wrong."""

import re
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.task import Policy
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import PROJECT_IS
from plcsim.project.tables import ProgramEntry

MS = 1_000_000

PROGRAM = """
    from plcsim import Program
    from st_types import UINT, var

    class Main(Program):
        count = var(UINT)

        def cyclic(self) -> None:
            self.count += 1
"""

CLASS = "[task_class.1]\n"
MAIN = CLASS + 'programs = ["main"]\n'


@pytest.fixture
def read(project):
    """``read(text)``: the project with this plc.toml and a program ``main``."""

    def read(text, **files):
        return read_project(project({"plc.toml": text, "main/main.py": PROGRAM} | files))

    return read


def test_a_byte_order_mark_is_read_over(read):
    assert read("\ufeff" + MAIN) == read(MAIN)


def test_the_defaults(read):
    found = read(MAIN)
    assert (found.name, found.folder.name) == ("cell", "cell")
    assert (found.plc.tick_ns, found.plc.memory_size) == (MS, 16 * 1024 * 1024)
    assert (found.plc.watchdog_ns, found.plc.init_timeout_ns) == (500 * MS, 10_000 * MS)
    assert (found.plc.realtime, found.plc.priority, found.plc.pinned_cpu) == ("auto", 50, None)
    assert found.plc.exception_program is None
    (first,) = found.classes
    assert (first.number, first.cycle_ns, first.tolerance_ns) == (1, 10 * MS, 10 * MS)
    assert first.first_release_ns == 5 * MS
    assert (first.policy, first.host_policy) == (Policy.SERVICE, Policy.LOG)
    assert first.programs == (ProgramEntry("main", "main"),)


@pytest.mark.parametrize(
    ("number", "cycle_ms", "tolerance_ms"),
    [
        (1, 10, 10),
        (2, 20, 20),
        (3, 50, 50),
        (4, 100, 100),
        (5, 200, 200),
        (6, 500, 500),
        (7, 1000, 1000),
        (8, 10, 30_000),
    ],
)
def test_the_times_of_a_new_automation_studio_project(read, number, cycle_ms, tolerance_ms):
    (found,) = read(f'[task_class.{number}]\nprograms = ["main"]').classes
    assert (found.cycle_ns, found.tolerance_ns) == (cycle_ms * MS, tolerance_ms * MS)


def test_everything_that_can_be_set(read):
    found = read(
        """
        [plc]
        name = "Cell 7"
        tick = "500us"
        memory = "64KiB"
        watchdog = "2s"
        init_timeout = "1min"
        realtime = "off"
        priority = 98
        cpu = 0
        exception_program = "alarm"

        [task_class.4]
        programs = ["main"]

        [task_class.2]
        cycle = "2.5ms"
        tolerance = "0ms"
        first_release = "0ms"
        on_violation = "exception"
        on_host_violation = "service"
        programs = ["a", { name = "b", source = "lines/b" }, { name = "c" }]

        [library.astcp]
        max_idents = 7
        """
    )
    assert (found.name, found.plc.tick_ns, found.plc.memory_size) == ("Cell 7", 500_000, 65536)
    assert (found.plc.watchdog_ns, found.plc.init_timeout_ns) == (2_000 * MS, 60_000 * MS)
    assert (found.plc.realtime, found.plc.priority, found.plc.pinned_cpu) == ("off", 98, 0)
    assert [c.number for c in found.classes] == [2, 4]
    second = found.classes[0]
    assert (second.cycle_ns, second.tolerance_ns, second.first_release_ns) == (2_500_000, 0, 0)
    assert (second.policy, second.host_policy) == (Policy.EXCEPTION, Policy.SERVICE)
    assert [p.name for p in found.programs] == ["a", "b", "c", "main", "alarm"]
    assert second.programs[1] == ProgramEntry("b", "lines/b")
    assert list(found.libraries) == ["astcp"]


def test_the_file_may_be_named_instead_of_the_folder(read):
    found = read(MAIN)
    assert read_project(found.folder / "plc.toml") == found


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "task_class: at least one, [task_class.1], is needed"),
        ("[task_class]", "task_class: at least one, [task_class.1], is needed"),
        ("= 1", "Invalid statement"),
        ("[plc]\nname = 1\n" + MAIN, "plc.name: 1 is not a string"),
        ("plc = 3\n" + MAIN, "plc: 3 is not a table"),
        ("task_class = 3", "task_class: 3 is not a table"),
        ("[task_class]\n1 = 3", "task_class.1: 3 is not a table"),
        ("library = 3\n" + MAIN, "library: 3 is not a table"),
        ("[library]\nastcp = 3\n" + MAIN, "library.astcp: 3 is not a table"),
        ("[plcs]\n" + MAIN, "plcs: unknown key; did you mean plc?"),
        ("[plc]\ntikc = '1ms'\n" + MAIN, "plc.tikc: unknown key; did you mean tick?"),
        ("[plc]\ntick = ''\n" + MAIN, "plc.tick: '' is not a duration"),
        ("[plc]\ntick = '0ms'\n" + MAIN, "plc.tick: must be above 0"),
        ("[plc]\ntick = 1\n" + MAIN, "plc.tick: 1 is not a string"),
        ("[plc]\nwatchdog = 'soon'\n" + MAIN, "plc.watchdog: 'soon' is not a duration"),
        ("[plc]\nmemory = '16 potatoes'\n" + MAIN, "plc.memory: '16 potatoes' is not a size"),
        ("[plc]\nmemory = '5000'\n" + MAIN, "plc.memory: '5000' must be a multiple of 65536"),
        ("[plc]\nmemory = '4096MiB'\n" + MAIN, "plc.memory: '4096MiB' must be a multiple of"),
        ("[plc]\nrealtime = 'yes'\n" + MAIN, "plc.realtime: 'yes' is not \"auto\""),
        ("[plc]\nrealtime = true\n" + MAIN, 'plc.realtime: True is not "auto"'),
        ("[plc]\npriority = 99\n" + MAIN, "plc.priority: 99 is outside 1..98"),
        ("[plc]\npriority = true\n" + MAIN, "plc.priority: True is not a whole number"),
        ("[plc]\npriority = 1.5\n" + MAIN, "plc.priority: 1.5 is not a whole number"),
        ("[plc]\ncpu = -2\n" + MAIN, "plc.cpu: -2 is outside"),
        ("[plc]\ncpu = 1000000000000\n" + MAIN, "plc.cpu: 1000000000000 is outside"),
        (
            "[plc]\nexception_program = '../main'\n" + MAIN,
            "plc.exception_program: '../main' is not",
        ),
        ("[plc]\nexception_program = 'main'\n" + MAIN, "programs: two programs are called main"),
        (
            "[task_class.9]\nprograms = ['main']",
            "task_class.9: task classes are [task_class.1] to [task_class.8]",
        ),
        (
            "[task_class.0]\nprograms = ['main']",
            "task_class.0: task classes are [task_class.1] to [task_class.8]",
        ),
        (
            "[task_class.fast]\nprograms = ['main']",
            "task_class.fast: task classes are [task_class.1] to [task_class.8]",
        ),
        (CLASS, "task_class.1.programs: at least one program is needed"),
        (CLASS + "programs = []", "task_class.1.programs: at least one program is needed"),
        (CLASS + "programs = 'main'", "task_class.1.programs: 'main' is not a list"),
        (CLASS + "programs = [3]", "task_class.1.programs: 3 is neither a name nor {name="),
        (CLASS + "programs = [{}]", "task_class.1.programs: {} is neither a name nor"),
        (CLASS + "programs = ['a b']", "task_class.1.programs: 'a b' is not an identifier"),
        (CLASS + "programs = ['a.b']", "task_class.1.programs: 'a.b' is not an identifier"),
        (CLASS + "programs = ['']", "task_class.1.programs: '' is not an identifier"),
        (
            CLASS + "programs = [{name='a', sorce='b'}]",
            "task_class.1.programs: a: unknown key sorce",
        ),
        (
            CLASS + "programs = [{name='a', source='/b'}]",
            "task_class.1.programs: a: source '/b' is not a folder of the",
        ),
        (
            CLASS + "programs = [{name='a', source='b/../..'}]",
            "task_class.1.programs: a: source 'b/../..' is not a folder",
        ),
        (
            CLASS + "programs = [{name='a', source=1}]",
            "task_class.1.programs: a: source 1 is not a folder of the project",
        ),
        (CLASS + "programs = ['main', 'main']", "programs: two programs are called main; give one"),
        (CLASS + "programs = ['main', 'MAIN']", "programs: two programs are called MAIN; give one"),
        (MAIN + "cycle = '1.0005ms'", "task_class.1.cycle: 1000500 ns is not a multiple of the"),
        (MAIN + "cycle = '0ms'", "task_class.1.cycle: must be above 0"),
        (MAIN + "cycle = 10", "task_class.1.cycle: 10 is not a string such as"),
        (MAIN + "cycle = '1m'", "task_class.1.cycle: '1m' is a minute or more, too long for a "),
        (MAIN + "cycle = '1min'", "task_class.1.cycle: '1min' is a minute or more, too long for"),
        (MAIN + "cycle = '-1ms'", "task_class.1.cycle: '-1ms' is not a duration"),
        (MAIN + "cycle = ''", "task_class.1.cycle: '' is not a duration"),
        (MAIN + "tolerance = '1'", "task_class.1.tolerance: '1' is not a duration"),
        (MAIN + "first_release = 'x'", "task_class.1.first_release: 'x' is not a duration"),
        (MAIN + "on_violation = 'stop'", "task_class.1.on_violation: 'stop' is not \"service\""),
        (MAIN + "on_violation = 'exception'", "task_class.1: the policy exception needs plc.exc"),
        (MAIN + "on_host_violation = 1", 'task_class.1.on_host_violation: 1 is not "service"'),
        (MAIN + "cycel = '1ms'", "task_class.1.cycel: unknown key; did you mean cycle?"),
        (MAIN + "x = 1", "task_class.1.x: unknown key; known are cycle, tolerance, first_release"),
        ("a = " + "[" * 5000 + "]" * 5000, ""),
    ],
)
def test_what_is_wrong_is_named_with_file_and_field(read, tmp_path, text, error):
    with pytest.raises(ConfigurationError) as raised:
        read(text)
    message = str(raised.value)
    assert message.startswith(f"{tmp_path / 'cell' / 'plc.toml'}: {error}")
    assert "\n" not in message


@pytest.mark.parametrize("text", ["20m", " 20 M "])
def test_minutes_for_a_cycle_are_taken_for_misspelt_milliseconds(read, text):
    with pytest.raises(ConfigurationError, match=r'too long .*; did you mean "20ms"\?$'):
        read(MAIN + f"cycle = '{text}'")


def test_a_cycle_that_is_no_multiple_of_the_tick_is_shown_exactly(read):
    with pytest.raises(ConfigurationError, match="10000001 ns is not a multiple of the tick"):
        read(MAIN + "cycle = '10.000001ms'")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ConfigurationError, match=re.escape(f"{tmp_path / 'plc.toml'}: there is")):
        read_project(tmp_path)


def test_near_projects_are_named_where_one_is_missing(project, monkeypatch):
    folder = project({"plc.toml": MAIN, "main/main.py": PROGRAM})
    for path in (folder / "main", folder / "main" / "main.py", folder / "none" / "at" / "all"):
        with pytest.raises(ConfigurationError, match=re.escape(f"; did you mean {folder}?")):
            read_project(path)
    for path in (folder.parent, folder.parent / "none", folder.parent / "none" / "plc.toml"):
        with pytest.raises(ConfigurationError) as raised:
            read_project(path)
        hint = "" if path.name == "plc.toml" else f"; there are projects in {folder}"
        assert str(raised.value).endswith(hint or f"; {PROJECT_IS}")
    monkeypatch.chdir(folder / "main")
    with pytest.raises(ConfigurationError, match=re.escape("plc.toml: there is no such file; did")):
        read_project(Path())


def test_the_one_automation_studio_project_below_a_folder_is_meant(project):
    package = '<P><Object Type="Program">A</Object></P>'
    files = {"x.apj": "<P/>", "Logical/Package.pkg": package, "Logical/A/IEC.prg": "<P/>"}
    folder = project({f"zip/inner/{name}": text for name, text in files.items()})
    assert read_project(folder).automation_studio.folder == folder / "zip" / "inner"
    project({f"zip/second/{name}": text for name, text in files.items()})
    both = "projects in .*zip/inner, .*zip/second"
    with pytest.raises(ConfigurationError, match=both):
        read_project(folder)


def test_a_folder_of_a_project_may_be_called_as_its_file_and_an_archive_is_none(project):
    folder = project({"plc.toml": MAIN, "main/main.py": PROGRAM})
    named = folder.rename(folder.with_name("cell.apj"))
    assert read_project(named).folder == named
    (archive := folder.with_name("cell.zip")).touch()
    text = f"{archive}: is no project but an archive to unpack; there are projects in {named}"
    with pytest.raises(ConfigurationError, match=re.escape(text)):
        read_project(archive)
    (named / "notes.txt").touch()
    text = f"{named}/notes.txt: is no project but a file; did you mean {named}?"
    with pytest.raises(ConfigurationError, match=re.escape(text)):
        read_project(named / "notes.txt")


@pytest.mark.parametrize("path", ["a\0b", "x" * 300])
def test_what_can_be_no_path_is_an_error(path):
    with pytest.raises(ConfigurationError, match="cannot be read"):
        read_project(Path(path))


def test_a_misspelt_key_is_told_before_what_is_missing(read):
    with pytest.raises(
        ConfigurationError, match=r"task_clas: unknown key; did you mean task_class"
    ):
        read("[task_clas.1]\nprograms = ['main']")
    with pytest.raises(ConfigurationError, match=r"1\.program: unknown key; did you mean programs"):
        read("[task_class.1]\nprogram = ['main']")


@pytest.mark.parametrize("make", ["directory", "latin"])
def test_a_file_that_cannot_be_read_is_named(tmp_path, make):
    file = tmp_path / "plc.toml"
    if make == "directory":
        file.mkdir()
    else:
        file.write_bytes(b'[plc]\nname = "\xe4"\n')
    with pytest.raises(ConfigurationError, match=r"plc\.toml: cannot be read"):
        read_project(tmp_path)


# loading


def test_folders_of_libraries_begin_at_the_project(read):
    folder = read(MAIN).folder
    (folder / "lib").mkdir()
    (folder.parent / "other").mkdir()
    found = read(MAIN + '[libraries]\nfolders = ["lib", "../other"]')
    assert [place.folder.name for place in found.layout.libraries] == ["lib", "other"]
    with pytest.raises(ConfigurationError, match=r"libraries\.folders: there is no such folder"):
        read(MAIN + '[libraries]\nfolders = ["nowhere"]')
    with pytest.raises(ConfigurationError, match=r"libraries\.folder: unknown key; did you mean f"):
        read(MAIN + '[libraries]\nfolder = ["lib"]')
