from pathlib import Path

import pytest

from plcsim.cli import message_files
from plcsim.cli.message_files import MessageFiles, common_folders


@pytest.mark.parametrize(
    ("folder", "file"),
    [
        ("", "cell/msg/State.msg"),
        ("cell", "cell/msg/State.msg"),
        ("", "src/cell/msg/State.msg"),
        ("", "cell/State.msg"),
    ],
)
def test_where_a_definition_may_lie(tmp_path: Path, folder: str, file: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(parents=True)
    path.write_bytes(b"int8 x # \xff")
    files = MessageFiles([tmp_path / "absent", tmp_path / folder])
    assert files.read("cell/State", "msg") == "int8 x # \ufffd"
    assert files.read("cell/State", "srv") is None
    assert files.read("cell/Other", "msg") is None


def test_the_first_folder_counts(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name / "p" / "srv").mkdir(parents=True)
        (tmp_path / name / "p" / "srv" / "A.srv").write_text(name)
    files = MessageFiles([tmp_path / "two", tmp_path / "one"])
    assert files.read("p/A", "srv") == "two"


def test_a_large_file_is_cut(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(message_files, "MAX_BYTES", 4)
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "A.msg").write_text("int8 x")
    assert MessageFiles([tmp_path]).read("p/A", "msg") == "int8"


def test_common_folders(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/opt/a::/opt/b")
    folders = common_folders()
    assert folders[:2] == [Path("/opt/a"), Path("/opt/b")]
    text = MessageFiles(folders).read("std_msgs/Header", "msg")
    assert text is not None
    assert "frame_id" in text
