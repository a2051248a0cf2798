"""Definition files in the folder layouts of ROS, catkin, Debian and cROS."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from crosnode.errors import DefinitionError
from crosnode.messages.packages import MAX_FILE_SIZE, SHARE, DefinitionKind, PackagePath


def write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(text.encode())


@pytest.mark.parametrize(
    ("file", "path"),
    [
        ("pkg/msg/Name.msg", "."),
        ("pkg/Name.msg", "."),
        ("pkg/msg/Name.msg", "pkg"),
        ("pkg/Name.msg", "pkg"),
        ("src/stack/pkg/msg/Name.msg", "src"),
        ("share/pkg/msg/Name.msg", "."),
    ],
)
def test_layouts(tmp_path: Path, file: str, path: str) -> None:
    write(tmp_path / file, "int32 x")
    assert PackagePath([tmp_path / path]).read("pkg/Name", DefinitionKind.MESSAGE) == "int32 x"


def test_manifest_names_the_package(tmp_path: Path) -> None:
    write(tmp_path / "checkout/package.xml", "<package><name> pkg </name></package>")
    write(tmp_path / "checkout/srv/Ask.srv", "---\n")
    assert PackagePath([tmp_path]).read("pkg/Ask", DefinitionKind.SERVICE) == "---\n"
    assert PackagePath([tmp_path]).read("pkg/Ask", DefinitionKind.MESSAGE) is None


def test_same_name_of_stack_and_package(tmp_path: Path) -> None:
    write(tmp_path / "pkg/README.md", "")
    write(tmp_path / "pkg/pkg/package.xml", "<package><name>pkg</name></package>")
    write(tmp_path / "pkg/pkg/action/Do.action", "---\n---\n")
    assert PackagePath([tmp_path]).read("pkg/Do", DefinitionKind.ACTION) == "---\n---\n"


def test_first_path_wins(tmp_path: Path) -> None:
    write(tmp_path / "a/pkg/msg/Name.msg", "int32 a")
    write(tmp_path / "b/pkg/msg/Name.msg", "int32 b")
    paths = [tmp_path / "none", tmp_path / "b", tmp_path / "a"]
    assert PackagePath(paths).read("pkg/Name", DefinitionKind.MESSAGE) == "int32 b"


def test_line_ends_and_encoding(tmp_path: Path) -> None:
    file = tmp_path / "pkg/msg/Name.msg"
    write(file, "\ufeffint32 x\r\nint32 y\r\n")
    assert PackagePath([tmp_path]).read("pkg/Name", DefinitionKind.MESSAGE) == "int32 x\nint32 y\n"
    file.write_bytes(b"int32 x # gr\xfcn\n")
    assert (
        PackagePath([tmp_path]).read("pkg/Name", DefinitionKind.MESSAGE) == "int32 x # gr\ufffdn\n"
    )


def test_hidden_and_deep_folders_are_left(tmp_path: Path) -> None:
    write(tmp_path / ".git/pkg/msg/Name.msg", "int32 x")
    write(tmp_path / "1/2/3/4/5/6/7/pkg/msg/Name.msg", "int32 x")
    assert PackagePath([tmp_path]).read("pkg/Name", DefinitionKind.MESSAGE) is None


@pytest.fixture
def locked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that may be neither listed nor searched, whoever runs the test: root may all."""
    folder = tmp_path / "locked"
    write(folder / "pkg" / "msg" / "Name.msg", "int32 x")

    def refusing(call: Callable[..., Any], *, itself: bool) -> Callable[..., Any]:
        def checked(path: Any, *rest: Any, **options: Any) -> Any:
            there = Path(path)
            if folder in there.parents or (itself and there == folder):
                raise PermissionError(13, "Permission denied", str(path))
            return call(path, *rest, **options)

        return checked

    for name, itself in (("stat", False), ("listdir", True), ("scandir", True)):
        monkeypatch.setattr(os, name, refusing(getattr(os, name), itself=itself))
    return folder


def test_a_folder_that_may_not_be_read_holds_nothing(tmp_path: Path, locked: Path) -> None:
    write(tmp_path / "open" / "pkg" / "msg" / "Other.msg", "int32 y")
    for path in (tmp_path, locked, locked / "pkg"):
        assert PackagePath([path]).read("pkg/Name", DefinitionKind.MESSAGE) is None
    assert PackagePath([tmp_path]).read("pkg/Other", DefinitionKind.MESSAGE) == "int32 y"


def test_a_manifest_that_cannot_be_read_leaves_the_folder_its_name(tmp_path: Path) -> None:
    write(tmp_path / "src" / "pkg" / "package.xml", "#" * (MAX_FILE_SIZE + 1))
    write(tmp_path / "src" / "pkg" / "msg" / "Name.msg", "int32 x")
    assert PackagePath([tmp_path]).read("pkg/Name", DefinitionKind.MESSAGE) == "int32 x"


def test_large_file(tmp_path: Path) -> None:
    write(tmp_path / "pkg/msg/Name.msg", "#" * (MAX_FILE_SIZE + 1))
    with pytest.raises(DefinitionError, match=r"Name\.msg: larger than"):
        PackagePath([tmp_path]).read("pkg/Name", DefinitionKind.MESSAGE)


def test_common_packages_are_bare_and_plain() -> None:
    files = [file for file in SHARE.rglob("*.*") if file.is_file()]
    assert len(files) > 150
    for file in files:
        text = file.read_bytes()
        assert b"\r" not in text
        assert b"#" not in text
