from pathlib import Path

import pytest

from plcsim.cli import declaration_files
from plcsim.cli.declaration_files import find_files, read_files
from st_types.syntax import source


def test_files_are_found_once_and_in_order(tmp_path: Path) -> None:
    for name in ("b/z.typ", "b/A.FUN", "a.var", "c.txt", "b/c/x.Typ"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    found = find_files([tmp_path / "b", tmp_path, tmp_path / "a.var"])
    names = [str(path.relative_to(tmp_path)) for path in found]
    assert names == ["b/A.FUN", "b/z.typ", "b/c/x.Typ", "a.var"]


def test_failures_do_not_stop_the_reading(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(source, "MAX_SOURCE_BYTES", 1 << 20)
    (tmp_path / "big.typ").write_bytes(bytes((1 << 20) + 1))
    (tmp_path / "ok.typ").write_text("TYPE\nEND_TYPE\n")
    reading = read_files([tmp_path / "big.typ", tmp_path / "none.typ", tmp_path / "ok.typ"])
    assert [file.path for file in reading.files] == [str(tmp_path / "ok.typ")]
    assert "larger than 1 MiB" in reading.failures[0]
    assert reading.failures[1] == f"{tmp_path / 'none.typ'}: error: No such file or directory"


def test_progress_is_for_terminals_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(declaration_files, "MANY_FILES", 1)
    (tmp_path / "a.typ").touch()
    read_files([tmp_path / "a.typ"])
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    read_files([tmp_path / "a.typ"])
    assert "reading" in capsys.readouterr().err
