from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.library import document
from plcsim.project.automation_studio import logical_view
from plcsim.project.automation_studio.logical_view import (
    is_listed,
    is_package,
    logical_folder,
    read_logical_view,
)

Write = Callable[[dict[str, str]], Path]


def listing(*lines: str) -> str:
    return (
        '\ufeff<?xml version="1.0" encoding="utf-8"?>\n<?AutomationStudio Version=4.1.17.113 SP?>\n'
        f'<Package xmlns="http://br-automation.co.at/AS/Package"><Objects>{"".join(lines)}'
        "</Objects></Package>"
    )


def entry(kind: str, name: str, more: str = "") -> str:
    return f'<Object Type="{kind}" {more}>{name}</Object>'


def test_packages_programs_and_libraries_in_the_order_of_their_lists(write: Write) -> None:
    root = write(
        {
            "Logical/package.PKG": listing(
                entry("Package", "line"),
                entry("File", "GLOBAL.typ"),
                entry("Library", "Lib", 'Language="ANSIC"'),
                entry("DataObject", "Data"),
            ),
            "Logical/Global.typ": "",
            "Logical/Data/x.br": "",
            "Logical/Lib/ANSIC.lby": "<Library><Files><File>Lib.fun</File></Files></Library>",
            "Logical/Lib/Lib.fun": "",
            "Logical/Line/Package.pkg": listing(
                entry("Program", "Belt"), entry("File", "Own.typ", 'Private="true"')
            ),
            "Logical/Line/Own.typ": "",
            "Logical/Line/Belt/iec.prg": listing(
                entry("File", "Main.st"), entry("Package", "Actions")
            ),
            "Logical/Line/Belt/Main.st": "",
            "Logical/Line/Belt/Actions/Package.pkg": listing(entry("File", "Stop.st")),
            "Logical/Line/Belt/Actions/Stop.st": "",
        }
    )
    view = read_logical_view(root / "Logical")
    assert view.findings == []
    package = view.root
    assert [file.name for file in package.files] == ["Global.typ"]
    assert [(each.name, each.path) for each in package.libraries] == [("Lib", ("Lib",))]
    assert [file.name for file in package.libraries[0].files] == ["Lib.fun"]
    (line,) = package.packages
    assert (line.path, line.folder.name) == (("line",), "Line")
    assert [file.name for file in line.private_files] == ["Own.typ"]
    (belt,) = line.programs
    assert (belt.name, belt.path) == ("Belt", ("line", "Belt"))
    assert [file.name for file in belt.files] == ["Main.st", "Stop.st"]


def test_references_count_from_the_project_its_root_and_the_package(write: Write) -> None:
    root = write(
        {
            "plant/Plant.apj": "",
            "plant/Logical/Package.pkg": listing(
                entry("Package", "Line"),
                entry("Library", "..\\SRC\\\\Lib\\iec.lby", 'Reference="true"'),
            ),
            "plant/Logical/Line/Package.pkg": listing(
                entry("File", "\\Logical\\Other\\x.typ", 'Reference="true"'),
                entry("Program", "near\\ANSIC.prg", 'Reference="true"'),
                entry("Package", "C:\\far\\Package.pkg", 'Reference="true"'),
            ),
            "plant/Logical/Line/near/ANSIC.prg": listing(entry("File", "y.var")),
            "plant/Logical/Line/near/y.var": "",
            "plant/Logical/Other/X.typ": "",
            "src/lib/IEC.lby": listing(entry("File", "Lib.typ")),
            "src/lib/Lib.typ": "",
        }
    )
    folder = logical_folder(root / "plant")
    assert folder == root / "plant" / "Logical"
    view = read_logical_view(folder)
    (line,) = view.root.packages
    assert line.files == [root / "plant/Logical/Other/X.typ"]
    assert [(each.name, each.files[0].name) for each in line.programs] == [("near", "y.var")]
    (library,) = view.root.libraries
    assert (library.name, library.files) == ("lib", (root / "src/lib/Lib.typ",))
    assert [(each.message, each.missing) for each in view.findings] == [
        ("Package C:\\far\\Package.pkg is listed and not there", "C:\\far\\Package.pkg")
    ]


BOMB = '<!DOCTYPE a [<!ENTITY b "ccc"><!ENTITY d "&b;&b;">]><Package>&d;</Package>'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<Package>", "it is no XML: no element found"),
        ("", "it is no XML: no element found"),
        ('<?xml version="1.0" encoding="nonsense"?><a/>', "it is no XML: "),
        (BOMB, "a document type (a) has no place here"),
        (" " * 2000, "it is larger than 0 MiB"),
    ],
)
def test_a_list_that_cannot_be_read(
    write: Write, text: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(document, "MAX_BYTES", 1000)
    folder = write({"Package.pkg": text})
    view = read_logical_view(folder)
    (finding,) = view.findings
    assert finding.file == folder / "Package.pkg"
    assert finding.message.startswith(message)
    assert finding.missing == ""


def test_a_package_saved_half_has_what_its_list_names_before_that(write: Write) -> None:
    listed = listing(entry("File", "a.typ"), entry("Program", "P"), entry("File", "last.typ"))
    half = listing(entry("File", "b.st"), entry("File", "c.st"))
    folder = write(
        {
            "Package.pkg": listed[: listed.index("st.typ")],
            "a.typ": "",
            "P/IEC.prg": half[: half.index("c.st") + 2],
            "P/b.st": "",
        }
    )
    view = read_logical_view(folder)
    assert [file.name for file in view.root.files] == ["a.typ"]
    assert [each.name for each in view.root.programs] == ["P"]
    (program,) = view.root.programs
    assert program.files == ()
    assert {each.file.name for each in view.findings} == {"Package.pkg", "IEC.prg"}
    assert all(each.message.startswith("it is no XML: ") for each in view.findings)


def test_what_is_not_there_is_told_and_the_rest_is_read(write: Write) -> None:
    folder = write(
        {
            "Package.pkg": listing(
                entry("File", "gone.typ"),
                entry("File", "folder.typ"),
                entry("Program", "Empty"),
                entry("File", "here.typ"),
            ),
            "folder.typ/x": "",
            "Empty/x.var": "",
            "here.typ": "",
        }
    )
    view = read_logical_view(folder)
    assert [file.name for file in view.root.files] == ["here.typ"]
    assert [(each.file, each.message) for each in view.findings] == [
        (folder / "Package.pkg", "File gone.typ is listed and not there"),
        (folder / "Package.pkg", "File folder.typ is listed and not there"),
        (folder / "Empty", "there is no IEC.prg or ANSIC.prg"),
    ]


def test_packages_that_list_themselves_end(write: Write) -> None:
    folder = write(
        {
            "Package.pkg": listing(entry("Package", "a")),
            "a/Package.pkg": listing(entry("Package", "..\\..\\Package.pkg", 'Reference="true"')),
        }
    )
    (folder.parent / "Package.pkg").write_text(listing(entry("Package", folder.name)))
    findings = read_logical_view(folder).findings
    assert [each.message for each in findings] == ["it is listed twice, or lists itself"]


def test_deep_packages_end(write: Write) -> None:
    text = listing(entry("Package", "a"))
    folder = write({"a/" * depth + "Package.pkg": text for depth in range(60)})
    package = read_logical_view(folder).root
    depth = 0
    while package.packages:
        package, depth = package.packages[0], depth + 1
    assert depth == logical_view.MAX_DEPTH


def test_what_a_folder_is(write: Write) -> None:
    folder = write(
        {"a/PACKAGE.pkg": "", "b/ansic.lby": "", "c/x.typ": "", "d/Logical/x": "", "d/x.apj": ""}
    )
    assert [is_package(folder / name) for name in "abc"] == [True, False, False]
    assert [is_listed(folder / name) for name in "abc"] == [True, True, False]
    assert logical_folder(folder / "d") is None
    assert logical_folder(folder / "nowhere") is None
