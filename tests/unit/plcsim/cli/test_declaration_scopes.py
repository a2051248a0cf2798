from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.cli.declaration_scopes import (
    FoundDeclarations,
    NamedScope,
    library_scopes,
    read_declarations,
    report,
)
from plcsim.core.errors import PlcError
from st_types.resolve.scope import Scope

Write = Callable[[dict[str, str]], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write files below a folder and return it."""

    def call(texts: dict[str, str]) -> Path:
        for name, text in texts.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return tmp_path

    return call


def checked(found: FoundDeclarations) -> list[str]:
    """Check all scopes and return what is told."""
    for each in found.scopes:
        each.scope.check()
    lines: list[str] = []
    report(found, lines.append)
    return lines


def named(found: FoundDeclarations, *path: str) -> NamedScope:
    return next(each for each in found.scopes if each.path == path)


def type_text(name: str, specification: str = "INT") -> str:
    return f"TYPE {name} : {specification}; END_TYPE"


def names_around(scope: Scope) -> list[str]:
    return [each.name for each in scope.chain]


def test_the_libraries_are_found_and_see_one_another() -> None:
    libraries = library_scopes()
    assert {"astcp", "standard"} <= {scope.name for scope in libraries}
    assert libraries[0].find_function_block("TON") is not None
    for scope in libraries:
        scope.check()
        assert all(file.diagnostics.records == [] for file in scope.files)


def test_a_folder_sees_those_around_it_and_none_beside_it(write: Write) -> None:
    folder = write(
        {
            "Global.typ": type_text("Shared", "TON"),
            "Pump/Types.typ": type_text("Own", "Shared"),
            "Pump/Inner/x.var": "VAR a : Shared; b : Own; END_VAR",
            "Belt/x.var": "VAR a : Shared; b : Own; END_VAR",
            ".hidden/x.typ": "TYPE ; broken",
        }
    )
    found = read_declarations([folder])
    assert [(each.kind, each.path) for each in found.scopes] == [
        ("project", (folder.name,)),
        ("folder", ("Belt",)),
        ("folder", ("Pump",)),
        ("folder", ("Pump", "Inner")),
    ]
    inner = named(found, "Pump", "Inner").scope
    assert names_around(inner)[:3] == ["Inner", "Pump", folder.name]
    assert [line.splitlines()[0] for line in checked(found)] == [
        f"{folder}/Belt/x.var:1:21: warning: no type is called Own"
    ]


def test_libraries_of_a_folder_are_seen_by_all_and_by_one_another(write: Write) -> None:
    folder = write(
        {
            "libs/A/A.fun": "FUNCTION_BLOCK A VAR b : B; END_VAR END_FUNCTION_BLOCK",
            "libs/B/IEC.lby": "",
            "libs/B/B.typ": type_text("B", "Shared"),
            "Global.typ": type_text("Shared"),
            "Main/x.var": "VAR a : A; b : B; END_VAR",
            "Other/IEC.prg": "",
            "Other/x.fun": "FUNCTION_BLOCK Own END_FUNCTION_BLOCK",
        }
    )
    found = read_declarations([folder], strict=True)
    assert [(each.kind, each.path[-1]) for each in found.scopes] == [
        ("library", "A"),
        ("library", "B"),
        ("project", folder.name),
        ("folder", "Main"),
        ("folder", "Other"),
    ]
    assert checked(found) == []
    assert named(found, "Main").scope.find_type("Own") is None


def test_a_file_of_a_project_sees_the_project(write: Write) -> None:
    folder = write(
        {
            "plc.toml": "",
            "Global.typ": type_text("Shared"),
            "Pump/x.var": "VAR a : Shared; END_VAR",
            "Pump/y.var": "VAR b : Nothing; END_VAR",
        }
    )
    found = read_declarations([folder / "Pump" / "x.var"])
    assert [file.path for file in found.files] == [str(folder / "Pump" / "x.var")]
    assert [each.path for each in found.scopes] == [("Pump",)]
    assert ("project", (folder.name,)) in [(each.kind, each.path) for each in found.others]
    assert checked(found) == []


def test_a_file_elsewhere_stands_alone(write: Write) -> None:
    folder = write({"a.typ": type_text("A"), "b.typ": type_text("B", "A")})
    found = read_declarations([folder / "b.typ"])
    assert [line.splitlines()[0] for line in checked(found)] == [
        f"{folder}/b.typ:1:10: warning: no type is called A"
    ]


def test_paths_are_shown_as_they_were_named(write: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write({"plc.toml": "", "Pump/x.var": "VAR a : Lib; END_VAR"})
    monkeypatch.chdir(folder / "Pump")
    assert [file.path for file in read_declarations([Path()]).files] == ["x.var"]
    monkeypatch.chdir(folder)
    assert [file.path for file in read_declarations([Path("Pump")]).files] == ["Pump/x.var"]


@pytest.mark.parametrize(
    ("name", "message"),
    [("nope", "nope: no such file or folder"), ("a.txt", r"a.txt: not a .fun, .typ or .var file")],
)
def test_what_is_no_declaration_file_is_refused(write: Write, name: str, message: str) -> None:
    folder = write({"a.txt": ""})
    with pytest.raises(PlcError, match=message):
        read_declarations([folder / name])


def package(*objects: tuple[str, str]) -> str:
    lines = "".join(f"<Object {kind}>{name}</Object>" for kind, name in objects)
    return f'<?xml version="1.0"?><Package xmlns="AS"><Objects>{lines}</Objects></Package>'


FILE, INNER, PROGRAM, LIBRARY = (f'Type="{k}"' for k in ("File", "Package", "Program", "Library"))
PRIVATE = f'{FILE} Private="true"'


@pytest.fixture
def project(write: Write) -> Path:
    """An Automation Studio project."""
    program = '<Program><Files><File Private="true">Types.typ</File></Files></Program>'
    return write(
        {
            "Plant.apj": "",
            "Logical/Package.pkg": package(
                (FILE, "Global.typ"), (LIBRARY, "Own"), (LIBRARY, "standard"), (INNER, "Line")
            ),
            "Logical/Global.typ": type_text("Shared", "FromLine"),
            "Logical/Own/ANSIC.lby": package((FILE, "Own.typ")),
            "Logical/Own/Own.typ": type_text("InOwn", "InStandard"),
            "Logical/standard/Binary.lby": package((FILE, "standard.typ")),
            "Logical/standard/standard.typ": type_text("InStandard", "Shared"),
            "Logical/Line/Package.pkg": package(
                (FILE, "Line.typ"),
                (PRIVATE, "Secret.typ"),
                (PROGRAM, "Belt"),
                (INNER, "Deep"),
            ),
            "Logical/Line/Line.typ": type_text("FromLine"),
            "Logical/Line/Secret.typ": type_text("Secret", "InOwn"),
            "Logical/Line/Belt/IEC.prg": program,
            "Logical/Line/Belt/Types.typ": type_text("Shared", "Secret"),
            "Logical/Line/Deep/Package.pkg": package((PROGRAM, "Pump")),
            "Logical/Line/Deep/Pump/IEC.prg": program,
            "Logical/Line/Deep/Pump/Types.typ": type_text("OfPump", "Shared"),
            "Temp/Objects/x.typ": "TYPE ; broken",
            "Physical/SafeLOGIC/Global.var": "VAR_GLOBAL ; broken",
        }
    )


def test_the_scopes_of_an_automation_studio_project(project: Path) -> None:
    found = read_declarations([project], strict=True)
    name = project.name
    assert [(each.kind, each.path) for each in found.scopes] == [
        ("library", ("Own",)),
        ("library", ("standard",)),
        ("project", (name,)),
        ("package", ("Line",)),
        ("program", ("Line", "Belt")),
        ("program", ("Line", "Deep", "Pump")),
    ]
    assert checked(found) == []
    pump = named(found, "Line", "Deep", "Pump").scope
    assert names_around(pump)[:5] == ["Pump", "Line", name, "Own", "standard"]
    assert "astcp" in names_around(pump)[5:]
    assert pump.find_type("Shared") is named(found, name).scope.find_type("Shared")
    assert named(found, name).scope.find_type("Secret") is None
    assert named(found, name).scope.find_type("OfPump") is None


def test_a_part_of_a_project_sees_the_whole(project: Path) -> None:
    for path in (project / "Logical/Line/Belt", project / "Logical/Line/Belt/Types.typ"):
        found = read_declarations([path], strict=True)
        assert [each.path for each in found.scopes] == [("Line", "Belt")]
        assert checked(found) == []
    (project / "Plant.apj").unlink()
    assert checked(read_declarations([project / "Logical/Line/Deep"], strict=True)) == []


def test_what_no_package_lists_and_what_is_not_there_is_told(project: Path) -> None:
    for number in range(7):
        (project / f"Logical/Line/old{number}.typ").write_text("TYPE ; broken")
    (project / "Logical/Line/Line.typ").unlink()
    (project / "Logical/Line/Deep/Package.pkg").write_text("<Package")
    found = read_declarations([project])
    lines = checked(found)
    logical = project / "Logical"
    assert lines[0].startswith(f"{logical}/Line/Deep/Package.pkg: error: it is no XML: ")
    assert lines[1:8] == [
        f"{logical}/Line/Package.pkg: warning: File Line.typ is listed and not there",
        *(
            f"{logical}/Line/old{number}.typ: warning: no package lists it, so it is not read"
            for number in range(5)
        ),
        f"{logical}: warning: 3 more files that are not listed",
    ]
    assert report(found, lambda _line: None) == 1


def test_a_library_beside_projects_is_seen_by_them_and_a_listed_file_is_read_once(
    write: Write, project: Path
) -> None:
    write(
        {
            "all/lib/Beside.fun": "FUNCTION_BLOCK Beside END_FUNCTION_BLOCK",
            "all/plant/Package.pkg": package(
                (PROGRAM, "P"), (f'{LIBRARY} Reference="true"', "..\\lib2\\IEC.lby")
            ),
            "all/plant/P/IEC.prg": package((FILE, "x.var")),
            "all/plant/P/x.var": "VAR a : Beside; b : Second; END_VAR",
            "all/lib2/IEC.lby": package((FILE, "Second.typ")),
            "all/lib2/Second.typ": type_text("Second"),
        }
    )
    found = read_declarations([project / "all"], strict=True)
    assert checked(found) == []
    assert sorted(Path(file.path).name for file in found.files) == [
        *["Beside.fun", "Second.typ", "x.var"]
    ]
